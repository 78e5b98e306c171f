#pragma once

#include "burnish/io/geometry_file.h"
#include "burnish/pipeline/record.h"
#include "verb.h"

namespace burnish::app {

/// Prints what each step of a run did and how long it took, one line a step.
void say_steps(const Session& session, const Record& record);

/// Prints every step with all its settings: "thin fan_cloud:ratio=0.1,...".
void say_methods(const Session& session, const Record& record);

/// Prints a row per comparison with the true surface.
void say_comparisons(const Session& session, const Record& record);

/// Prints "<name>: 1234 vertices, ..." with what matters of how the mesh hangs together.
void say_mesh(const Session& session, const std::string& name, const TriangleMesh& mesh);

/// Prints what the record certifies of the noise bound, where there was one.
void say_certificate(const Session& session, const Record& record);

/// Writes a mesh, with `comments` where its format has any, and prints what it could not hold.
Result<void> save(const std::string& path, const TriangleMesh& mesh, const Session& session,
                  const Context& context, std::vector<std::string> comments = {});

/// The same of a cloud.
Result<void> save(const std::string& path, const PointCloud& cloud, const Session& session,
                  const Context& context);

/// What a file says of how it came about.
std::vector<std::string> comments_of(const Record& record);

/// Keeps what the reader of `path` left out or changed for the summary and the report.
void keep_notes(const std::string& path, const GeometryFile& file, Record& record);

/// Prints the notes of a writing, or hands its error on.
Result<void> finish_writing(const Result<WriteReport>& written, const std::string& path,
                            const Session& session);

/// Whether `path` names a known format and lies in a folder that is there: asked before the work
/// begins. Errors: unsupported, not_found.
Result<void> check_output(const std::string& path);

/// Whether the folder of `path` is there. Errors: not_found.
Result<void> check_folder_of(const std::string& path);

}  // namespace burnish::app
