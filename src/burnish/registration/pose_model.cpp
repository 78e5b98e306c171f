#include "burnish/registration/pose_model.h"

#include <cmath>

#include "burnish/registration/twist.h"

namespace burnish {
namespace {

/// The twist that is 1 in its `i`-th of six numbers.
Twist unit_twist(std::size_t i) {
  Twist twist{};
  (i < 3 ? twist.rotation : twist.translation)[i % 3] = 1;
  return twist;
}

Twist twist_of(std::span<const double> six) {
  return {{six[0], six[1], six[2]}, {six[3], six[4], six[5]}};
}

RigidTransform turned_about_z(double angle) {
  return rotation_by({0, 0, angle});
}

}  // namespace

std::vector<PoseModel::Motion> FreePoses::motions(std::size_t view) const {
  if (view == 0) return {};
  std::vector<Motion> motions;
  for (std::uint32_t i = 0; i < 6; ++i) {
    motions.push_back({static_cast<std::uint32_t>(6 * (view - 1)) + i, unit_twist(i)});
  }
  return motions;
}

void FreePoses::move(std::span<const double> step) {
  before_ = poses_;
  for (std::size_t view = 1; view < poses_.size(); ++view) {
    poses_[view] = moved(poses_[view], twist_of(step.subspan(6 * (view - 1), 6)));
  }
}

RigidTransform TurntablePoses::pose(std::size_t view) const {
  return turned_about_z(now_.angles[view]) * now_.T_world_camera;
}

std::vector<PoseModel::Motion> TurntablePoses::motions(std::size_t view) const {
  std::vector<Motion> motions;
  const RigidTransform turn = turned_about_z(now_.angles[view]);
  for (std::uint32_t i = 0; i < 6; ++i) motions.push_back({i, in_axes_of(turn, unit_twist(i))});
  if (view > 0) motions.push_back({static_cast<std::uint32_t>(5 + view), unit_twist(2)});
  return motions;
}

void TurntablePoses::move(std::span<const double> step) {
  before_ = now_;
  now_.T_world_camera = moved(now_.T_world_camera, twist_of(step.first(6)));
  for (std::size_t view = 1; view < views(); ++view) now_.angles[view] += step[5 + view];
}

}  // namespace burnish
