#include "burnish/io/obj.h"
#include "burnish/io/output.h"
#include "burnish/io/text_rows.h"

namespace burnish {

void write_obj(Output& out, const GeometryView& view, const WriteOptions& options) {
  write_comments(out, options);
  const Attributes& attributes = view.attributes;
  write_rows(out, view.positions.size(), [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) {
      out.text("v ");
      write_position(out, view, i);
      if (!attributes.colors.empty()) {
        for (std::size_t part = 0; part < 3; ++part) {
          out.character(' ').number(static_cast<float>(attributes.colors[i][part]) / 255.f);
        }
      }
      out.character('\n');
    }
  });
  const bool normals = !attributes.normals.empty();
  for (std::size_t i = 0; i < attributes.normals.size() && out.ok(); ++i) {
    out.text("vn ");
    write_vector(out, attributes.normals[i]);
    out.character('\n');
    if (i % 4096 == 0) out.advance(0);
  }
  write_rows(out, view.triangles.size(), [&](std::size_t first, std::size_t count) {
    for (const Triangle& triangle : view.triangles.subspan(first, count)) {
      out.character('f');
      for (const std::uint32_t v : triangle) {
        out.character(' ').number(v + std::uint64_t{1});
        if (normals) out.text("//").number(v + std::uint64_t{1});
      }
      out.character('\n');
    }
  });
}

}  // namespace burnish
