#include <fmt/format.h>

#include "burnish/io/ply_scanner.h"
#include "burnish/io/vertex_columns.h"

namespace burnish {
namespace {

/// Binary rows of one size are decoded where they lie.
Result<void> append_in_place(PlyBody& body, const PlyElement& element, VertexColumns& columns) {
  const std::size_t stride = element.row_bytes();
  std::vector<Column> block(element.properties.size());
  for (std::size_t done = 0; done < element.count;) {
    const std::size_t rows = std::min<std::size_t>(PlyBody::kBlockRows, element.count - done);
    const std::byte* at = body.cursor.take(rows * stride);
    if (!at) return BinaryScanner{body.cursor, body.header.order}.error("the vertices");
    for (std::size_t i = 0; i < block.size(); ++i) {
      block[i] = {at, stride};
      at += size_of(element.properties[i].type);
    }
    columns.append(block, rows, body.header.order != std::endian::native);
    done += rows;
    if (!body.keep_going()) return cancelled();
  }
  return {};
}

/// Reads the numbers of a row to `out`, packed, and goes over its lists.
template <class Scanner>
bool read_row(Scanner& scan, const PlyElement& element, std::byte* out) {
  if (!scan.begin_row()) return false;
  for (const PlyProperty& p : element.properties) {
    if (p.list_count) {
      std::int64_t length = 0;
      if (!read_length(scan, p, length) || !scan.skip(p.type, static_cast<std::uint64_t>(length)))
        return false;
    } else {
      if (!scan.scalar(p.type, out)) return false;
      out += size_of(p.type);
    }
  }
  return scan.end_row();
}

/// Brings the rows into a packed block in the machine's byte order first.
template <class Scanner>
Result<void> append_row_by_row(PlyBody& body, Scanner scan, const PlyElement& element,
                               VertexColumns& columns) {
  std::size_t stride = 0;
  std::vector<std::size_t> offsets;
  for (const PlyProperty& p : element.properties) {
    if (p.list_count) continue;
    offsets.push_back(stride);
    stride += size_of(p.type);
  }
  std::vector<std::byte> packed(PlyBody::kBlockRows * stride);
  std::vector<Column> block;
  for (const std::size_t offset : offsets) block.push_back({packed.data() + offset, stride});
  for (std::size_t done = 0; done < element.count;) {
    const std::size_t rows = std::min<std::size_t>(PlyBody::kBlockRows, element.count - done);
    for (std::size_t row = 0; row < rows; ++row) {
      if (!read_row(scan, element, packed.data() + row * stride))
        return scan.error(fmt::format("vertex {} of {}", done + row, element.count));
    }
    columns.append(block, rows, false);
    done += rows;
    if (!body.keep_going()) return cancelled();
  }
  return {};
}

}  // namespace

Result<void> read_ply_vertices(PlyBody& body, const PlyElement& element) {
  if (body.has_vertices) return body.cursor.byte_error("there is a second element 'vertex'");
  if (element.count > 0xffffffffu) {
    return body.cursor.byte_error("more than 4294967295 vertices", ErrorCode::unsupported);
  }
  body.has_vertices = true;
  std::vector<Field> fields;
  for (const PlyProperty& p : element.properties) {
    if (p.list_count) {
      body.file.notes.push_back("the list '" + shown(p.name) + "' of the vertices is left out");
    } else {
      fields.push_back({p.name, p.type});
    }
  }
  VertexColumns columns(std::move(fields), element.count, body.origin);
  if (!columns.has_positions()) return body.cursor.byte_error("the vertices have no x, y and z");
  body.wide = columns.wide_positions();
  const bool in_place = !body.header.ascii && !element.has_lists();
  const Result<void> ok =
      in_place ? append_in_place(body, element, columns) : with_scanner(body, [&](auto scan) {
        return append_row_by_row(body, scan, element, columns);
      });
  if (ok) columns.finish(body.file);
  return ok;
}

}  // namespace burnish
