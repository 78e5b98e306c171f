#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "burnish/io/faces.h"
#include "burnish/io/finish.h"
#include "burnish/io/number_type.h"
#include "burnish/io/obj.h"
#include "burnish/io/vertex_columns.h"

namespace burnish {
namespace {

constexpr TextStyle kStyle{.comment = '#', .continuation = '\\'};
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& name, const Vec3d& origin,
            const Context& context)
      : bytes_(bytes), name_(name), origin_(origin), context_(context) {}

  Result<GeometryFile> read();

 private:
  using Rule = Result<void> (ObjReader::*)(Cursor&, std::string_view key);

  /// Calls `rule` for every line. Faces come in a second pass, when all vertices are known.
  Result<void> for_each_line(double from, double to, Rule rule);
  Result<void> count_line(Cursor& cursor, std::string_view key);
  Result<void> vertex_line(Cursor& cursor, std::string_view key);
  Result<void> face_line(Cursor& cursor, std::string_view key);
  Result<void> read_vertex(Cursor& cursor);
  Result<void> read_normal(Cursor& cursor);
  Result<void> read_face(Cursor& cursor);
  Result<bool> read_corner(Cursor& cursor);
  void use_normal(std::size_t vertex, std::int64_t normal);
  void finish_normals();
  void finish_colors();

  std::string_view bytes_;
  const std::string& name_;
  Vec3d origin_;
  const Context& context_;
  GeometryFile file_;
  std::vector<Vec3f> normals_;
  std::vector<std::uint32_t> normal_of_;  ///< per vertex, 0 = none yet, else the number of `vn`
  std::vector<float> colors_;             ///< 4 per vertex
  std::map<std::string, std::size_t, std::less<>> skipped_;
  std::optional<FaceList> faces_;
  std::vector<std::int64_t> corners_;
  std::size_t vertices_ = 0, vertex_normals_ = 0, triangles_ = 0;  ///< counted by the running pass
  std::size_t first_color_ = 0;
  bool one_to_one_ = true;  ///< every face so far gives vertex i the normal i
  bool has_w_ = false, ambiguous_ = false, uses_normals_ = false, some_without_color_ = false;
};

Result<void> ObjReader::for_each_line(double from, double to, Rule rule) {
  Cursor cursor(bytes_, name_, kStyle);
  if (bytes_.starts_with("\xef\xbb\xbf")) cursor.take(3);
  vertices_ = vertex_normals_ = 0;
  for (std::size_t lines = 0; cursor.next_filled_line(); ++lines) {
    if (lines % 4096 == 0) {
      if (context_.cancelled()) return cancelled();
      context_.progress(from + (to - from) * static_cast<double>(cursor.offset()) /
                                   static_cast<double>(bytes_.size()));
    }
    if (auto ok = (this->*rule)(cursor, cursor.word()); !ok) return ok;
    cursor.next_line();
  }
  return {};
}

/// Counts first, so that every array is allocated once at its size.
Result<void> ObjReader::count_line(Cursor& cursor, std::string_view key) {
  if (key == "v")
    ++vertices_;
  else if (key == "vn")
    ++vertex_normals_;
  else if (key == "f") {
    std::size_t corners = 0;
    while (!cursor.word().empty()) ++corners;
    if (corners > 2) triangles_ += corners - 2;
  }
  return {};
}

Result<void> ObjReader::vertex_line(Cursor& cursor, std::string_view key) {
  if (key == "v") return read_vertex(cursor);
  if (key == "vn") return read_normal(cursor);
  if (key != "f" && skipped_.size() < 64) {
    const std::string name = shown(key);
    const auto known = skipped_.find(name);
    if (known != skipped_.end())
      ++known->second;
    else
      skipped_.emplace(name, 1);
  }
  return {};
}

Result<void> ObjReader::face_line(Cursor& cursor, std::string_view key) {
  if (key == "v")
    ++vertices_;
  else if (key == "vn")
    ++vertex_normals_;
  else if (key == "f")
    return read_face(cursor);
  return {};
}

Result<void> ObjReader::read_vertex(Cursor& cursor) {
  Vec3f p;
  if (origin_ == Vec3d{}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!cursor.number(p[axis])) return cursor.line_error("'v' was expected to have 3 numbers");
    }
  } else {
    Vec3d wide;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!cursor.number(wide[axis]))
        return cursor.line_error("'v' was expected to have 3 numbers");
    }
    p = Vec3f(wide - origin_);
  }
  file_.mesh.positions.push_back(p);
  if (cursor.at_line_end()) {
    if (!colors_.empty()) colors_.insert(colors_.end(), 4, kNan);
    some_without_color_ = true;
    return {};
  }
  float extra[4];
  std::size_t count = 0;
  while (count < 4 && cursor.number(extra[count])) ++count;
  if (!cursor.at_line_end() || count == 2) {
    return cursor.line_error("'v' was expected to have 3, 4, 6 or 7 numbers");
  }
  if (count != 3) has_w_ = true;
  if (count == 1) {
    if (!colors_.empty()) colors_.insert(colors_.end(), 4, kNan);
    some_without_color_ = true;
    return {};
  }
  const float* rgb = extra + (count - 3);
  if (colors_.empty()) {
    colors_.reserve(4 * file_.mesh.positions.capacity());
    colors_.resize(4 * (file_.mesh.positions.size() - 1), kNan);
  }
  colors_.insert(colors_.end(), {rgb[0], rgb[1], rgb[2], kNan});
  return {};
}

Result<void> ObjReader::read_normal(Cursor& cursor) {
  Vec3f n;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!cursor.number(n[axis])) return cursor.line_error("'vn' was expected to have 3 numbers");
  }
  normals_.push_back(n);
  return {};
}

/// One corner: i, i/t, i/t/n or i//n, each counted from 1 or, if negative, back from the last one.
Result<bool> ObjReader::read_corner(Cursor& cursor) {
  const std::string_view word = cursor.word();
  if (word.empty()) return false;
  const auto bad = [&] {
    return cursor.line_error(
        fmt::format("'{}' is no corner of a face (i, i/t, i/t/n or i//n)", shown(word)));
  };
  const char* at = word.data();
  const char* end = at + word.size();
  std::int64_t parts[3] = {0, 0, 0};
  for (int part = 0; part < 3; ++part) {
    const auto [stop, status] = std::from_chars(at, end, parts[part]);
    if (status != std::errc{} && (part == 0 || stop != at || (stop != end && *stop != '/')))
      return bad();
    at = stop;
    if (at == end) break;
    if (*at++ != '/' || part == 2) return bad();
  }
  const std::int64_t vertex =
      parts[0] > 0 ? parts[0] - 1 : parts[0] + static_cast<std::int64_t>(vertices_);
  const auto count = static_cast<std::int64_t>(file_.mesh.positions.size());
  if (parts[0] == 0 || vertex < 0 || vertex >= count) {
    return cursor.line_error(fmt::format("the face names vertex {} of {}{}", parts[0],
                                         parts[0] < 0 ? vertices_ : file_.mesh.positions.size(),
                                         parts[0] == 0 ? " (they are counted from 1)" : ""));
  }
  corners_.push_back(vertex);
  if (parts[2] != 0) {
    const std::int64_t normal =
        parts[2] > 0 ? parts[2] - 1 : parts[2] + static_cast<std::int64_t>(vertex_normals_);
    if (normal < 0 || normal >= static_cast<std::int64_t>(normals_.size())) {
      return cursor.line_error(
          fmt::format("the face names normal {} of {}", parts[2], normals_.size()));
    }
    use_normal(static_cast<std::size_t>(vertex), normal);
  }
  return true;
}

void ObjReader::use_normal(std::size_t vertex, std::int64_t normal) {
  uses_normals_ = true;
  if (static_cast<std::int64_t>(vertex) != normal) one_to_one_ = false;
  if (ambiguous_) return;
  if (normal_of_.empty()) normal_of_.resize(file_.mesh.positions.size());
  std::uint32_t& known = normal_of_[vertex];
  const auto number = static_cast<std::uint32_t>(normal + 1);
  if (known == 0)
    known = number;
  else if (known != number && normals_[known - 1] != normals_[number - 1])
    ambiguous_ = true;
}

Result<void> ObjReader::read_face(Cursor& cursor) {
  corners_.clear();
  for (;;) {
    const auto more = read_corner(cursor);
    if (!more) return more.error();
    if (!*more) break;
  }
  if (auto ok = faces_->add(corners_); !ok)
    return cursor.line_error(ok.error().message, ok.error().code);
  return {};
}

void ObjReader::finish_normals() {
  std::vector<Vec3f>& normals = file_.mesh.attributes.normals;
  if (normals_.empty()) return;
  if (one_to_one_ && normals_.size() == file_.mesh.positions.size()) {
    normals = std::move(normals_);
  } else if (!uses_normals_) {
    file_.notes.push_back("normals that no face uses are left out");
  } else if (ambiguous_) {
    file_.notes.push_back("normals are left out: some vertices have more than one");
  } else {
    normals.resize(file_.mesh.positions.size());
    for (std::size_t v = 0; v < normals.size(); ++v) {
      if (normal_of_[v] != 0) normals[v] = normals_[normal_of_[v] - 1];
    }
  }
}

void ObjReader::finish_colors() {
  if (colors_.empty()) return;
  const bool up_to_255 = std::any_of(colors_.begin(), colors_.end(), [](float c) { return c > 1; });
  file_.mesh.attributes.colors = colors_from_floats(colors_, up_to_255);
  if (some_without_color_) file_.notes.push_back("vertices without a colour are white");
}

Result<GeometryFile> ObjReader::read() {
  if (auto ok = for_each_line(0, 0.2, &ObjReader::count_line); !ok) return ok.error();
  if (vertices_ > 0xffffffffu)
    return Error{ErrorCode::unsupported, "more than 4294967295 vertices", name_};
  if (vertices_ == 0) {
    return Error{ErrorCode::bad_file, "no line begins with 'v', an OBJ file has vertices", name_};
  }
  file_.mesh.positions.reserve(vertices_);
  normals_.reserve(vertex_normals_);
  if (auto ok = for_each_line(0.2, 0.6, &ObjReader::vertex_line); !ok) return ok.error();
  file_.mesh.triangles.reserve(triangles_);
  file_.mesh.frame.origin = origin_;
  faces_.emplace(file_.mesh.positions, file_.mesh.triangles);
  if (auto ok = for_each_line(0.6, 1, &ObjReader::face_line); !ok) return ok.error();
  faces_->note(file_.notes);
  finish_normals();
  finish_colors();
  if (has_w_) file_.notes.push_back("the weights w of the vertices are left out");
  std::string list;
  for (const auto& [key, count] : skipped_)
    list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", key, count);
  if (!list.empty()) file_.notes.push_back("statements left out: " + list);
  return std::move(file_);
}

}  // namespace

bool recognise_obj(std::string_view bytes) {
  Cursor cursor(bytes.substr(0, 16384), {}, kStyle);
  if (bytes.starts_with("\xef\xbb\xbf")) cursor.take(3);
  for (int line = 0; line < 200 && cursor.next_filled_line(); ++line) {
    const std::string_view key = cursor.word();
    double number = 0;
    if (key == "v") return cursor.number(number) && cursor.number(number) && cursor.number(number);
    constexpr std::string_view kKeys[] = {"vt", "vn", "vp", "f",      "p",     "l",
                                          "o",  "g",  "s",  "mtllib", "usemtl"};
    if (std::find(std::begin(kKeys), std::end(kKeys), key) == std::end(kKeys)) return false;
    cursor.next_line();
  }
  return false;
}

Result<GeometryFile> read_obj(std::string_view bytes, const std::string& name,
                              const Context& context) {
  auto file = read_with_origin(
      [&](const Vec3d& origin) { return ObjReader(bytes, name, origin, context).read(); });
  if (!file) return file;
  return finish_reading(std::move(*file), name);
}

}  // namespace burnish
