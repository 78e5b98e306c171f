#include "burnish/triangulation/fan_cloud.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "burnish/base/parallel.h"
#include "burnish/core/gather.h"
#include "burnish/triangulation/point_order.h"

namespace burnish {
namespace {

constexpr std::size_t kPointsAtOnce = 1024;

Error bad_length(const char* what, std::size_t length, std::size_t points) {
  return {ErrorCode::bad_geometry, fmt::format("{} {} for {} points", length, what, points), {}};
}

Result<void> check_points(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                          std::span<const std::uint8_t> active) {
  if (!normals.empty() && normals.size() != positions.size()) {
    return bad_length("normals", normals.size(), positions.size());
  }
  if (!active.empty() && active.size() != positions.size()) {
    return bad_length("active flags", active.size(), positions.size());
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (is_finite(positions[i])) continue;
    return Error{ErrorCode::bad_geometry, "position is not finite", fmt::format("point {}", i)};
  }
  return {};
}

/// Of points that are distinct and all there: most fans need no more neighbours than are looked up
/// for all points at once.
class StaticNeighbours {
 public:
  StaticNeighbours(std::span<const Vec3f> positions) : positions_(positions), grid_(positions) {}

  [[nodiscard]] bool look_up(std::size_t count, const Context& context) {
    return grid_.nearest_of_all(count, context, lists_);
  }

  void nearest(std::uint32_t p, std::size_t count, std::vector<Neighbour>& found) const {
    if (count > lists_.count() && lists_.count() < positions_.size()) {
      return grid_.nearest(positions_[p], count, found);
    }
    found.clear();
    for (const std::uint32_t q : lists_.of(p)) {
      if (found.size() == count) return;
      found.push_back({q, squared_norm(Vec3d(positions_[q]) - Vec3d(positions_[p]))});
    }
  }

 private:
  std::span<const Vec3f> positions_;
  NeighbourGrid grid_;
  NeighbourLists lists_;
};

}  // namespace

Result<FanCloud> FanCloud::build(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                                 const FanCloudParams& params, const Context& context,
                                 std::span<const std::uint8_t> active) {
  if (auto valid = FanCloudParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check_points(positions, normals, active); !sound) return sound.error();
  FanCloud cloud;
  cloud.params_ = params;
  cloud.positions_.assign(positions.begin(), positions.end());
  cloud.normals_.assign(normals.begin(), normals.end());
  cloud.states_.assign(positions.size(), FanState::duplicate);
  for (std::size_t p = 0; p < active.size(); ++p) {
    if (!active[p]) cloud.states_[p] = FanState::inactive;
  }
  if (auto built = cloud.build_all(context); !built) return built.error();
  return cloud;
}

/// The fans of the points whose state is not inactive.
Result<void> FanCloud::build_all(const Context& context) {
  rims_.resize(size());
  fan_normals_.resize(size());
  squared_reaches_.resize(size());
  const std::vector<std::uint32_t> numbers = first_in_place();
  const std::vector<Vec3f> positions = gather(positions_, numbers);
  const std::vector<Vec3f> normals = gather(normals_, numbers);
  StaticNeighbours neighbours(positions);
  const std::size_t first = FanBuilder::first_neighbours(params_) + 1;
  if (!neighbours.look_up(first, context.part(0, 0.4))) return cancelled();

  struct Block {
    std::vector<std::uint32_t> rims, ends;
  };
  std::vector<Block> blocks((numbers.size() + kPointsAtOnce - 1) / kPointsAtOnce);
  const bool complete = parallel_for(
      context.part(0.4, 1), blocks.size(),
      [&](IndexRange range) {
        FanBuilder builder(params_, [&neighbours](std::uint32_t i, std::size_t count,
                                                  std::vector<Neighbour>& found) {
          neighbours.nearest(i, count, found);
        });
        for (std::size_t b = range.begin; b < range.end; ++b) {
          const std::size_t end = std::min(numbers.size(), (b + 1) * kPointsAtOnce);
          for (std::size_t i = b * kPointsAtOnce; i < end; ++i) {
            const Fan& fan = builder.build(static_cast<std::uint32_t>(i), {positions, normals});
            const std::uint32_t p = numbers[i];
            fan_normals_[p] = fan.normal;
            states_[p] = fan.state;
            squared_reaches_[p] = fan.squared_reach;
            for (const std::uint32_t q : fan.rim) {
              blocks[b].rims.push_back(q == Fan::kGap ? q : numbers[q]);
            }
            blocks[b].ends.push_back(static_cast<std::uint32_t>(blocks[b].rims.size()));
          }
        }
      },
      1);
  if (!complete) return cancelled();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Block& block = blocks[i / kPointsAtOnce];
    const std::size_t n = i % kPointsAtOnce, begin = n > 0 ? block.ends[n - 1] : 0;
    rims_.assign(numbers[i], std::span(block.rims).subspan(begin, block.ends[n] - begin));
  }
  for (std::uint32_t p = 0; p < size(); ++p) {
    if (states_[p] == FanState::duplicate) duplicates_.insert({place_of(positions_[p]), p});
  }
  return {};
}

/// The active points, of those in one place the first, rising.
std::vector<std::uint32_t> FanCloud::first_in_place() const {
  constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();
  std::vector<Vec3f> there = positions_;
  for (std::uint32_t p = 0; p < size(); ++p) {
    if (!active(p)) there[p] = {kNowhere, kNowhere, kNowhere};
  }
  std::vector<std::uint32_t> first = order_along_curve(there);
  std::sort(first.begin(), first.end());
  return first;
}

PointOctree& FanCloud::octree() {
  if (!octree_) {
    octree_.emplace();
    for (std::uint32_t p = 0; p < size(); ++p) {
      if (states_[p] > FanState::duplicate) {
        octree_->insert(p, positions_[p], squared_reaches_[p]);
      }
    }
    squared_reaches_ = {};
  }
  return *octree_;
}

Result<void> FanCloud::check_index(std::uint32_t p) const {
  if (p < size() && states_[p] != FanState::removed) return {};
  return Error{ErrorCode::invalid_argument,
               p < size() ? fmt::format("point {} was removed", p)
                          : fmt::format("there is no point {}, only {}", p, size()),
               {}};
}

Result<std::uint32_t> FanCloud::add(const Vec3f& position, const Vec3f& normal) {
  if (!is_finite(position)) {
    return Error{ErrorCode::bad_geometry, "position of the new point is not finite", {}};
  }
  octree();
  std::uint32_t p = static_cast<std::uint32_t>(size());
  if (!removed_.empty()) {
    p = removed_.back();
    removed_.pop_back();
  } else {
    positions_.emplace_back();
    fan_normals_.emplace_back();
    states_.push_back(FanState::inactive);
    rims_.resize(size());
  }
  if (!normals_.empty() || normal != Vec3f{}) normals_.resize(size());
  positions_[p] = position;
  if (!normals_.empty()) normals_[p] = normal;
  activate(p);
  return p;
}

Result<void> FanCloud::remove(std::uint32_t p) {
  if (auto there = check_index(p); !there) return there.error();
  if (active(p)) deactivate(p);
  states_[p] = FanState::removed;
  removed_.push_back(p);
  return {};
}

Result<void> FanCloud::set_active(std::uint32_t p, bool wanted) {
  if (auto there = check_index(p); !there) return there.error();
  if (wanted == active(p)) return {};
  if (wanted) {
    activate(p);
  } else {
    deactivate(p);
  }
  return {};
}

/// The point that stands for all in this place.
std::optional<std::uint32_t> FanCloud::first_at(const Vec3f& place) {
  std::vector<Neighbour> found;
  octree().nearest(place, 1, found);
  if (found.empty() || found[0].squared_distance > 0) return std::nullopt;
  return found[0].index;
}

void FanCloud::activate(std::uint32_t p) {
  const Vec3f& place = positions_[p];
  renewed_.clear();
  if (const auto first = first_at(place)) {
    const std::uint32_t second = std::max(p, *first);
    if (p > *first) {
      states_[p] = FanState::duplicate;
    } else {
      octree().erase(*first, place);
      clear_fan(*first, FanState::duplicate);
    }
    duplicates_.insert({place_of(place), second});
    if (second == p) return;
  }
  octree().insert(p, place);
  renew_fans_around(place);
}

void FanCloud::deactivate(std::uint32_t p) {
  const Vec3f& place = positions_[p];
  renewed_.clear();
  if (states_[p] == FanState::duplicate) {
    duplicates_.erase({place_of(place), p});
    states_[p] = FanState::inactive;
    return;
  }
  octree().erase(p, place);
  clear_fan(p, FanState::inactive);
  const auto next = duplicates_.lower_bound({place_of(place), 0});
  if (next != duplicates_.end() && next->first == place_of(place)) {
    octree().insert(next->second, place);
    duplicates_.erase(next);
  }
  renew_fans_around(place);
}

void FanCloud::clear_fan(std::uint32_t p, FanState state) {
  rims_.assign(p, {});
  fan_normals_[p] = {};
  states_[p] = state;
}

/// A point that was just inserted is among those that reach its place.
void FanCloud::renew_fans_around(const Vec3f& place) {
  octree().reaching(place, renewed_);
  FanBuilder builder(params_,
                     [this](std::uint32_t p, std::size_t count, std::vector<Neighbour>& found) {
                       octree_->nearest(positions_[p], count, found);
                     });
  for (const std::uint32_t p : renewed_) {
    const Fan& fan = builder.build(p, points());
    rims_.assign(p, fan.rim);
    fan_normals_[p] = fan.normal;
    states_[p] = fan.state;
    octree_->set_reach(p, positions_[p], fan.squared_reach);
  }
}

}  // namespace burnish
