#include <fmt/format.h>

#include <algorithm>

#include "burnish/io/finish.h"
#include "burnish/io/ply.h"
#include "burnish/io/ply_scanner.h"

namespace burnish {
namespace {

/// Goes through the elements of a file in their order.
class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& name, const Vec3d& origin,
            const Context& context)
      : body_(bytes, name, origin, context) {}

  Result<GeometryFile> read();
  bool wide() const { return body_.wide; }
  const CommentFacts& facts() const { return body_.header.facts; }

 private:
  Result<void> check_claim(const PlyElement& element) const;
  Result<void> read_element(const PlyElement& element);
  Result<void> read_faces(const PlyElement& element);
  Result<void> skip_element(const PlyElement& element);
  Result<void> walk_over(const PlyElement& element);

  PlyBody body_;
  std::vector<std::pair<Cursor::Place, const PlyElement*>>
      deferred_;  ///< faces before the vertices
};

/// A count is a claim: a row takes at least so many bytes, in a text two per number.
Result<void> PlyReader::check_claim(const PlyElement& element) const {
  const bool ascii = body_.header.ascii;
  const std::size_t row = ascii ? 2 * element.properties.size() : element.row_bytes();
  const std::size_t left = body_.cursor.remaining() + (ascii ? 1 : 0);
  if (row == 0 || element.count <= left / row) return {};
  return body_.cursor.byte_error(
      fmt::format("the header claims {} of element '{}' with at least {} bytes each, "
                  "{} bytes are left",
                  element.count, element.name, row, body_.cursor.remaining()));
}

Result<void> PlyReader::read_element(const PlyElement& element) {
  if (element.name == "vertex") return read_ply_vertices(body_, element);
  if (element.name == "face" || element.name == "tristrips") return read_faces(element);
  return skip_element(element);
}

Result<void> PlyReader::read_faces(const PlyElement& element) {
  const auto indices =
      std::find_if(element.properties.begin(), element.properties.end(), [](const PlyProperty& p) {
        return p.list_count && (p.name == "vertex_indices" || p.name == "vertex_index");
      });
  if (indices == element.properties.end()) return skip_element(element);
  if (body_.has_vertices) return read_ply_faces(body_, element, *indices);
  deferred_.emplace_back(body_.cursor.place(), &element);  // come back when the vertices are known
  return walk_over(element);
}

Result<void> PlyReader::skip_element(const PlyElement& element) {
  body_.file.notes.push_back(
      fmt::format("the element '{}' ({} rows) is left out", shown(element.name), element.count));
  return walk_over(element);
}

Result<void> PlyReader::walk_over(const PlyElement& element) {
  if (element.properties.empty()) return {};
  return with_scanner(body_, [&](auto scan) -> Result<void> {
    for (std::size_t row = 0; row < element.count; ++row) {
      if (row % PlyBody::kBlockRows == 0 && !body_.keep_going()) return cancelled();
      if (!walk_over_row(scan, element, [](const PlyProperty&, std::int64_t) {}))
        return scan.error(fmt::format("{} {} of {}", element.name, row, element.count));
    }
    return {};
  });
}

Result<GeometryFile> PlyReader::read() {
  Cursor& cursor = body_.cursor;
  auto header = read_ply_header(cursor);
  if (!header) return header.error();
  body_.header = std::move(*header);
  if (facts().frame_origin) body_.origin = *facts().frame_origin;
  for (const PlyElement& element : body_.header.elements) {
    if (auto ok = check_claim(element); !ok) return ok.error();
    if (auto ok = read_element(element); !ok) return ok.error();
  }
  if (!body_.has_vertices) return cursor.byte_error("the file has no element 'vertex'");
  const bool more = body_.header.ascii ? cursor.next_filled_line() : !cursor.at_end();
  if (more) {
    body_.file.notes.push_back(
        fmt::format("{} bytes after the last element are left out", cursor.remaining()));
  }
  for (const auto& [place, element] : deferred_) {
    cursor.go_to(place);
    if (auto ok = read_element(*element); !ok) return ok.error();
  }
  check_triangle_attributes(body_.file);
  body_.file.grid = facts().grid;
  body_.file.viewpoint = facts().viewpoint;
  return std::move(body_.file);
}

}  // namespace

bool recognise_ply(std::string_view bytes) {
  Cursor cursor(bytes.substr(0, 4096), {});
  return cursor.next_filled_line() && cursor.word() == "ply" && cursor.at_line_end();
}

Result<GeometryFile> read_ply(std::string_view bytes, const std::string& name,
                              const Context& context) {
  PlyReader first(bytes, name, {}, context);
  auto file = first.read();
  if (!file) return file;
  if (first.wide() && !first.facts().frame_origin) {
    const Vec3d origin = frame_origin(file->mesh.positions);
    if (origin != Vec3d{}) {
      *file = {};
      file = PlyReader(bytes, name, origin, context).read();
      if (!file) return file;
    }
  }
  return finish_reading(std::move(*file), name);
}

}  // namespace burnish
