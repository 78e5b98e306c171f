#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// Adds the n - 2 triangles of a polygon whose corners index `positions`: a fan from the first
/// corner where it is convex or has no plane, else by ear clipping (Meisters 1975) in the plane of
/// Newell's normal, O(n * reflex corners). False, with nothing added, for a concave polygon of more
/// than kMaxConcaveCorners, which would take too long.
bool triangulate_polygon(std::span<const Vec3f> positions, std::span<const std::uint32_t> corners,
                         std::vector<Triangle>& triangles);
inline constexpr std::size_t kMaxConcaveCorners = 2048;

/// Gathers the faces of a file: polygons become triangles, what has fewer than three corners is
/// counted and left out.
class FaceList {
 public:
  FaceList(std::span<const Vec3f> positions, std::vector<Triangle>& triangles)
      : positions_(positions), triangles_(triangles) {}

  /// Errors (without a place): a corner that is no vertex; a polygon that is too complicated.
  Result<void> add(std::span<const std::int64_t> corners);
  /// A triangle strip in which -1 begins the next one.
  Result<void> add_strip(std::span<const std::int64_t> corners);

  /// Counts faces that the caller has added himself, for the numbers in messages.
  void count(std::size_t faces) { faces_ += faces; }

  /// Appends a sentence on what was left out, if anything was.
  void note(std::vector<std::string>& notes) const;

 private:
  Result<void> check(std::int64_t corner) const;

  std::span<const Vec3f> positions_;
  std::vector<Triangle>& triangles_;
  std::vector<std::uint32_t> polygon_;
  std::size_t faces_ = 0, too_small_ = 0;
};

}  // namespace burnish
