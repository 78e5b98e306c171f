#include <fmt/format.h>

#include "burnish/io/faces.h"
#include "burnish/io/ply_scanner.h"

namespace burnish {
namespace {

/// What is read of a face: its corners, and what holds for the triangles that it is cut into.
struct FaceProperties {
  const PlyProperty& indices;
  const PlyProperty* origin = nullptr;  ///< null: there is none
  const PlyProperty* owner = nullptr;

  std::size_t bytes_per_triangle() const {
    return sizeof(Triangle) + (origin ? sizeof(Origin) : 0) + (owner ? sizeof(std::uint32_t) : 0);
  }
};

template <class Scanner>
class FaceReader {
 public:
  FaceReader(PlyBody& body, Scanner scan, const PlyElement& element, const FaceProperties& known)
      : body_(body),
        cursor_(body.cursor),
        scan_(scan),
        element_(element),
        known_(known),
        strips_(element.name == "tristrips"),
        // What a list takes while it is read must stay within the memory allowed for the file.
        most_corners_(strips_ ? ((std::size_t{48} << 20) + 6 * body.size) /
                                    (sizeof(std::int64_t) + known.bytes_per_triangle())
                              : kMaxCorners),
        triangles_(body.file.mesh.triangles),
        attributes_(body.file.mesh.triangle_attributes),
        faces_(body.file.mesh.positions, triangles_) {}

  Result<void> read();

 private:
  bool has_plain_triangles() const;
  std::size_t offset_of(const PlyProperty& property) const;
  template <class T>
  void append_column(const PlyProperty* property, const std::byte* rows, std::size_t count,
                     std::vector<T>& values);
  void reserve(std::size_t triangles);
  std::size_t read_run(std::size_t most);
  Result<void> read_face();
  bool read_corners();
  Result<void> look_ahead();
  std::string what() const {
    return fmt::format("{} {} of {}", element_.name, face_, element_.count);
  }

  PlyBody& body_;
  Cursor& cursor_;
  Scanner scan_;
  const PlyElement& element_;
  const FaceProperties& known_;
  bool strips_;
  std::size_t most_corners_;
  std::vector<Triangle>& triangles_;
  TriangleAttributes& attributes_;
  FaceList faces_;
  std::vector<std::int64_t> corners_;  ///< of the face that is read, and its values
  std::int64_t origin_ = 0, owner_ = 0;
  std::size_t face_ = 0;
  bool looked_ahead_ = false;
};

template <class Scanner>
Result<void> FaceReader<Scanner>::read() {
  const std::size_t least = body_.header.ascii
                                ? 6 + 2 * element_.properties.size()
                                : element_.row_bytes() + 3 * size_of(known_.indices.type);
  reserve(triangles_.size() +
          std::min<std::size_t>(element_.count, cursor_.remaining() / least + 1));
  if (strips_) {
    if (auto ok = look_ahead(); !ok) return ok;
  }
  const bool plain = has_plain_triangles();
  while (face_ < element_.count) {
    constexpr std::size_t kBlock = PlyBody::kBlockRows;
    if (face_ % kBlock == 0 && !body_.keep_going()) return cancelled();
    const std::size_t block_end =
        std::min<std::size_t>(element_.count, (face_ / kBlock + 1) * kBlock);
    const std::size_t run = plain ? read_run(block_end - face_) : 0;
    face_ += run;
    faces_.count(run);
    if (run > 0) continue;
    if (auto ok = read_face(); !ok) return ok;
  }
  faces_.note(body_.file.notes);
  return {};
}

template <class Scanner>
void FaceReader<Scanner>::reserve(std::size_t triangles) {
  triangles_.reserve(triangles);
  if (known_.origin) attributes_.origin.reserve(triangles);
  if (known_.owner) attributes_.owner.reserve(triangles);
}

/// Whether triangles are rows that read_run knows.
template <class Scanner>
bool FaceReader<Scanner>::has_plain_triangles() const {
  const auto& properties = element_.properties;
  const bool one_list = std::count_if(properties.begin(), properties.end(),
                                      [](const auto& p) { return p.list_count.has_value(); }) == 1;
  const PlyProperty& indices = known_.indices;
  const bool simple_types =
      size_of(*indices.list_count) <= 4 && size_of(indices.type) == 4 && !is_floating(indices.type);
  if (strips_ || !one_list || !simple_types) return false;
  if constexpr (std::is_same_v<Scanner, TextScanner>) {
    return &indices == properties.data() &&
           std::all_of(properties.begin() + 1, properties.end(),
                       [&](const auto& p) { return &p == known_.origin || &p == known_.owner; });
  }
  return size_of(*indices.list_count) == 1;
}

/// Where a property lies in the row of a triangle.
template <class Scanner>
std::size_t FaceReader<Scanner>::offset_of(const PlyProperty& property) const {
  std::size_t offset = 0;
  for (const PlyProperty* p = element_.properties.data(); p != &property; ++p)
    offset += p->list_count ? size_of(*p->list_count) + sizeof(Triangle) : size_of(p->type);
  return offset;
}

/// Appends the values of a property in `count` rows that are triangles.
template <class Scanner>
template <class T>
void FaceReader<Scanner>::append_column(const PlyProperty* property, const std::byte* rows,
                                        std::size_t count, std::vector<T>& values) {
  if (!property) return;
  const std::size_t stride = element_.row_bytes() + sizeof(Triangle);
  const bool swap = body_.header.order != std::endian::native;
  const std::byte* at = rows + offset_of(*property);
  for (std::size_t i = 0; i < count; ++i, at += stride) values.push_back(load<T>(at, swap));
}

/// The fast way through faces that are triangles of known vertices: lines of four integers, and one
/// more for each property that is kept. Gives the number of rows read, at most `most`.
template <>
std::size_t FaceReader<TextScanner>::read_run(std::size_t most) {
  const std::size_t count = body_.file.mesh.positions.size();
  std::array<std::uint32_t, 6> row{};
  const std::span<std::uint32_t> numbers(row.data(), 3 + element_.properties.size());
  const auto value_of = [&](const PlyProperty* property) {
    return property ? row[3 + static_cast<std::size_t>(property - element_.properties.data())] : 0;
  };
  for (std::size_t rows = 0; rows < most; ++rows) {
    const Cursor::Place before = cursor_.place();
    if (!cursor_.line_of_integers(numbers)) return rows;
    const Triangle triangle{row[1], row[2], row[3]};
    const std::uint32_t origin = value_of(known_.origin);
    const bool known = triangle[0] < count && triangle[1] < count && triangle[2] < count;
    if (row[0] != 3 || !known || origin > 255) {
      cursor_.go_to(before);
      return rows;
    }
    triangles_.push_back(triangle);
    if (known_.origin) attributes_.origin.push_back(static_cast<Origin>(origin));
    if (known_.owner) attributes_.owner.push_back(value_of(known_.owner));
  }
  return most;
}

/// The same for binary rows, which are of one size as long as they are triangles.
template <>
std::size_t FaceReader<BinaryScanner>::read_run(std::size_t most) {
  const std::size_t row = element_.row_bytes() + sizeof(Triangle);
  const bool swap = scan_.order != std::endian::native;
  const auto count = static_cast<std::uint32_t>(body_.file.mesh.positions.size());
  most = std::min(most, cursor_.remaining() / row);
  const std::byte* first = cursor_.take(0);
  const std::byte* at = first + offset_of(known_.indices);
  std::size_t rows = 0;
  for (; rows < most && *at == std::byte{3}; ++rows, at += row) {
    Triangle triangle;
    std::memcpy(triangle.data(), at + 1, sizeof(Triangle));
    if (swap) {
      for (std::uint32_t& v : triangle) v = byte_swapped(v);
    }
    if (triangle[0] >= count || triangle[1] >= count || triangle[2] >= count) break;
    triangles_.push_back(triangle);
  }
  append_column(known_.origin, first, rows, attributes_.origin);
  append_column(known_.owner, first, rows, attributes_.owner);
  cursor_.take(rows * row);
  return rows;
}

template <class Scanner>
Result<void> FaceReader<Scanner>::read_face() {
  if (!read_corners()) return scan_.error(what());
  if (corners_.size() > most_corners_) {
    return cursor_.byte_error(fmt::format("{} has more than {} corners", what(), most_corners_),
                              ErrorCode::unsupported);
  }
  const std::size_t before = triangles_.size();
  if (auto added = strips_ ? faces_.add_strip(corners_) : faces_.add(corners_); !added) {
    Error error = scan_.error("");
    error.code = added.error().code;
    error.message = added.error().message;
    return error;
  }
  const std::size_t made = triangles_.size() - before;
  if (known_.origin)
    attributes_.origin.insert(attributes_.origin.end(), made, static_cast<Origin>(origin_));
  if (known_.owner)
    attributes_.owner.insert(attributes_.owner.end(), made, static_cast<std::uint32_t>(owner_));
  if (!scan_.end_row()) return scan_.error(what());
  ++face_;
  return corners_.size() <= 3 || looked_ahead_ ? Result<void>{} : look_ahead();
}

/// Reads a row of faces up to its end and keeps the corners, of more than are allowed only one
/// more, and the values that are known.
template <class Scanner>
bool FaceReader<Scanner>::read_corners() {
  if (!scan_.begin_row()) return false;
  for (const PlyProperty& p : element_.properties) {
    std::int64_t length = 0;
    if (&p == known_.origin || &p == known_.owner) {
      if (!read_integer(scan_, p.type, &p == known_.origin ? origin_ : owner_)) return false;
      continue;
    }
    if (!read_length(scan_, p, length)) return false;
    if (&p != &known_.indices) {
      if (!scan_.skip(p.type, static_cast<std::uint64_t>(length))) return false;
      continue;
    }
    if (static_cast<std::uint64_t>(length) > scan_.most(p.type)) return false;
    corners_.clear();
    for (std::int64_t i = 0, corner = 0; i < length; ++i) {
      if (!read_integer(scan_, p.type, corner)) return false;
      if (corners_.size() <= most_corners_) corners_.push_back(corner);
    }
  }
  return true;
}

/// Looks ahead over all faces that are left and reserves for their triangles: growing step by step
/// would take twice the memory at times. What a damaged count says here is found out by the reading
/// itself.
template <class Scanner>
Result<void> FaceReader<Scanner>::look_ahead() {
  looked_ahead_ = true;
  const Cursor::Place here = cursor_.place();
  std::size_t triangles = triangles_.size();
  const auto add = [&](const PlyProperty& property, std::int64_t length) {
    if (&property == &known_.indices && length > 2)
      triangles += static_cast<std::size_t>(length) - 2;
  };
  bool ok = true;
  for (std::size_t row = face_; row < element_.count && ok; ++row) {
    if (row % PlyBody::kBlockRows == 0 && body_.context.cancelled()) return cancelled();
    ok = walk_over_row(scan_, element_, add);
  }
  cursor_.go_to(here);
  if (triangles * known_.bytes_per_triangle() > (std::size_t{48} << 20) + 7 * body_.size) {
    return cursor_.byte_error(
        fmt::format("the polygons make {} triangles, more than fits the memory allowed for a file "
                    "of {} bytes",
                    triangles, body_.size),
        ErrorCode::unsupported);
  }
  reserve(triangles);
  return {};
}

const PlyProperty* property_of(const PlyElement& element, std::string_view name, NumberType type) {
  const auto found = std::find_if(
      element.properties.begin(), element.properties.end(),
      [&](const PlyProperty& p) { return p.name == name && p.type == type && !p.list_count; });
  return found == element.properties.end() ? nullptr : &*found;
}

}  // namespace

Result<void> read_ply_faces(PlyBody& body, const PlyElement& element, const PlyProperty& indices) {
  const FaceProperties known{indices, property_of(element, "origin", NumberType::uint8),
                             property_of(element, "owner", NumberType::uint32)};
  for (const PlyProperty& p : element.properties) {
    if (&p == &indices || &p == known.origin || &p == known.owner) continue;
    body.file.notes.push_back("the property '" + shown(p.name) + "' of '" + element.name +
                              "' is left out");
  }
  return with_scanner(body,
                      [&](auto scan) { return FaceReader(body, scan, element, known).read(); });
}

void check_triangle_attributes(GeometryFile& file) {
  auto& [origin, owner] = file.mesh.triangle_attributes;
  const auto check = [&](auto& values, std::string_view name, auto is_wrong) {
    const auto wrong = std::find_if(values.begin(), values.end(), is_wrong);
    std::string problem;
    if (wrong != values.end()) {
      problem = fmt::format("{} is none", static_cast<std::uint32_t>(*wrong));
    } else if (!values.empty() && values.size() != file.mesh.triangles.size()) {
      problem = "not all faces have one";
    } else {
      return;
    }
    values.clear();
    file.notes.push_back(fmt::format("the property '{}' of faces is left out: {}", name, problem));
  };
  check(origin, "origin", [](Origin value) { return value > Origin::invented; });
  check(owner, "owner",
        [count = file.mesh.positions.size()](std::uint32_t v) { return v >= count; });
}

}  // namespace burnish
