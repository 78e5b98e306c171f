#include "burnish/io/output.h"
#include "burnish/io/pcd.h"
#include "burnish/io/text_rows.h"
#include "burnish/io/vertex_rows.h"

namespace burnish {
namespace {

char type_letter(NumberType type) {
  if (is_floating(type)) return 'F';
  return with_type(type, [](auto zero) { return std::is_signed_v<decltype(zero)>; }) ? 'I' : 'U';
}

void write_header(Output& out, const GeometryView& view, const WriteOptions& options,
                  const VertexRows& rows) {
  const auto line = [&](std::string_view key, auto value) {
    out.text(key);
    for (const Field& field : rows.fields()) {
      out.character(' ');
      value(field);
    }
    out.character('\n');
  };
  const std::size_t count = view.positions.size();
  const std::size_t width = view.grid ? view.grid->width : count;
  const Vec3d eye = view.viewpoint.value_or(Vec3d{});
  out.text("# .PCD v0.7 - Point Cloud Data file format\n");
  write_comments(out, options);
  if (view.framed()) {
    out.text("# burnish frame_origin ");
    write_vector(out, view.frame.origin);
    out.character('\n');
  }
  if (view.viewpoint) {
    out.text("# burnish viewpoint ");
    write_vector(out, eye);
    out.character('\n');
  }
  if (view.grid)
    out.text("# burnish grid ")
        .number(view.grid->width)
        .character(' ')
        .number(view.grid->height)
        .character('\n');
  out.text("VERSION 0.7\n");
  line("FIELDS", [&](const Field& field) { out.text(field.name); });
  line("SIZE", [&](const Field& field) { out.number(size_of(field.type)); });
  line("TYPE", [&](const Field& field) { out.character(type_letter(field.type)); });
  line("COUNT", [&](const Field&) { out.character('1'); });
  out.text("WIDTH ").number(width).text("\nHEIGHT ").number(view.grid ? view.grid->height : 1u);
  out.text("\nVIEWPOINT ");
  write_vector(out, eye);
  out.text(" 1 0 0 0\nPOINTS ").number(count);
  out.text(options.ascii ? "\nDATA ascii\n" : "\nDATA binary\n");
}

}  // namespace

void write_pcd(Output& out, const GeometryView& view, const WriteOptions& options) {
  const VertexRows rows(view, FieldNames::pcd);
  if (auto ok = rows.check(); !ok) return out.fail(ok.error());
  write_header(out, view, options, rows);
  rows.write(out, options.ascii);
}

}  // namespace burnish
