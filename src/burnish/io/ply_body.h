#pragma once

#include <cstring>
#include <string>
#include <utility>

#include "burnish/base/context.h"
#include "burnish/io/geometry_file.h"
#include "burnish/io/ply_header.h"

namespace burnish {

/// A PLY file that is being read: where the cursor stands behind the header, and what is known.
struct PlyBody {
  PlyBody(std::string_view bytes, const std::string& name, const Vec3d& shift,
          const Context& watcher)
      : cursor(bytes, name), origin(shift), context(watcher), size(bytes.size()) {}

  static constexpr std::size_t kBlockRows = 4096;  ///< rows between two looks at the context

  bool keep_going() {
    context.progress(static_cast<double>(cursor.offset()) / static_cast<double>(size));
    return !context.cancelled();
  }

  Cursor cursor;
  Vec3d origin;  ///< is subtracted from wide positions
  const Context& context;
  std::size_t size;  ///< bytes of the whole file
  PlyHeader header;
  GeometryFile file;
  bool has_vertices = false;
  bool wide = false;  ///< positions came in a type that float cannot hold
};

/// Reads an element's rows into positions and attributes. Errors: bad_file, unsupported, cancelled.
Result<void> read_ply_vertices(PlyBody& body, const PlyElement& element);

/// Reads polygons or triangle strips, whose corners are in the list `indices` of the element; the
/// vertices must be there already. Errors: bad_file, unsupported, cancelled.
Result<void> read_ply_faces(PlyBody& body, const PlyElement& element, const PlyProperty& indices);

/// Leaves out, with a note, the triangles' origins or owners where one is none, or where not all
/// faces have them: other programs may mean something else by the name.
void check_triangle_attributes(GeometryFile& file);

}  // namespace burnish
