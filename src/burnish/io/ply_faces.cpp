#include <fmt/format.h>

#include "burnish/io/faces.h"
#include "burnish/io/ply_scanner.h"

namespace burnish {
namespace {

template <class Scanner>
class FaceReader {
 public:
  FaceReader(PlyBody& body, Scanner scan, const PlyElement& element, const PlyProperty& indices)
      : body_(body),
        cursor_(body.cursor),
        scan_(scan),
        element_(element),
        indices_(indices),
        strips_(element.name == "tristrips"),
        // What a list takes while it is read must stay within the memory allowed for the file.
        most_corners_(strips_ ? ((std::size_t{48} << 20) + 6 * body.size) / 20 : kMaxCorners),
        triangles_(body.file.mesh.triangles),
        faces_(body.file.mesh.positions, triangles_) {}

  Result<void> read();

 private:
  bool has_plain_triangles() const;
  std::size_t read_run(std::size_t most);
  Result<void> read_face();
  bool read_corners();
  Result<void> reserve_for_polygons();
  std::string what() const {
    return fmt::format("{} {} of {}", element_.name, face_, element_.count);
  }

  PlyBody& body_;
  Cursor& cursor_;
  Scanner scan_;
  const PlyElement& element_;
  const PlyProperty& indices_;
  bool strips_;
  std::size_t most_corners_;
  std::vector<Triangle>& triangles_;
  FaceList faces_;
  std::vector<std::int64_t> corners_;
  std::size_t face_ = 0;
  bool looked_ahead_ = false;
};

template <class Scanner>
Result<void> FaceReader<Scanner>::read() {
  const std::size_t least =
      body_.header.ascii ? 8 : size_of(*indices_.list_count) + 3 * size_of(indices_.type);
  triangles_.reserve(triangles_.size() +
                     std::min<std::size_t>(element_.count, cursor_.remaining() / least + 1));
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

/// Whether triangles are rows that read_run knows.
template <class Scanner>
bool FaceReader<Scanner>::has_plain_triangles() const {
  const auto& properties = element_.properties;
  const bool one_list = std::count_if(properties.begin(), properties.end(),
                                      [](const auto& p) { return p.list_count.has_value(); }) == 1;
  const bool simple_types = size_of(*indices_.list_count) <= 4 && size_of(indices_.type) == 4 &&
                            !is_floating(indices_.type);
  if (strips_ || !one_list || !simple_types) return false;
  if constexpr (std::is_same_v<Scanner, TextScanner>) return properties.size() == 1;
  return size_of(*indices_.list_count) == 1;
}

/// The fast way through faces that are triangles of known vertices: lines of four integers. Gives
/// the number of rows read, at most `most`.
template <>
std::size_t FaceReader<TextScanner>::read_run(std::size_t most) {
  const std::size_t count = body_.file.mesh.positions.size();
  for (std::size_t rows = 0; rows < most; ++rows) {
    const Cursor::Place before = cursor_.place();
    std::array<std::uint32_t, 4> row;
    if (!cursor_.line_of_integers(row)) return rows;
    const auto [corners, a, b, c] = row;
    if (corners != 3 || a >= count || b >= count || c >= count) {
      cursor_.go_to(before);
      return rows;
    }
    triangles_.push_back({a, b, c});
  }
  return most;
}

/// The same for binary rows, which are of one size as long as they are triangles.
template <>
std::size_t FaceReader<BinaryScanner>::read_run(std::size_t most) {
  std::size_t before = 0;
  for (const PlyProperty* p = element_.properties.data(); p != &indices_; ++p)
    before += size_of(p->type);
  const std::size_t row = element_.row_bytes() + sizeof(Triangle);
  const bool swap = scan_.order != std::endian::native;
  const auto count = static_cast<std::uint32_t>(body_.file.mesh.positions.size());
  most = std::min(most, cursor_.remaining() / row);
  const std::byte* at = cursor_.take(0) + before;
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
  if (strips_) triangles_.reserve(triangles_.size() + corners_.size());
  if (auto added = strips_ ? faces_.add_strip(corners_) : faces_.add(corners_); !added) {
    Error error = scan_.error("");
    error.code = added.error().code;
    error.message = added.error().message;
    return error;
  }
  if (!scan_.end_row()) return scan_.error(what());
  ++face_;
  if (corners_.size() <= 3 || strips_ || looked_ahead_) return {};
  looked_ahead_ = true;
  return reserve_for_polygons();
}

/// Reads a row of faces up to its end and keeps the corners; of more than are allowed only one
/// more.
template <class Scanner>
bool FaceReader<Scanner>::read_corners() {
  if (!scan_.begin_row()) return false;
  for (const PlyProperty& p : element_.properties) {
    std::int64_t length = 0;
    if (!read_length(scan_, p, length)) return false;
    if (&p != &indices_) {
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
Result<void> FaceReader<Scanner>::reserve_for_polygons() {
  const Cursor::Place here = cursor_.place();
  std::size_t triangles = triangles_.size();
  const auto add = [&](const PlyProperty& property, std::int64_t length) {
    if (&property == &indices_ && length > 2) triangles += static_cast<std::size_t>(length) - 2;
  };
  bool ok = true;
  for (std::size_t row = face_; row < element_.count && ok; ++row) {
    if (row % PlyBody::kBlockRows == 0 && body_.context.cancelled()) return cancelled();
    ok = walk_over_row(scan_, element_, add);
  }
  cursor_.go_to(here);
  if (triangles * sizeof(Triangle) > (std::size_t{48} << 20) + 7 * body_.size) {
    return cursor_.byte_error(
        fmt::format("the polygons make {} triangles, more than fits the memory allowed for a file "
                    "of {} bytes",
                    triangles, body_.size),
        ErrorCode::unsupported);
  }
  triangles_.reserve(triangles);
  return {};
}

}  // namespace

Result<void> read_ply_faces(PlyBody& body, const PlyElement& element, const PlyProperty& indices) {
  for (const PlyProperty& p : element.properties) {
    if (&p == &indices) continue;
    body.file.notes.push_back("the property '" + shown(p.name) + "' of '" + element.name +
                              "' is left out");
  }
  return with_scanner(body,
                      [&](auto scan) { return FaceReader(body, scan, element, indices).read(); });
}

}  // namespace burnish
