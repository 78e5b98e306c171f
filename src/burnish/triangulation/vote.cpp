#include "burnish/triangulation/vote.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "burnish/base/parallel.h"
#include "burnish/triangulation/triangle_gap.h"

namespace burnish {
namespace {

constexpr std::size_t kPointsAtOnce = 1024;

/// Appends the triangles of the fan of `p` that no fan with a smaller index has.
void append(std::uint32_t p, const Fans& fans, const TriangleJudge& judge,
            std::vector<Candidate>& candidates) {
  const auto rim = fans.rim(p);
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const std::uint32_t q = rim[i], r = rim[i + 1 < rim.size() ? i + 1 : 0];
    if (q == Fans::kGap || r == Fans::kGap) continue;
    const bool by_q = fans.has(q, r, p), by_r = fans.has(r, p, q);
    if ((by_q && q < p) || (by_r && r < p)) continue;
    Candidate candidate;
    if (judge.accepts({p, q, r}, 1 + by_q + by_r, candidate)) candidates.push_back(candidate);
  }
}

}  // namespace

bool TriangleJudge::accepts(const Triangle& t, int votes, Candidate& candidate) const {
  const Vec3d a(positions_[t[0]]), b(positions_[t[1]]), c(positions_[t[2]]);
  const Vec3d area = cross(b - a, c - a);
  for (const std::uint32_t v : t) {
    if (!(dot(area, Vec3d(normals_[v])) > 0)) return false;
  }
  const double spacing = std::max({fans_.spacing(t[0]), fans_.spacing(t[1]), fans_.spacing(t[2])});
  if (!(triangle_gap(a, b, c) <= max_gap_ * spacing)) return false;
  candidate.triangle = t;
  std::rotate(candidate.triangle.begin(),
              std::min_element(candidate.triangle.begin(), candidate.triangle.end()),
              candidate.triangle.end());
  candidate.votes = static_cast<std::uint8_t>(votes);
  const double edges = squared_norm(c - b) + squared_norm(a - c) + squared_norm(b - a);
  candidate.shape = static_cast<float>(2 * std::numbers::sqrt3 * norm(area) / edges);
  return true;
}

bool TriangleJudge::accepts(const Triangle& t, Candidate& candidate) const {
  const auto [a, b, c] = t;
  return accepts(t, fans_.has(a, b, c) + fans_.has(b, c, a) + fans_.has(c, a, b), candidate);
}

bool count_votes(const Fans& fans, const TriangleJudge& judge, const Context& context,
                 std::vector<Candidate>& candidates) {
  const std::size_t blocks = (fans.size() + kPointsAtOnce - 1) / kPointsAtOnce;
  std::vector<std::vector<Candidate>> of_block(blocks);
  const bool complete = parallel_for(
      context, blocks,
      [&](IndexRange range) {
        for (std::size_t block = range.begin; block < range.end; ++block) {
          of_block[block].reserve(2 * kPointsAtOnce + 512);
          const std::size_t end = std::min(fans.size(), (block + 1) * kPointsAtOnce);
          for (std::size_t p = block * kPointsAtOnce; p < end; ++p) {
            append(static_cast<std::uint32_t>(p), fans, judge, of_block[block]);
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
