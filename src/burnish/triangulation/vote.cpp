#include "burnish/triangulation/vote.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "burnish/base/parallel.h"

namespace burnish {
namespace {

constexpr std::size_t kPointsAtOnce = 1024;

/// Judges the triangles that fans propose.
struct Judge {
  std::span<const Vec3f> positions, normals;
  const Fans& fans;
  double reach;

  /// Whether `t` is small enough for its surroundings and faces along the normals of its corners.
  bool acceptable(const Triangle& t, double& shape) const {
    const Vec3d a(positions[t[0]]), b(positions[t[1]]), c(positions[t[2]]);
    const Vec3d area = cross(b - a, c - a);
    for (const std::uint32_t v : t) {
      if (!(dot(area, Vec3d(normals[v])) > 0)) return false;
    }
    const double bc = squared_norm(c - b), ca = squared_norm(a - c), ab = squared_norm(b - a);
    const double doubled = squared_norm(area);  // (2 area)^2
    shape = 2 * std::numbers::sqrt3 * std::sqrt(doubled) / (ab + bc + ca);
    const double spacing = std::max({fans.spacing(t[0]), fans.spacing(t[1]), fans.spacing(t[2])});
    // The diameter of the circumscribed circle is |ab| |bc| |ca| / (2 area).
    return ab * bc * ca <= reach * reach * spacing * spacing * doubled;
  }

  /// Appends the triangles of the fan of `p` that no fan with a smaller index has.
  void append(std::uint32_t p, std::vector<Candidate>& candidates) const {
    const auto rim = fans.rim(p);
    for (std::size_t i = 0; i < rim.size(); ++i) {
      const std::uint32_t q = rim[i], r = rim[i + 1 < rim.size() ? i + 1 : 0];
      if (q == Fans::kGap || r == Fans::kGap) continue;
      const bool by_q = fans.has(q, r, p), by_r = fans.has(r, p, q);
      if ((by_q && q < p) || (by_r && r < p)) continue;
      Triangle t{p, q, r};
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      double shape;
      if (!acceptable(t, shape)) continue;
      candidates.push_back(
          {t, static_cast<std::uint8_t>(1 + by_q + by_r), static_cast<float>(shape)});
    }
  }
};

}  // namespace

bool count_votes(std::span<const Vec3f> positions, std::span<const Vec3f> normals, const Fans& fans,
                 double reach, const Context& context, std::vector<Candidate>& candidates) {
  const Judge judge{positions, normals, fans, reach};
  const std::size_t blocks = (fans.size() + kPointsAtOnce - 1) / kPointsAtOnce;
  std::vector<std::vector<Candidate>> of_block(blocks);
  const bool complete = parallel_for(
      context, blocks,
      [&](IndexRange range) {
        for (std::size_t block = range.begin; block < range.end; ++block) {
          of_block[block].reserve(2 * kPointsAtOnce + 512);
          const std::size_t end = std::min(fans.size(), (block + 1) * kPointsAtOnce);
          for (std::size_t p = block * kPointsAtOnce; p < end; ++p) {
            judge.append(static_cast<std::uint32_t>(p), of_block[block]);
          }
        }
      },
      1);
  if (!complete) return false;
  std::size_t count = 0;
  for (const auto& block : of_block) count += block.size();
  candidates.clear();
  candidates.reserve(count);
  for (const auto& block : of_block)
    candidates.insert(candidates.end(), block.begin(), block.end());
  return true;
}

}  // namespace burnish
