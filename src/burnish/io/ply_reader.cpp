#include <fmt/format.h>

#include <algorithm>

#include "burnish/io/faces.h"
#include "burnish/io/finish.h"
#include "burnish/io/ply.h"
#include "burnish/io/ply_header.h"
#include "burnish/io/vertex_columns.h"

namespace burnish {
namespace {

constexpr std::size_t kBlockRows = 4096;

/// The numbers of a binary body, one after the other.
struct BinaryScanner {
  Cursor& cursor;
  std::endian order;

  bool begin_row() { return true; }
  bool end_row() { return true; }
  bool scalar(NumberType type, std::byte* out) {
    const std::byte* bytes = cursor.take(size_of(type));
    if (!bytes) return false;
    std::memcpy(out, bytes, size_of(type));
    if (order != std::endian::native) std::reverse(out, out + size_of(type));
    return true;
  }
  bool skip(NumberType type, std::uint64_t count) {
    return count <= cursor.remaining() / size_of(type) && cursor.take(count * size_of(type));
  }
  std::size_t most(NumberType type) const { return cursor.remaining() / size_of(type); }
  Error error(std::string message) const {
    return cursor.byte_error(cursor.at_end() ? "the file ends within " + message
                                             : message + " is cut off");
  }
};

/// The numbers of an ascii body, a row per line.
struct TextScanner {
  Cursor& cursor;

  bool begin_row() { return cursor.next_filled_line(); }
  bool end_row() {
    if (!cursor.at_line_end()) return false;
    cursor.next_line();
    return true;
  }
  bool scalar(NumberType type, std::byte* out) { return parse_number(cursor, type, out); }
  bool skip(NumberType type, std::uint64_t count) {
    std::byte ignored[8];
    for (; count > 0; --count) {
      if (!scalar(type, ignored)) return false;
    }
    return true;
  }
  std::size_t most(NumberType) const { return (cursor.remaining() + 1) / 2; }
  Error error(const std::string& what) const {
    if (cursor.at_end()) return cursor.line_error("the file ends within " + what);
    Cursor rest = cursor;
    const std::string word = shown(rest.word());
    if (word.empty()) return cursor.line_error(what + " has too few numbers");
    return cursor.line_error(
        fmt::format("'{}' in {} is one number too many or none of its type", word, what));
  }
};

template <class Scanner>
bool read_integer(Scanner& scan, NumberType type, std::int64_t& value) {
  std::byte bytes[8];
  if (!scan.scalar(type, bytes)) return false;
  return with_type(type, [&](auto zero) {
    using T = decltype(zero);
    const T number = load<T>(bytes, false);
    if constexpr (std::is_floating_point_v<T>) {
      if (!(std::abs(number) < static_cast<T>(0x1p53)) || number != std::floor(number))
        return false;
    }
    value = static_cast<std::int64_t>(number);
    return true;
  });
}

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& name, const Vec3d& origin,
            const Context& context)
      : cursor_(bytes, name), origin_(origin), context_(context), size_(bytes.size()) {}

  Result<GeometryFile> read();
  bool wide() const { return wide_; }
  const CommentFacts& facts() const { return header_.facts; }

 private:
  bool keep_going() {
    context_.progress(static_cast<double>(cursor_.offset()) / static_cast<double>(size_));
    return !context_.cancelled();
  }
  Result<void> check_claim(const PlyElement& element) const;
  Result<void> read_vertices(const PlyElement& element);
  Result<void> append_in_place(const PlyElement& element, VertexColumns& columns);
  template <class Scanner>
  Result<void> append_row_by_row(Scanner scan, const PlyElement& element, VertexColumns& columns);
  template <class Scanner>
  Result<void> read_faces(Scanner scan, const PlyElement& element);
  template <class Scanner>
  Result<void> skip_element(Scanner scan, const PlyElement& element);
  template <class Scanner>
  Result<void> walk_over(Scanner scan, const PlyElement& element);
  template <class Scanner>
  Result<void> read_element(Scanner scan, const PlyElement& element);
  std::size_t read_triangle_run(const PlyElement& element, std::size_t corners, std::size_t most);

  Cursor cursor_;
  Vec3d origin_;
  const Context& context_;
  std::size_t size_;
  PlyHeader header_;
  GeometryFile file_;
  bool has_vertices_ = false, wide_ = false;
  std::vector<std::pair<Cursor, const PlyElement*>> deferred_;  ///< faces before the vertices
};

/// A count is a claim: a row takes at least so many bytes, in a text two per number.
Result<void> PlyReader::check_claim(const PlyElement& element) const {
  const std::size_t row = header_.ascii ? 2 * element.properties.size() : element.row_bytes();
  const std::size_t left = cursor_.remaining() + (header_.ascii ? 1 : 0);
  if (row == 0 || element.count <= left / row) return {};
  return cursor_.byte_error(
      fmt::format("the header claims {} of element '{}' with at least {} bytes each, "
                  "{} bytes are left",
                  element.count, element.name, row, cursor_.remaining()));
}

Result<void> PlyReader::read_vertices(const PlyElement& element) {
  if (has_vertices_) return cursor_.byte_error("there is a second element 'vertex'");
  if (element.count > 0xffffffffu) {
    return cursor_.byte_error("more than 4294967295 vertices", ErrorCode::unsupported);
  }
  has_vertices_ = true;
  std::vector<Field> fields;
  for (const PlyProperty& p : element.properties) {
    if (p.list_count) {
      file_.notes.push_back("the list '" + shown(p.name) + "' of the vertices is left out");
    } else {
      fields.push_back({p.name, p.type});
    }
  }
  VertexColumns columns(std::move(fields), element.count, origin_);
  if (!columns.has_positions()) return cursor_.byte_error("the vertices have no x, y and z");
  wide_ = columns.wide_positions();
  Result<void> ok = header_.ascii ? append_row_by_row(TextScanner{cursor_}, element, columns)
                    : element.has_lists()
                        ? append_row_by_row(BinaryScanner{cursor_, header_.order}, element, columns)
                        : append_in_place(element, columns);
  if (ok) columns.finish(file_);
  return ok;
}

Result<void> PlyReader::append_in_place(const PlyElement& element, VertexColumns& columns) {
  const std::size_t stride = element.row_bytes();
  std::vector<Column> block(element.properties.size());
  for (std::size_t done = 0; done < element.count;) {
    const std::size_t rows = std::min<std::size_t>(kBlockRows, element.count - done);
    const std::byte* at = cursor_.take(rows * stride);
    if (!at) return BinaryScanner{cursor_, header_.order}.error("the vertices");
    for (std::size_t i = 0; i < block.size(); ++i) {
      block[i] = {at, stride};
      at += size_of(element.properties[i].type);
    }
    columns.append(block, rows, header_.order != std::endian::native);
    done += rows;
    if (!keep_going()) return cancelled();
  }
  return {};
}

/// Brings the rows into a packed block in the machine's byte order first.
template <class Scanner>
Result<void> PlyReader::append_row_by_row(Scanner scan, const PlyElement& element,
                                          VertexColumns& columns) {
  std::size_t stride = 0;
  std::vector<std::size_t> offsets;
  for (const PlyProperty& p : element.properties) {
    if (p.list_count) continue;
    offsets.push_back(stride);
    stride += size_of(p.type);
  }
  std::vector<std::byte> packed(kBlockRows * stride);
  std::vector<Column> block;
  for (const std::size_t offset : offsets) block.push_back({packed.data() + offset, stride});
  for (std::size_t done = 0; done < element.count;) {
    const std::size_t rows = std::min<std::size_t>(kBlockRows, element.count - done);
    std::byte* out = packed.data();
    for (std::size_t row = 0; row < rows; ++row) {
      bool ok = scan.begin_row();
      for (const PlyProperty& p : element.properties) {
        std::int64_t length = 0;
        if (!ok) break;
        if (p.list_count) {
          ok = read_integer(scan, *p.list_count, length) && length >= 0 &&
               scan.skip(p.type, static_cast<std::uint64_t>(length));
        } else {
          ok = scan.scalar(p.type, out);
          out += size_of(p.type);
        }
      }
      if (!ok || !scan.end_row())
        return scan.error(fmt::format("vertex {} of {}", done + row, element.count));
    }
    columns.append(block, rows, false);
    done += rows;
    if (!keep_going()) return cancelled();
  }
  return {};
}

/// The fast way through binary faces that are triangles: rows of one fixed size, as long as they
/// are triangles of known vertices. Gives the number of rows read, at most `most`.
std::size_t PlyReader::read_triangle_run(const PlyElement& element, std::size_t corners,
                                         std::size_t most) {
  const PlyProperty& list = element.properties[corners];
  if (size_of(*list.list_count) != 1 || size_of(list.type) != 4 || is_floating(list.type)) return 0;
  std::size_t before = 0;
  for (std::size_t i = 0; i < corners; ++i) before += size_of(element.properties[i].type);
  const std::size_t row = element.row_bytes() + 12;
  const bool swap = header_.order != std::endian::native;
  const auto count = static_cast<std::uint32_t>(file_.mesh.positions.size());
  most = std::min(most, cursor_.remaining() / row);
  const auto* at = cursor_.take(0) + before;
  std::vector<Triangle>& triangles = file_.mesh.triangles;
  std::size_t rows = 0;
  for (; rows < most && *at == std::byte{3}; ++rows, at += row) {
    Triangle triangle;
    std::memcpy(triangle.data(), at + 1, 12);
    if (swap) {
      for (std::uint32_t& v : triangle) v = byte_swapped(v);
    }
    if (triangle[0] >= count || triangle[1] >= count || triangle[2] >= count) break;
    triangles.push_back(triangle);
  }
  cursor_.take(rows * row);
  return rows;
}

template <class Scanner>
Result<void> PlyReader::read_faces(Scanner scan, const PlyElement& element) {
  const auto indices =
      std::find_if(element.properties.begin(), element.properties.end(), [](const PlyProperty& p) {
        return p.list_count && (p.name == "vertex_indices" || p.name == "vertex_index");
      });
  if (indices == element.properties.end()) return skip_element(scan, element);
  if (!has_vertices_) {  // come back when the vertices are known
    deferred_.emplace_back(cursor_, &element);
    return walk_over(scan, element);
  }
  for (const PlyProperty& p : element.properties) {
    if (&p != &*indices)
      file_.notes.push_back("the property '" + shown(p.name) + "' of '" + element.name +
                            "' is left out");
  }
  const auto corners_at = static_cast<std::size_t>(indices - element.properties.begin());
  const bool one_list =
      std::count_if(element.properties.begin(), element.properties.end(),
                    [](const PlyProperty& p) { return p.list_count.has_value(); }) == 1;
  const bool strips = element.name == "tristrips";
  std::vector<Triangle>& triangles = file_.mesh.triangles;
  const std::size_t least =
      header_.ascii ? 8 : size_of(*indices->list_count) + 3 * size_of(indices->type);
  triangles.reserve(triangles.size() +
                    std::min<std::size_t>(element.count, cursor_.remaining() / least + 1));
  FaceList faces(file_.mesh.positions, triangles);
  std::vector<std::int64_t> corners;
  for (std::size_t face = 0; face < element.count;) {
    if (face % kBlockRows == 0 && !keep_going()) return cancelled();
    const std::size_t to_block_end =
        std::min<std::size_t>(element.count, (face / kBlockRows + 1) * kBlockRows) - face;
    if (std::is_same_v<Scanner, BinaryScanner> && one_list && !strips) {
      const std::size_t run = read_triangle_run(element, corners_at, to_block_end);
      face += run;
      faces.count(run);
      if (run > 0) continue;
    }
    bool ok = scan.begin_row();
    for (const PlyProperty& p : element.properties) {
      if (!ok) break;
      if (!p.list_count) {
        ok = scan.skip(p.type, 1);
        continue;
      }
      std::int64_t length = 0;
      ok = read_integer(scan, *p.list_count, length) && length >= 0 &&
           static_cast<std::uint64_t>(length) <= scan.most(p.type);
      if (!ok) break;
      if (&p != &*indices) {
        ok = scan.skip(p.type, static_cast<std::uint64_t>(length));
        continue;
      }
      corners.resize(static_cast<std::size_t>(length));
      for (std::int64_t& corner : corners) ok = ok && read_integer(scan, p.type, corner);
    }
    if (!ok) return scan.error(fmt::format("{} {} of {}", element.name, face, element.count));
    if (auto added = strips ? faces.add_strip(corners) : faces.add(corners); !added) {
      Error error = scan.error("");
      error.code = added.error().code;
      error.message = added.error().message;
      return error;
    }
    if (!scan.end_row())
      return scan.error(fmt::format("{} {} of {}", element.name, face, element.count));
    ++face;
  }
  faces.note(file_.notes);
  return {};
}

template <class Scanner>
Result<void> PlyReader::skip_element(Scanner scan, const PlyElement& element) {
  file_.notes.push_back(
      fmt::format("the element '{}' ({} rows) is left out", shown(element.name), element.count));
  return walk_over(scan, element);
}

template <class Scanner>
Result<void> PlyReader::walk_over(Scanner scan, const PlyElement& element) {
  if (element.properties.empty()) return {};
  for (std::size_t row = 0; row < element.count; ++row) {
    if (row % kBlockRows == 0 && !keep_going()) return cancelled();
    bool ok = scan.begin_row();
    for (const PlyProperty& p : element.properties) {
      std::int64_t length = 1;
      if (ok && p.list_count) ok = read_integer(scan, *p.list_count, length) && length >= 0;
      ok = ok && scan.skip(p.type, static_cast<std::uint64_t>(length));
    }
    if (!ok || !scan.end_row())
      return scan.error(fmt::format("{} {} of {}", element.name, row, element.count));
  }
  return {};
}

template <class Scanner>
Result<void> PlyReader::read_element(Scanner scan, const PlyElement& element) {
  if (element.name == "vertex") return read_vertices(element);
  if (element.name == "face" || element.name == "tristrips") return read_faces(scan, element);
  return skip_element(scan, element);
}

Result<GeometryFile> PlyReader::read() {
  auto header = read_ply_header(cursor_);
  if (!header) return header.error();
  header_ = std::move(*header);
  if (header_.facts.frame_origin) origin_ = *header_.facts.frame_origin;
  const auto read_any = [&](const PlyElement& element) {
    return header_.ascii ? read_element(TextScanner{cursor_}, element)
                         : read_element(BinaryScanner{cursor_, header_.order}, element);
  };
  for (const PlyElement& element : header_.elements) {
    if (auto ok = check_claim(element); !ok) return ok.error();
    if (auto ok = read_any(element); !ok) return ok.error();
  }
  if (!has_vertices_) return cursor_.byte_error("the file has no element 'vertex'");
  const bool more = header_.ascii ? cursor_.next_filled_line() : !cursor_.at_end();
  if (more) {
    file_.notes.push_back(
        fmt::format("{} bytes after the last element are left out", cursor_.remaining()));
  }
  for (const auto& [place, element] : deferred_) {
    cursor_ = place;
    if (auto ok = read_any(*element); !ok) return ok.error();
  }
  file_.grid = header_.facts.grid;
  file_.viewpoint = header_.facts.viewpoint;
  return std::move(file_);
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
