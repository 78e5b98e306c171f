// Whatever the bytes are, a reader gives a sound mesh or cloud, or an error that names the file.
#include <cstdio>
#include <cstdlib>

#include "burnish/core/point_cloud.h"
#include "burnish/io/file_format.h"

namespace {

void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace burnish;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (const FileFormat& format : geometry_formats()) {
    format.recognises(bytes);
    if (format.name != BURNISH_FUZZ_FORMAT) continue;
    const auto file = format.read(bytes, "input", Context{});
    if (!file) {
      require(!file.error().message.empty(), "an error has a message");
      require(file.error().where.find("input") != std::string::npos, "an error names the file");
      continue;
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
  return 0;
}
