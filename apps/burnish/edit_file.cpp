#include "edit_file.h"

#include <utility>

#include "burnish/pipeline/phases.h"
#include "summary.h"

namespace burnish::app {

Result<void> edit_file(const FileEdit& asked, const Edit& edit, const Session& session,
                       const Context& context) {
  if (auto possible = check_output(asked.output); !possible) return possible;
  if (auto possible = check_report_output(asked.report); !possible) return possible;
  context.stage("reading " + asked.input);
  Result<GeometryFile> file = read_geometry(asked.input, context.part(0, 0.2));
  if (!file) return std::move(file).error();

  Record record = new_record(asked.title + " " + asked.input, session.command, {asked.input});
  keep_notes(asked.input, *file, record);
  if (auto done = edit(*std::move(file), record, context.part(0.2, 0.8)); !done) return done;
  say_steps(session, record);
  say_certificate(session, record);
  return write_report_output(asked.report, record, session, context.part(0.8, 1));
}

Result<void> edit_mesh(const FileEdit& asked, const MeshEdit& edit, const Session& session,
                       const Context& context) {
  const Edit edit_and_save = [&](GeometryFile file, Record& record,
                                 const Context& share) -> Result<void> {
    Result<TriangleMesh> mesh = mesh_of(std::move(file), asked.input);
    if (!mesh) return std::move(mesh).error();
    if (auto done = edit(*mesh, record, share.part(0, 0.8)); !done) return done;
    return save(asked.output, *mesh, session, share.part(0.8, 1), comments_of(record));
  };
  return edit_file(asked, edit_and_save, session, context);
}

}  // namespace burnish::app
