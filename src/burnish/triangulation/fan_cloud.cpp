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

/// The points named in `order`, rising: equally near ones are found in the order of their indices.
struct NumberedGrid {
  std::vector<std::uint32_t> numbers;
  NeighbourGrid grid;

  NumberedGrid(const std::vector<Vec3f>& positions, std::vector<std::uint32_t> order)
      : numbers(sorted(std::move(order))), grid(gather(positions, numbers)) {}

  static std::vector<std::uint32_t> sorted(std::vector<std::uint32_t> order) {
    std::sort(order.begin(), order.end());
    return order;
  }

  void nearest(const Vec3f& place, std::size_t count, std::vector<Neighbour>& found) const {
    grid.nearest(place, count, found);
    for (Neighbour& neighbour : found) neighbour.index = numbers[neighbour.index];
  }
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
  std::vector<Vec3f> there = positions_;
  constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();
  for (std::uint32_t p = 0; p < size(); ++p) {
    if (!active(p)) there[p] = {kNowhere, kNowhere, kNowhere};
  }
  const std::vector<std::uint32_t> order = order_along_curve(there);
  const NumberedGrid grid(positions_, order);
  const auto nearest = [&grid](const Vec3f& place, std::size_t count,
                               std::vector<Neighbour>& found) {
    grid.nearest(place, count, found);
  };

  // Along the curve one fan's neighbours are still at hand for the next.
  struct Block {
    std::vector<std::uint32_t> rims, ends;
  };
  std::vector<Block> blocks((order.size() + kPointsAtOnce - 1) / kPointsAtOnce);
  const bool complete = parallel_for(
      context, blocks.size(),
      [&](IndexRange range) {
        FanBuilder builder(params_, nearest);
        for (std::size_t b = range.begin; b < range.end; ++b) {
          const std::size_t end = std::min(order.size(), (b + 1) * kPointsAtOnce);
          for (std::size_t i = b * kPointsAtOnce; i < end; ++i) {
            const std::uint32_t p = order[i];
            const Fan& fan = builder.build(p, points());
            fan_normals_[p] = fan.normal;
            states_[p] = fan.state;
            squared_reaches_[p] = fan.squared_reach;
            blocks[b].rims.insert(blocks[b].rims.end(), fan.rim.begin(), fan.rim.end());
            blocks[b].ends.push_back(static_cast<std::uint32_t>(blocks[b].rims.size()));
          }
        }
      },
      1);
  if (!complete) return cancelled();
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Block& block = blocks[i / kPointsAtOnce];
    const std::size_t n = i % kPointsAtOnce, begin = n > 0 ? block.ends[n - 1] : 0;
    rims_.assign(order[i], std::span(block.rims).subspan(begin, block.ends[n] - begin));
  }
  for (std::uint32_t p = 0; p < size(); ++p) {
    if (states_[p] == FanState::duplicate) duplicates_.insert({place_of(positions_[p]), p});
  }
  return {};
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
  std::vector<std::uint32_t> touched;
  octree().reaching(place, touched);
  FanBuilder builder(params_,
                     [this](const Vec3f& p, std::size_t count, std::vector<Neighbour>& found) {
                       octree_->nearest(p, count, found);
                     });
  for (const std::uint32_t p : touched) {
    const Fan& fan = builder.build(p, points());
    rims_.assign(p, fan.rim);
    fan_normals_[p] = fan.normal;
    states_[p] = fan.state;
    octree_->set_reach(p, positions_[p], fan.squared_reach);
  }
}

}  // namespace burnish
