#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/result.h"
#include "burnish/core/point_cloud.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// What a file of meshes or points holds. A mesh without triangles is a cloud.
struct GeometryFile {
  TriangleMesh mesh;
  std::optional<GridSize> grid;    ///< of an organized cloud
  std::optional<Vec3d> viewpoint;  ///< the camera's position, where the file says it
  std::vector<std::string> notes;  ///< what was left out or changed, a sentence each
};

/// The points of a file: of a mesh its vertices.
PointCloud cloud_of(GeometryFile file);

/// The mesh of the file at `path`. Errors: bad_geometry where it has no triangles.
Result<TriangleMesh> mesh_of(GeometryFile file, const std::filesystem::path& path);

struct WriteOptions {
  bool ascii = false;                 ///< text, where the format has both
  std::vector<std::string> comments;  ///< into the header; line breaks become blanks
};

struct WriteReport {
  std::vector<std::string> notes;  ///< what the format could not hold
};

/// Reads PLY, OBJ, STL, OFF, PCD or XYZ; the content decides which, the extension where it does
/// not.
///
/// Never crashes or hangs on a damaged file; memory at most 64 MB + 8 x the file. Errors name the
/// file and the line or the byte: not_found, io_failure, bad_file (damaged, an index out of range),
/// unsupported (a format or a part of one that burnish has not), cancelled.
///
/// Non-finite positions: an organized cloud keeps them as missing pixels (NaN in all three); a
/// vertex that no triangle uses and a point of an unorganized cloud is left out with a note; a
/// vertex that a triangle uses makes the file bad. Non-finite normals become 0 (unknown). Polygons
/// are triangulated. Indices keep their order unless vertices are left out. Large coordinates
/// (double precision or text): where float would resolve worse than 1e-6 of the extent, an origin
/// is subtracted and kept in `mesh.frame`.
Result<GeometryFile> read_geometry(const std::filesystem::path& path, const Context& context = {});

/// As read_geometry; a file without triangles is refused (bad_geometry).
Result<TriangleMesh> read_mesh(const std::filesystem::path& path, const Context& context = {});

/// As read_geometry; of a mesh the vertices.
Result<PointCloud> read_cloud(const std::filesystem::path& path, const Context& context = {});

/// Writes the format that the extension names, whole or not at all (AtomicWriter). What the format
/// cannot hold is left out with a note; where that would be geometry (triangles in PCD, points in
/// STL) the call is refused. Errors: unsupported, bad_geometry, invalid_argument, io_failure,
/// cancelled.
Result<WriteReport> write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh,
                               const WriteOptions& options = {}, const Context& context = {});
Result<WriteReport> write_cloud(const std::filesystem::path& path, const PointCloud& cloud,
                                const WriteOptions& options = {}, const Context& context = {});

struct FileFormat;

/// Every format, in the order in which content is tried.
std::span<const FileFormat> geometry_formats();

}  // namespace burnish
