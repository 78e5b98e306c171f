#include "burnish/pipeline/progressive_head.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "burnish/pipeline/progressive_bytes.h"
#include "burnish/pipeline/progressive_format.h"

namespace burnish {
namespace {

class HeadReader {
 public:
  HeadReader(Cursor& cursor, const ProgressiveStop& stop, const std::function<bool()>& keep_going)
      : cursor_(cursor), stop_(stop), keep_going_(keep_going) {}

  Result<ProgressiveHead> read();

 private:
  Error expected(const std::string& what) const {
    return cursor_.byte_error(what + " was expected");
  }
  Result<void> read_magic();
  Result<void> read_counts();
  Result<void> read_kept(std::uint64_t count, std::uint64_t total, std::size_t least_bytes);
  void reserve();
  Result<void> read_vertices();
  Result<void> read_triangles();
  Result<void> read_triangle(std::uint32_t index);

  Cursor& cursor_;
  const ProgressiveStop& stop_;
  const std::function<bool()>& keep_going_;
  ProgressiveHead head_;
  std::vector<std::uint32_t> kept_;  ///< which of the original are in the coarse mesh
  std::uint32_t last_ = 0;           ///< the corner before
};

Result<void> HeadReader::read_magic() {
  const Cursor::Place begin = cursor_.place();
  const std::byte* magic = cursor_.take(kProgressiveMagic.size());
  if (!magic || !std::equal(kProgressiveMagic.begin(), kProgressiveMagic.end(),
                            reinterpret_cast<const char*>(magic))) {
    cursor_.go_to(begin);
    return cursor_.byte_error("the file is no progressive mesh of burnish");
  }
  std::uint8_t version = 0;
  if (!cursor_.read(version)) return expected("the version of the format");
  if (version == kProgressiveVersion) return {};
  return cursor_.byte_error(
      fmt::format("the format has version {}, {} is known", version, kProgressiveVersion),
      ErrorCode::unsupported);
}

Result<void> HeadReader::read_counts() {
  ProgressiveFileReport& file = head_.file;
  std::uint64_t records = 0;
  if (!read_number(cursor_, kMostProgressiveVertices + 1, file.vertices))
    return expected("the number of vertices");
  if (!read_number(cursor_, kMostProgressiveTriangles + 1, file.triangles))
    return expected("the number of triangles");
  if (!read_number(cursor_, file.vertices + 1, records))
    return expected("the number of records, at most one a vertex,");
  if (!read_number(cursor_, file.triangles + 1, file.coarse_triangles))
    return expected("the number of coarse triangles");
  file.coarse_vertices = file.vertices - records;
  const std::uint64_t returning = file.triangles - file.coarse_triangles;
  if (returning < records || returning > 2 * records) {
    return cursor_.byte_error(
        fmt::format("{} records cannot bring {} triangles", records, returning));
  }
  if (!cursor_.read(file.coarse_error) || std::signbit(file.coarse_error) ||
      !std::isfinite(file.coarse_error)) {
    return expected("the error of the coarse mesh");
  }
  Vec3d& origin = head_.frame.origin;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!cursor_.read(origin[axis]) || !std::isfinite(origin[axis]))
      return expected("the origin of the frame");
  }
  return {};
}

/// Which `count` of `total` are kept; each has at least so many bytes to come.
Result<void> HeadReader::read_kept(std::uint64_t count, std::uint64_t total,
                                   std::size_t least_bytes) {
  kept_.clear();
  for (std::uint64_t end = 0; kept_.size() < count;) {
    std::uint64_t skipped = 0;
    std::uint64_t run = 0;
    if (!read_number(cursor_, total - end, skipped) ||
        !read_number(cursor_, count - kept_.size() + 1, run) || run == 0 ||
        run > total - end - skipped) {
      return expected("what of the original the coarse mesh keeps");
    }
    if (kept_.size() + run > cursor_.remaining() / least_bytes) {
      return cursor_.byte_error(
          fmt::format("{} vertices or triangles are claimed, {} bytes are left", kept_.size() + run,
                      cursor_.remaining()));
    }
    end += skipped;
    for (; run > 0; --run) kept_.push_back(static_cast<std::uint32_t>(end++));
  }
  return {};
}

/// Room for the level, as far as the bytes that are left can bear the claims out.
void HeadReader::reserve() {
  const ProgressiveFileReport& file = head_.file;
  GrownMesh& coarse = head_.coarse;
  const std::uint64_t left = cursor_.remaining();
  std::uint64_t vertices = std::min(file.vertices, left / coarse.columns.row_size());
  std::uint64_t triangles = std::min(file.triangles, left / 3);
  if (stop_.triangles) {
    const std::uint64_t more = *stop_.triangles - std::min(*stop_.triangles, file.coarse_triangles);
    triangles = std::min(triangles, file.coarse_triangles + more);
    vertices = std::min(vertices, file.coarse_vertices + more);  // one brings a triangle at least
  }
  coarse.mesh.reserve(vertices, triangles);
  coarse.columns.reserve(vertices);
  if (coarse.columns.triangle_origin()) coarse.triangle_origin.reserve(triangles);
  if (coarse.columns.triangle_owner()) coarse.triangle_owner.reserve(triangles);
}

Result<void> HeadReader::read_vertices() {
  ProgressiveColumns& columns = head_.coarse.columns;
  const std::size_t row_size = columns.row_size();
  if (auto ok = read_kept(head_.file.coarse_vertices, head_.file.vertices, row_size); !ok)
    return ok;
  reserve();
  for (const std::uint32_t index : kept_) {
    if (head_.coarse.mesh.stars.vertices() % 4096 == 0 && !keep_going_()) return cancelled();
    const std::byte* row = cursor_.take(row_size);
    if (!row || !columns.append(row))
      return expected(fmt::format("vertex {}, finite and of a known origin,", index));
    head_.coarse.mesh.add_vertex(index);
  }
  return {};
}

Result<void> HeadReader::read_triangle(std::uint32_t index) {
  GrownMesh& coarse = head_.coarse;
  Triangle triangle;
  for (std::uint32_t& v : triangle) {
    if (!read_near(cursor_, last_, head_.file.coarse_vertices, v))
      return expected(fmt::format("a vertex of triangle {}", index));
    last_ = v;
  }
  if (coarse.columns.triangle_origin()) {
    std::uint8_t origin = 0;
    if (!cursor_.read(origin) || origin > static_cast<std::uint8_t>(Origin::invented))
      return expected(fmt::format("the origin of triangle {}", index));
    coarse.triangle_origin.push_back(static_cast<Origin>(origin));
  }
  if (coarse.columns.triangle_owner()) {
    std::uint32_t owner = 0;
    if (!read_near(cursor_, coarse.mesh.vertex_indices[triangle[0]], head_.file.vertices, owner))
      return expected(fmt::format("the owner of triangle {}", index));
    coarse.triangle_owner.push_back(owner);
  }
  coarse.mesh.add_triangle(triangle, index);
  return {};
}

Result<void> HeadReader::read_triangles() {
  if (auto ok = read_kept(head_.file.coarse_triangles, head_.file.triangles, 3); !ok) return ok;
  for (const std::uint32_t index : kept_) {
    if (head_.coarse.mesh.stars.triangles() % 4096 == 0 && !keep_going_()) return cancelled();
    if (auto ok = read_triangle(index); !ok) return ok;
  }
  return {};
}

Result<ProgressiveHead> HeadReader::read() {
  if (auto ok = read_magic(); !ok) return ok.error();
  if (auto ok = read_counts(); !ok) return ok.error();
  if (!head_.coarse.columns.read_list(cursor_)) return expected("the list of attributes");
  if (auto ok = read_vertices(); !ok) return ok.error();
  if (auto ok = read_triangles(); !ok) return ok.error();
  return std::move(head_);
}

}  // namespace

Result<ProgressiveHead> read_progressive_head(Cursor& cursor, const ProgressiveStop& stop,
                                              const std::function<bool()>& keep_going) {
  return HeadReader(cursor, stop, keep_going).read();
}

}  // namespace burnish
