#include "burnish/triangulation/fan_cover.h"

#include <cmath>
#include <limits>
#include <utility>

#include "burnish/base/tangent_frame.h"
#include "burnish/triangulation/turn.h"

namespace burnish {
namespace {

/// What is left open of a corner by less than this, in quarter turns, is not seen.
constexpr double kSliver = 1e-4;
constexpr std::size_t kBetweenLooks = 8192;

template <class Visit>
void for_each_triangle(const FanCloud& fans, std::uint32_t p, Visit visit) {
  const auto rim = fans.rim(p);
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const std::uint32_t q = rim[i], r = rim[i + 1 < rim.size() ? i + 1 : 0];
    if (q != Fan::kGap && r != Fan::kGap) visit(q, r);
  }
}

class Cover {
 public:
  explicit Cover(const FanCloud& fans)
      : fans_(fans), first_(fans.size(), kNone), role_(fans.size(), Role::none) {}

  void take_whole_fan_if_free(std::uint32_t p) {
    if (role_[p] != Role::none || fans_.rim(p).empty()) return;
    for (const std::uint32_t q : fans_.rim(p)) {
      if (q != Fan::kGap && role_[q] == Role::centre) return;
    }
    role_[p] = Role::centre;
    for (const std::uint32_t q : fans_.rim(p)) {
      if (q != Fan::kGap) role_[q] = Role::rim;
    }
    for_each_triangle(fans_, p, [&](std::uint32_t q, std::uint32_t r) { take({p, q, r}); });
  }

  void fill_around(std::uint32_t p) {
    if (role_[p] == Role::centre) return;
    open_.clear();
    for_each_triangle(fans_, p, [&](std::uint32_t q, std::uint32_t r) {
      if (!taken(p, q, r)) open_.push_back({p, q, r});
    });
    if (open_.empty()) return;
    frame_ = TangentFrame(Vec3d(fans_.fan_normal(p)));
    origin_ = Vec3d(fans_.positions()[p]);
    covered_.clear();
    for (std::uint32_t i = first_[p]; i != kNone; i = corners_[i].next) {
      const Arc arc = arc_between(corners_[i].from, corners_[i].to);
      const bool ahead = arc.width <= kHalfTurn;
      covered_.push_back(ahead ? arc : Arc{arc.begin + arc.width, kFullTurn - arc.width});
    }
    for (const Triangle& t : open_) {
      if (!covers(arc_between(t[1], t[2]))) take(t);
    }
  }

  std::vector<Triangle> triangles;

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  enum class Role : std::uint8_t { none, rim, centre };

  struct Arc {
    double begin, width;  ///< as turn_of has them
  };
  /// A corner of a triangle that was taken by another fan; those of a point are a linked list.
  struct Corner {
    std::uint32_t from, to, next;
  };

  double turn_to(std::uint32_t q) const {
    const Vec3d to = Vec3d(fans_.positions()[q]) - origin_;
    return turn_of(dot(frame_.u, to), dot(frame_.v, to));
  }

  Arc arc_between(std::uint32_t q, std::uint32_t r) const {
    const double begin = turn_to(q);
    return {begin, turn_between(begin, turn_to(r))};
  }

  void take(const Triangle& t) {
    triangles.push_back(t);
    for (std::size_t c = 1; c < 3; ++c) {
      const std::uint32_t v = t[c];
      corners_.push_back({t[(c + 1) % 3], t[(c + 2) % 3], first_[v]});
      first_[v] = static_cast<std::uint32_t>(corners_.size() - 1);
    }
  }

  bool taken(std::uint32_t p, std::uint32_t q, std::uint32_t r) const {
    for (std::uint32_t i = first_[p]; i != kNone; i = corners_[i].next) {
      const Corner& c = corners_[i];
      if ((c.from == q && c.to == r) || (c.from == r && c.to == q)) return true;
    }
    return false;
  }

  /// Whether the arcs that are covered make up all of `arc`.
  bool covers(const Arc& arc) const {
    double done = 0;
    for (bool further = true; further && done < arc.width - kSliver;) {
      further = false;
      for (const Arc& other : covered_) {
        const double into = turn_between(other.begin, arc.begin + done + kSliver);
        const double more = other.width - std::fmod(into, kFullTurn);
        if (more <= 0) continue;
        done += kSliver + more;
        further = true;
      }
    }
    return done >= arc.width - kSliver;
  }

  const FanCloud& fans_;
  std::vector<std::uint32_t> first_;
  std::vector<Corner> corners_;
  std::vector<Role> role_;
  TangentFrame frame_;
  Vec3d origin_;
  std::vector<Triangle> open_;
  std::vector<Arc> covered_;
};

}  // namespace

std::vector<Triangle> all_fan_triangles(const FanCloud& fans) {
  std::vector<Triangle> triangles;
  for (std::uint32_t p = 0; p < fans.size(); ++p) {
    for_each_triangle(fans, p, [&](std::uint32_t q, std::uint32_t r) {
      triangles.push_back({p, q, r});
    });
  }
  return triangles;
}

std::vector<Triangle> covering_fan_triangles(const FanCloud& fans, const Context& context) {
  Cover cover(fans);
  const auto count = static_cast<std::uint32_t>(fans.size());
  for (std::uint32_t p = 0; p < count; ++p) {
    if (p % kBetweenLooks == 0 && context.cancelled()) return {};
    cover.take_whole_fan_if_free(p);
  }
  for (std::uint32_t p = 0; p < count; ++p) {
    if (p % kBetweenLooks == 0 && context.cancelled()) return {};
    cover.fill_around(p);
  }
  return std::move(cover.triangles);
}

}  // namespace burnish
