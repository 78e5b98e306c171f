#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "burnish/io/geometry_file.h"

namespace burnish {

class Output;

/// What a writer is given; refers to a mesh or cloud that outlives it.
struct GeometryView {
  std::span<const Vec3f> positions;
  std::span<const Triangle> triangles;
  const Attributes& attributes;
  Frame frame;
  std::optional<GridSize> grid;
  std::optional<Vec3d> viewpoint;
  std::span<const Origin> triangle_origin{};        ///< empty, or one per triangle
  std::span<const std::uint32_t> triangle_owner{};  ///< likewise

  /// The position in the world.
  Vec3d world(std::size_t i) const { return frame.origin + Vec3d(positions[i]); }
  bool framed() const { return frame.origin != Vec3d{}; }
};

/// What a format can hold besides positions.
struct Holds {
  bool triangles = false, points = false;  ///< meshes; clouds without triangles
  bool normals = false, colors = false, alpha = false;
  bool measures = false;  ///< sigma, noise, observations, origin
  bool channels = false;
  bool doubles = false;  ///< positions beyond float precision
  bool grid = false, viewpoint = false;
  bool triangle_attributes = false;
};

/// One row of the table of formats.
struct FileFormat {
  std::string_view name;                     ///< "ply"
  std::string_view title;                    ///< "PLY, Stanford polygon file"
  std::vector<std::string_view> extensions;  ///< with the dot, lower case
  Holds holds;
  bool has_ascii = false, has_binary = false;  ///< what the writer can do
  bool (*recognises)(std::string_view bytes);  ///< by content; looks at the first few KB
  Result<GeometryFile> (*read)(std::string_view bytes, const std::string& name, const Context&);
  void (*write)(Output&, const GeometryView&, const WriteOptions&);  ///< null: none
};

/// The format that the extension of `path` names, provided that it can be written. Errors:
/// unsupported, with the extensions that would do.
Result<const FileFormat*> format_to_write(const std::filesystem::path& path);

}  // namespace burnish
