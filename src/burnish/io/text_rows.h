#pragma once

#include "burnish/io/file_format.h"
#include "burnish/io/output.h"

namespace burnish {

/// Three numbers with blanks between them.
template <class T>
void write_vector(Output& out, const Vec3<T>& v) {
  out.number(v.x).character(' ').number(v.y).character(' ').number(v.z);
}

/// A position in the world: as a float, or as a double where the mesh has a frame.
inline void write_position(Output& out, const GeometryView& view, std::size_t i) {
  if (view.framed())
    write_vector(out, view.world(i));
  else
    write_vector(out, view.positions[i]);
}

/// The comments of the options, a line each behind '#'.
inline void write_comments(Output& out, const WriteOptions& options) {
  for (std::string comment : options.comments) {
    for (char& c : comment) c = c == '\n' || c == '\r' || c == '\\' ? ' ' : c;
    out.text("# ").text(comment).character('\n');
  }
}

}  // namespace burnish
