#include "burnish/io/off.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "burnish/io/faces.h"
#include "burnish/io/finish.h"
#include "burnish/io/output.h"
#include "burnish/io/text_rows.h"
#include "burnish/io/vertex_columns.h"

namespace burnish {
namespace {

constexpr TextStyle kStyle{.comment = '#'};

/// The letters before OFF.
struct Prefix {
  bool texture = false, colors = false, normals = false, four = false, any_dimension = false;
};

std::optional<Prefix> parse_prefix(std::string_view word) {
  if (!word.ends_with("OFF")) return std::nullopt;
  word.remove_suffix(3);
  Prefix prefix;
  const auto eat = [&](std::string_view letters) {
    if (!word.starts_with(letters)) return false;
    word.remove_prefix(letters.size());
    return true;
  };
  prefix.texture = eat("ST");
  prefix.colors = eat("C");
  prefix.normals = eat("N");
  prefix.four = eat("4");
  prefix.any_dimension = eat("n");
  return word.empty() ? std::optional<Prefix>(prefix) : std::nullopt;
}

class OffReader {
 public:
  OffReader(std::string_view bytes, const std::string& name, const Vec3d& origin,
            const Context& context)
      : cursor_(bytes, name, kStyle), origin_(origin), context_(context), size_(bytes.size()) {
    if (bytes.starts_with("\xef\xbb\xbf")) cursor_.take(3);
  }

  Result<GeometryFile> read();

 private:
  bool keep_going() {
    context_.progress(static_cast<double>(cursor_.offset()) / static_cast<double>(size_));
    return !context_.cancelled();
  }
  Result<void> read_header();
  Result<void> read_vertex(std::uint64_t index);
  Result<void> read_color(std::uint64_t index);
  Result<void> read_face(std::uint64_t index, FaceList& faces);

  Cursor cursor_;
  Vec3d origin_;
  const Context& context_;
  std::size_t size_;
  Prefix prefix_;
  std::uint64_t vertex_count_ = 0, face_count_ = 0;
  GeometryFile file_;
  std::vector<float> colors_;
  std::vector<std::int64_t> corners_;
  bool fractions_ = false, face_colors_ = false;
};

Result<void> OffReader::read_header() {
  if (!cursor_.next_filled_line()) return cursor_.line_error("the file has no header");
  const Cursor start = cursor_;
  const auto prefix = parse_prefix(cursor_.word());
  if (prefix) {
    prefix_ = *prefix;
  } else {
    cursor_ = start;  // the word OFF may be missing
  }
  if (prefix_.four || prefix_.any_dimension) {
    return cursor_.line_error("only points with 3 coordinates are supported",
                              ErrorCode::unsupported);
  }
  if (!cursor_.next_filled_line()) return cursor_.line_error("the file ends before the counts");
  const Cursor counts = cursor_;
  if (cursor_.word() == "BINARY")
    return cursor_.line_error("binary OFF is not supported", ErrorCode::unsupported);
  cursor_ = counts;
  if (!cursor_.number(vertex_count_) || !cursor_.number(face_count_)) {
    return cursor_.line_error("the counts of vertices, faces and edges were expected");
  }
  std::uint64_t edges = 0;
  if (!cursor_.at_line_end() && !cursor_.number(edges))
    return cursor_.line_error("the count of edges is no number");
  if (!cursor_.at_line_end()) return cursor_.line_error("nothing was expected behind the counts");
  // A vertex takes 6 bytes ("0 0 0" and the end of the line), a face 2.
  const std::uint64_t left = cursor_.remaining() + 1;
  if (vertex_count_ > left / 6 || face_count_ > left / 2) {
    return cursor_.line_error(
        fmt::format("the header claims {} vertices and {} faces, {} bytes are left", vertex_count_,
                    face_count_, cursor_.remaining()));
  }
  if (vertex_count_ > 0xffffffffu)
    return cursor_.line_error("more than 4294967295 vertices", ErrorCode::unsupported);
  cursor_.next_line();
  return {};
}

/// What is left on the line of a vertex, and stands before texture coordinates: a colour or
/// nothing.
Result<void> OffReader::read_color(std::uint64_t index) {
  float values[6];
  std::size_t count = 0;
  while (count < 6 && !cursor_.at_line_end()) {
    Cursor ahead = cursor_;
    fractions_ = fractions_ || ahead.word().find_first_of(".eE") != std::string_view::npos;
    if (!cursor_.number(values[count]))
      return cursor_.line_error(fmt::format("vertex {} has a word that is no number", index));
    ++count;
  }
  if (prefix_.texture && count >= 2) count -= 2;
  if (!cursor_.at_line_end() || (count != 0 && count != 3 && count != 4)) {
    return cursor_.line_error(fmt::format(
        "vertex {} has {} numbers beyond its coordinates, 3 or 4 of a colour were expected", index,
        count));
  }
  if (count == 0 && colors_.empty()) return {};
  if (colors_.empty()) {
    colors_.reserve(4 * vertex_count_);
    colors_.resize(4 * index, std::numeric_limits<float>::quiet_NaN());
  }
  for (std::size_t part = 0; part < 4; ++part) {
    colors_.push_back(part < count ? values[part] : std::numeric_limits<float>::quiet_NaN());
  }
  return {};
}

Result<void> OffReader::read_vertex(std::uint64_t index) {
  const auto missing = [&] {
    return cursor_.line_error(fmt::format("vertex {} of {} was expected to have {} numbers", index,
                                          vertex_count_, prefix_.normals ? 6 : 3));
  };
  if (!cursor_.next_filled_line()) return missing();
  Vec3f p;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double wide = 0;
    if (!(origin_ == Vec3d{} ? cursor_.number(p[axis]) : cursor_.number(wide))) return missing();
    if (origin_ != Vec3d{}) p[axis] = static_cast<float>(wide - origin_[axis]);
  }
  file_.mesh.positions.push_back(p);
  if (prefix_.normals) {
    Vec3f n;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!cursor_.number(n[axis])) return missing();
    }
    file_.mesh.attributes.normals.push_back(n);
  }
  if (auto ok = read_color(index); !ok) return ok;
  cursor_.next_line();
  return {};
}

Result<void> OffReader::read_face(std::uint64_t index, FaceList& faces) {
  const auto bad = [&] {
    return cursor_.line_error(fmt::format(
        "face {} of {} was expected: a count and so many vertices", index, face_count_));
  };
  std::uint64_t count = 0;
  if (!cursor_.next_filled_line() || !cursor_.number(count)) return bad();
  if (count > cursor_.remaining() / 2 + 1) return bad();
  corners_.resize(count);
  for (std::int64_t& corner : corners_) {
    if (!cursor_.number(corner)) return bad();
  }
  if (auto ok = faces.add(corners_); !ok)
    return cursor_.line_error(ok.error().message, ok.error().code);
  face_colors_ = face_colors_ || !cursor_.at_line_end();
  cursor_.next_line();
  return {};
}

Result<GeometryFile> OffReader::read() {
  if (auto ok = read_header(); !ok) return ok.error();
  file_.mesh.positions.reserve(vertex_count_);
  if (prefix_.normals) file_.mesh.attributes.normals.reserve(vertex_count_);
  for (std::uint64_t v = 0; v < vertex_count_; ++v) {
    if (v % 4096 == 0 && !keep_going()) return cancelled();
    if (auto ok = read_vertex(v); !ok) return ok.error();
  }
  file_.mesh.triangles.reserve(std::min<std::uint64_t>(face_count_, cursor_.remaining() / 8 + 1));
  FaceList faces(file_.mesh.positions, file_.mesh.triangles);
  for (std::uint64_t f = 0; f < face_count_; ++f) {
    if (f % 4096 == 0 && !keep_going()) return cancelled();
    if (auto ok = read_face(f, faces); !ok) return ok.error();
  }
  faces.note(file_.notes);
  if (cursor_.next_filled_line()) {
    file_.notes.push_back(
        fmt::format("{} bytes after the last face are left out", cursor_.remaining()));
  }
  if (!colors_.empty()) file_.mesh.attributes.colors = colors_from_floats(colors_, !fractions_);
  if (prefix_.texture) file_.notes.push_back("texture coordinates are left out");
  if (face_colors_) file_.notes.push_back("the colours of the faces are left out");
  file_.mesh.frame.origin = origin_;
  return std::move(file_);
}

}  // namespace

bool recognise_off(std::string_view bytes) {
  Cursor cursor(bytes.substr(0, 4096), {}, kStyle);
  if (bytes.starts_with("\xef\xbb\xbf")) cursor.take(3);
  return cursor.next_filled_line() && parse_prefix(cursor.word()).has_value();
}

Result<GeometryFile> read_off(std::string_view bytes, const std::string& name,
                              const Context& context) {
  auto file = read_with_origin(
      [&](const Vec3d& origin) { return OffReader(bytes, name, origin, context).read(); });
  if (!file) return file;
  return finish_reading(std::move(*file), name);
}

void write_off(Output& out, const GeometryView& view, const WriteOptions& options) {
  const Attributes& attributes = view.attributes;
  if (!attributes.colors.empty()) out.character('C');
  if (!attributes.normals.empty()) out.character('N');
  out.text("OFF\n");
  write_comments(out, options);
  out.number(view.positions.size()).character(' ').number(view.triangles.size()).text(" 0\n");
  write_rows(out, view.positions.size(), [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) {
      write_position(out, view, i);
      if (!attributes.normals.empty()) {
        out.character(' ');
        write_vector(out, attributes.normals[i]);
      }
      if (!attributes.colors.empty()) {
        for (const std::uint8_t part : attributes.colors[i]) out.character(' ').number(part);
      }
      out.character('\n');
    }
  });
  write_rows(out, view.triangles.size(), [&](std::size_t first, std::size_t count) {
    for (const auto& [a, b, c] : view.triangles.subspan(first, count)) {
      out.text("3 ").number(a).character(' ').number(b).character(' ').number(c).character('\n');
    }
  });
}

}  // namespace burnish
