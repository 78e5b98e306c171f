#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/core/triangle_mesh.h"
#include "burnish/triangulation/local_fans.h"

namespace burnish {

/// A triangle that some fans propose; its smallest index first, counter-clockwise around the
/// normals.
struct Candidate {
  Triangle triangle;
  std::uint8_t votes;  ///< of how many of its three corners' fans it is part
  float shape;         ///< 4 sqrt(3) area / sum of squared edges: 1 equilateral, 0 degenerate
};

/// The order in which candidates are tried: more votes, better shape, smaller indices first.
inline bool sooner(const Candidate& a, const Candidate& b) {
  if (a.votes != b.votes) return a.votes > b.votes;
  return a.shape != b.shape ? a.shape > b.shape : a.triangle < b.triangle;
}

/// Says which triangles of the fans can be part of a surface.
class TriangleJudge {
 public:
  /// `max_gap`: widest gap of a triangle (triangle_gap.h), in the largest spacing of its corners.
  TriangleJudge(std::span<const Vec3f> positions, std::span<const Vec3f> normals, const Fans& fans,
                double max_gap)
      : positions_(positions), normals_(normals), fans_(fans), max_gap_(max_gap) {}

  /// Whether `t` spans no gap and faces along the normals of its corners; it is then `candidate`.
  bool accepts(const Triangle& t, Candidate& candidate) const;
  /// The same where the votes are counted already.
  bool accepts(const Triangle& t, int votes, Candidate& candidate) const;

 private:
  std::span<const Vec3f> positions_, normals_;
  const Fans& fans_;
  double max_gap_;
};

/// Every triangle of the fans that `judge` accepts, once, in the order of the fans. Returns false
/// where cancelled. O(#fan triangles).
[[nodiscard]] bool count_votes(const Fans& fans, const TriangleJudge& judge, const Context& context,
                               std::vector<Candidate>& candidates);

}  // namespace burnish
