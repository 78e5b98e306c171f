#include "burnish/triangulation/front.h"

#include <algorithm>
#include <queue>

namespace burnish {
namespace {

constexpr std::size_t kBetweenLooks = 8192;

struct Later {
  bool operator()(const Candidate& a, const Candidate& b) const { return sooner(b, a); }
};

class Front {
 public:
  Front(const Fans& fans, const TriangleJudge& judge, ManifoldSurface& surface)
      : fans_(fans), judge_(judge), surface_(surface) {}

  /// Adds the seed and what can be reached from it. Returns false where cancelled.
  bool grow_from(const Candidate& seed, const Context& context) {
    add(seed.triangle);
    for (; !waiting_.empty(); ++steps_) {
      if (steps_ % kBetweenLooks == 0 && context.cancelled()) return false;
      const Triangle t = waiting_.top().triangle;
      waiting_.pop();
      if (surface_.touches(t)) add(t);
    }
    return true;
  }

 private:
  void add(const Triangle& t) {
    if (surface_.overlaps(t) || !surface_.add_if_manifold(t)) return;
    for (std::size_t i = 0; i < 3; ++i) propose_across(t[i], t[(i + 1) % 3]);
  }

  /// What the fans of the ends of the edge from a to b hold on its other side.
  void propose_across(std::uint32_t a, std::uint32_t b) {
    if (surface_.has_edge(b, a)) return;
    const std::uint32_t by_a = fans_.before(a, b), by_b = fans_.after(b, a);
    if (by_a != Fans::kGap) propose({b, a, by_a});
    if (by_b != Fans::kGap && by_b != by_a) propose({b, a, by_b});
  }

  void propose(const Triangle& t) {
    Candidate candidate;
    if (judge_.accepts(t, candidate)) waiting_.push(candidate);
  }

  const Fans& fans_;
  const TriangleJudge& judge_;
  ManifoldSurface& surface_;
  std::priority_queue<Candidate, std::vector<Candidate>, Later> waiting_;
  std::size_t steps_ = 0;
};

}  // namespace

bool grow_front(std::span<const Candidate> candidates, const Fans& fans, const TriangleJudge& judge,
                const Context& context, ManifoldSurface& surface) {
  std::vector<Candidate> seeds;
  for (const Candidate& candidate : candidates) {
    if (candidate.votes == 3) seeds.push_back(candidate);
  }
  std::sort(seeds.begin(), seeds.end(), sooner);
  Front front(fans, judge, surface);
  for (const Candidate& seed : seeds) {
    const bool fresh = std::none_of(seed.triangle.begin(), seed.triangle.end(),
                                    [&](std::uint32_t v) { return surface.uses(v); });
    if (fresh && !front.grow_from(seed, context)) return false;
  }
  return true;
}

}  // namespace burnish
