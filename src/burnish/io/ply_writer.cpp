#include <array>

#include "burnish/io/output.h"
#include "burnish/io/ply.h"
#include "burnish/io/vertex_rows.h"

namespace burnish {
namespace {

constexpr std::array<std::string_view, 10> kTypeNames{
    "char", "uchar", "short", "ushort", "int", "uint", "int64", "uint64", "float", "double"};

void write_vector(Output& out, std::string_view key, const Vec3d& v) {
  out.text("comment burnish ").text(key);
  for (std::size_t axis = 0; axis < 3; ++axis) out.character(' ').number(v[axis]);
  out.character('\n');
}

void write_header(Output& out, const GeometryView& view, const WriteOptions& options,
                  const VertexRows& rows) {
  out.text("ply\nformat ").text(options.ascii ? "ascii" : "binary_little_endian").text(" 1.0\n");
  for (std::string comment : options.comments) {
    for (char& c : comment) c = c == '\n' || c == '\r' ? ' ' : c;
    out.text("comment ").text(comment).character('\n');
  }
  if (view.framed()) write_vector(out, "frame_origin", view.frame.origin);
  if (view.viewpoint) write_vector(out, "viewpoint", *view.viewpoint);
  if (view.grid) {
    out.text("comment burnish grid ")
        .number(view.grid->width)
        .character(' ')
        .number(view.grid->height);
    out.character('\n');
  }
  out.text("element vertex ").number(view.positions.size()).character('\n');
  for (const Field& field : rows.fields()) {
    out.text("property ").text(kTypeNames[static_cast<std::size_t>(field.type)]).character(' ');
    out.text(field.name).character('\n');
  }
  if (!view.triangles.empty()) {
    out.text("element face ").number(view.triangles.size());
    out.text("\nproperty list uchar int vertex_indices\n");
  }
  out.text("end_header\n");
}

}  // namespace

void write_ply(Output& out, const GeometryView& view, const WriteOptions& options) {
  const VertexRows rows(view, FieldNames::ply);
  if (auto ok = rows.check(); !ok) return out.fail(ok.error());
  write_header(out, view, options, rows);
  rows.write(out, options.ascii);
  write_rows(out, view.triangles.size(), [&](std::size_t first, std::size_t count) {
    if (options.ascii) {
      for (const auto& [a, b, c] : view.triangles.subspan(first, count)) {
        out.text("3 ").number(a).character(' ').number(b).character(' ').number(c).character('\n');
      }
      return;
    }
    char* at = out.room(13 * count);
    for (const Triangle& triangle : view.triangles.subspan(first, count)) {
      *at = 3;
      std::memcpy(at + 1, triangle.data(), 12);
      at += 13;
    }
  });
}

}  // namespace burnish
