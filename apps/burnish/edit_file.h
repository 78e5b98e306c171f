#pragma once

#include <functional>
#include <string>

#include "burnish/io/geometry_file.h"
#include "burnish/pipeline/record.h"
#include "report_output.h"
#include "verb.h"

namespace burnish::app {

/// What a verb that reads one file and writes another is asked for.
struct FileEdit {
  std::string title;  ///< of the record: "Smoothing of"
  const std::string& input;
  const std::string& output;
  const ReportOutput& report;
};

/// Makes what comes of the file and saves it; what was done goes into the record.
using Edit = std::function<Result<void>(GeometryFile file, Record& record, const Context& context)>;

/// Sees first that both outputs can be written, reads the input, has `edit` do its work, says what
/// was done and writes the report that is wanted.
Result<void> edit_file(const FileEdit& asked, const Edit& edit, const Session& session,
                       const Context& context);

/// The same for a mesh: `edit` changes it, and it is saved.
using MeshEdit = std::function<Result<void>(TriangleMesh& mesh, Record& record, const Context&)>;
Result<void> edit_mesh(const FileEdit& asked, const MeshEdit& edit, const Session& session,
                       const Context& context);

}  // namespace burnish::app
