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
    if (!view.triangle_origin.empty()) out.text("property uchar origin\n");
    if (!view.triangle_owner.empty()) out.text("property uint owner\n");
  }
  out.text("end_header\n");
}

/// Rows `first` to `first + count` of the faces as lines.
void print_faces(Output& out, const GeometryView& view, std::size_t first, std::size_t count) {
  for (std::size_t t = first; t < first + count; ++t) {
    out.character('3');
    for (const std::uint32_t v : view.triangles[t]) out.character(' ').number(v);
    if (!view.triangle_origin.empty())
      out.character(' ').number(static_cast<unsigned>(view.triangle_origin[t]));
    if (!view.triangle_owner.empty()) out.character(' ').number(view.triangle_owner[t]);
    out.character('\n');
  }
}

/// The same as bytes, little endian.
void pack_faces(Output& out, const GeometryView& view, std::size_t first, std::size_t count) {
  const std::size_t origin_bytes = view.triangle_origin.empty() ? 0 : sizeof(Origin);
  const std::size_t owner_bytes = view.triangle_owner.empty() ? 0 : sizeof(std::uint32_t);
  char* at = out.room((1 + sizeof(Triangle) + origin_bytes + owner_bytes) * count);
  for (std::size_t t = first; t < first + count; ++t) {
    *at++ = 3;
    std::memcpy(at, view.triangles[t].data(), sizeof(Triangle));
    at += sizeof(Triangle);
    if (origin_bytes > 0) std::memcpy(at, &view.triangle_origin[t], origin_bytes);
    at += origin_bytes;
    if (owner_bytes > 0) std::memcpy(at, &view.triangle_owner[t], owner_bytes);
    at += owner_bytes;
  }
}

}  // namespace

void write_ply(Output& out, const GeometryView& view, const WriteOptions& options) {
  const VertexRows rows(view, FieldNames::ply);
  if (auto ok = rows.check(); !ok) return out.fail(ok.error());
  write_header(out, view, options, rows);
  rows.write(out, options.ascii);
  write_rows(out, view.triangles.size(), [&](std::size_t first, std::size_t count) {
    options.ascii ? print_faces(out, view, first, count) : pack_faces(out, view, first, count);
  });
}

}  // namespace burnish
