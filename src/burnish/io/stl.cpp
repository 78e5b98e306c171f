#include "burnish/io/stl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "burnish/io/finish.h"
#include "burnish/io/number_type.h"
#include "burnish/io/output.h"
#include "burnish/io/text_rows.h"
#include "burnish/io/welder.h"

namespace burnish {
namespace {

constexpr std::size_t kHeaderBytes = 84, kFacetBytes = 50;

std::string lower(std::string_view word) {
  std::string text(word.substr(0, 16));
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return text;
}

std::uint32_t claimed_facets(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof(count));
  return count;
}

bool has_binary_size(std::string_view bytes) {
  return bytes.size() >= kHeaderBytes &&
         bytes.size() == kHeaderBytes + kFacetBytes * std::size_t{claimed_facets(bytes)};
}

/// Text that begins with `solid` and goes on with a facet or the end.
bool is_ascii(std::string_view bytes) {
  Cursor cursor(bytes.substr(0, 4096), {});
  if (!cursor.next_filled_line() || lower(cursor.word()) != "solid") return false;
  if (bytes.substr(0, 4096).find('\0') != std::string_view::npos) return false;
  cursor.next_line();
  if (!cursor.next_filled_line()) return true;
  const std::string word = lower(cursor.word());
  return word == "facet" || word == "endsolid";
}

Result<GeometryFile> read_binary(std::string_view bytes, const std::string& name,
                                 const Context& context) {
  Cursor cursor(bytes, name);
  if (!cursor.take(80))
    return cursor.byte_error(
        "the file is too short for STL: text begins with 'solid', binary has 84 bytes");
  std::uint32_t count = 0;
  if (!cursor.read(count)) return cursor.byte_error("the file ends within the header");
  if (count > cursor.remaining() / kFacetBytes) {
    return cursor.byte_error(
        fmt::format("the header claims {} triangles of 50 bytes, {} bytes are left", count,
                    cursor.remaining()));
  }
  GeometryFile file;
  file.mesh.triangles.reserve(count);
  file.mesh.positions.reserve(count / 2 + 2);
  Welder weld(file.mesh.positions);
  bool attributes = false;
  for (std::uint32_t t = 0; t < count; ++t) {
    if (t % 4096 == 0) {
      if (context.cancelled()) return cancelled();
      context.progress(static_cast<double>(t) / count);
    }
    const std::byte* facet = cursor.take(kFacetBytes);
    Triangle& triangle = file.mesh.triangles.emplace_back();
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Vec3f p;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        p[axis] = load<float>(facet + 12 + 12 * corner + 4 * axis,
                              std::endian::native != std::endian::little);
      }
      triangle[corner] = weld(p);
    }
    attributes = attributes || facet[48] != std::byte{0} || facet[49] != std::byte{0};
  }
  if (attributes) file.notes.push_back("the attribute bytes of the triangles are left out");
  if (!cursor.at_end()) {
    file.notes.push_back(
        fmt::format("{} bytes after the last triangle are left out", cursor.remaining()));
  }
  return file;
}

class AsciiStlReader {
 public:
  AsciiStlReader(std::string_view bytes, const std::string& name, const Vec3d& origin,
                 const Context& context)
      : cursor_(bytes, name),
        origin_(origin),
        context_(context),
        size_(bytes.size()),
        weld_(file_.mesh.positions) {}

  Result<GeometryFile> read();

 private:
  Result<void> statement(const std::string& key);
  Result<void> read_vertex();

  Cursor cursor_;
  Vec3d origin_;
  const Context& context_;
  std::size_t size_;
  GeometryFile file_;
  Welder weld_;
  Triangle corners_{};
  std::size_t corner_count_ = 0;
  std::size_t solids_ = 0;
  bool in_solid_ = false, in_facet_ = false;
};

Result<void> AsciiStlReader::read_vertex() {
  if (!in_facet_) return cursor_.line_error("'vertex' outside of a facet");
  if (corner_count_ == 3) return cursor_.line_error("the facet has more than 3 vertices");
  Vec3f p;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double wide = 0;
    const bool ok = origin_ == Vec3d{} ? cursor_.number(p[axis]) : cursor_.number(wide);
    if (!ok) return cursor_.line_error("'vertex' was expected to have 3 numbers");
    if (origin_ != Vec3d{}) p[axis] = static_cast<float>(wide - origin_[axis]);
  }
  corners_[corner_count_++] = weld_(p);
  if (!cursor_.at_line_end()) return cursor_.line_error("'vertex' was expected to have 3 numbers");
  return {};
}

Result<void> AsciiStlReader::statement(const std::string& key) {
  if (key == "vertex") return read_vertex();
  if (key == "facet") {
    if (!in_solid_ || in_facet_) return cursor_.line_error("'facet' was not expected here");
    in_facet_ = true;
    corner_count_ = 0;
  } else if (key == "endfacet") {
    if (!in_facet_ || corner_count_ != 3) {
      return cursor_.line_error(
          fmt::format("the facet ends with {} vertices, 3 were expected", corner_count_));
    }
    in_facet_ = false;
    file_.mesh.triangles.push_back(corners_);
  } else if (key == "solid") {
    if (in_solid_) return cursor_.line_error("'solid' within a solid");
    in_solid_ = true;
    ++solids_;
  } else if (key == "endsolid") {
    if (!in_solid_ || in_facet_) return cursor_.line_error("'endsolid' was not expected here");
    in_solid_ = false;
  } else if (key != "outer" && key != "endloop") {
    return cursor_.line_error(fmt::format("'{}' is no statement of an STL file", shown(key)));
  }
  return {};
}

Result<GeometryFile> AsciiStlReader::read() {
  for (std::size_t line = 0; cursor_.next_filled_line(); ++line) {
    if (line % 4096 == 0) {
      if (context_.cancelled()) return cancelled();
      context_.progress(static_cast<double>(cursor_.offset()) / static_cast<double>(size_));
    }
    if (auto ok = statement(lower(cursor_.word())); !ok) return ok.error();
    cursor_.next_line();
  }
  if (in_solid_) return cursor_.line_error("the file ends without 'endsolid'");
  if (solids_ > 1) file_.notes.push_back(fmt::format("{} solids became one mesh", solids_));
  file_.mesh.frame.origin = origin_;
  return std::move(file_);
}

Vec3f facet_normal(const GeometryView& view, const Triangle& t) {
  const Vec3d p(view.positions[t[0]]);
  return Vec3f(normalized(cross(Vec3d(view.positions[t[1]]) - p, Vec3d(view.positions[t[2]]) - p)));
}

void write_ascii(Output& out, const GeometryView& view) {
  out.text("solid burnish\n");
  write_rows(out, view.triangles.size(), [&](std::size_t first, std::size_t count) {
    for (const Triangle& triangle : view.triangles.subspan(first, count)) {
      out.text("facet normal ");
      write_vector(out, facet_normal(view, triangle));
      out.text("\nouter loop\n");
      for (const std::uint32_t v : triangle) {
        out.text("vertex ");
        write_position(out, view, v);
        out.character('\n');
      }
      out.text("endloop\nendfacet\n");
    }
  });
  out.text("endsolid burnish\n");
}

void write_binary(Output& out, const GeometryView& view) {
  std::array<char, 80> header{"burnish binary STL"};
  out.bytes(header.data(), header.size()).raw(static_cast<std::uint32_t>(view.triangles.size()));
  write_rows(out, view.triangles.size(), [&](std::size_t first, std::size_t count) {
    char* at = out.room(kFacetBytes * count);
    for (const Triangle& t : view.triangles.subspan(first, count)) {
      std::array<Vec3f, 4> facet{facet_normal(view, t)};
      for (std::size_t i = 0; i < 3; ++i) {
        facet[i + 1] = view.framed() ? Vec3f(view.world(t[i])) : view.positions[t[i]];
      }
      std::memcpy(at, facet.data(), sizeof(facet));
      std::memset(at + sizeof(facet), 0, 2);
      at += kFacetBytes;
    }
  });
}

}  // namespace

bool recognise_stl(std::string_view bytes) {
  return has_binary_size(bytes) || is_ascii(bytes);
}

Result<GeometryFile> read_stl(std::string_view bytes, const std::string& name,
                              const Context& context) {
  const bool ascii = !has_binary_size(bytes) && is_ascii(bytes);
  auto file = ascii ? read_with_origin([&](const Vec3d& origin) {
    return AsciiStlReader(bytes, name, origin, context).read();
  })
                    : read_binary(bytes, name, context);
  if (!file) return file;
  return finish_reading(std::move(*file), name);
}

void write_stl(Output& out, const GeometryView& view, const WriteOptions& options) {
  if (view.triangles.size() > 0xffffffffu) {
    return out.fail({ErrorCode::unsupported, "STL holds at most 4294967295 triangles", {}});
  }
  options.ascii ? write_ascii(out, view) : write_binary(out, view);
}

}  // namespace burnish
