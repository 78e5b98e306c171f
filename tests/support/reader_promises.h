#pragma once

#include <cstdio>
#include <cstdlib>

#include "burnish/core/point_cloud.h"
#include "burnish/io/file_format.h"

namespace burnish::test {

/// What every reader promises, whatever the bytes are: a sound mesh or cloud, or an error with a
/// message that names the file. Ends the process where it is broken, as fuzzers want it.
inline void expect_promises_kept(const FileFormat& format, std::string_view bytes) {
  const auto require = [&](bool condition, const char* what) {
    if (condition) return;
    std::fprintf(stderr, "%.*s: broken promise: %s\n", static_cast<int>(format.name.size()),
                 format.name.data(), what);
    std::abort();
  };
  format.recognises(bytes);
  const auto file = format.read(bytes, "input", Context{});
  if (!file) {
    require(!file.error().message.empty(), "an error has a message");
    require(file.error().where.find("input") != std::string::npos, "an error names the file");
    return;
  }
  const TriangleMesh& mesh = file->mesh;
  if (file->grid) {
    const PointCloud cloud{mesh.positions, mesh.attributes, file->grid, file->viewpoint,
                           mesh.frame};
    require(check(cloud).has_value(), "the cloud is sound");
    require(mesh.triangles.empty(), "an organized cloud has no triangles");
  } else {
    require(check(mesh).has_value(), "the mesh is sound");
  }
}

}  // namespace burnish::test
