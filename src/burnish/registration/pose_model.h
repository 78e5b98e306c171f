#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "burnish/base/rigid.h"
#include "burnish/registration/pair.h"

namespace burnish {

/// How the poses of several views follow from unknowns. T_world_view throughout.
class PoseModel {
 public:
  /// How a view moves, a twist in world axes, per unit of one unknown.
  struct Motion {
    std::uint32_t unknown;
    Twist per_unit;
  };

  virtual ~PoseModel() = default;
  virtual std::size_t views() const = 0;
  virtual std::size_t unknowns() const = 0;
  virtual RigidTransform pose(std::size_t view) const = 0;
  /// Of the unknowns that the view depends on; none for one that stands still.
  virtual std::vector<Motion> motions(std::size_t view) const = 0;
  /// Adds `step`, one number per unknown.
  virtual void move(std::span<const double> step) = 0;
  /// As if the last move had not been.
  virtual void take_back() = 0;
};

/// Every view by itself; the first stands still.
class FreePoses : public PoseModel {
 public:
  explicit FreePoses(std::vector<RigidTransform> T_world_view) : poses_(std::move(T_world_view)) {}

  std::size_t views() const override { return poses_.size(); }
  std::size_t unknowns() const override { return 6 * (poses_.size() - 1); }
  RigidTransform pose(std::size_t view) const override { return poses_[view]; }
  std::vector<Motion> motions(std::size_t view) const override;
  void move(std::span<const double> step) override;
  void take_back() override { poses_ = before_; }

 private:
  std::vector<RigidTransform> poses_, before_;
};

/// One camera beside a turntable whose axis is the world's z: what stands on it is seen as if the
/// camera went around it. Unknowns are where the camera stands, six, and the table's angle at every
/// view but the first, whose angle is 0. (Turning and lifting the whole world changes nothing: two
/// of the six are not held by anything, and stay where they begin.)
class TurntablePoses : public PoseModel {
 public:
  /// T_world_camera is the first view's; rad.
  TurntablePoses(const RigidTransform& T_world_camera, std::vector<double> angles)
      : now_{T_world_camera, std::move(angles)} {}

  std::size_t views() const override { return now_.angles.size(); }
  std::size_t unknowns() const override { return 6 + now_.angles.size() - 1; }
  RigidTransform pose(std::size_t view) const override;
  std::vector<Motion> motions(std::size_t view) const override;
  void move(std::span<const double> step) override;
  void take_back() override { now_ = before_; }

  const RigidTransform& T_world_camera() const { return now_.T_world_camera; }
  const std::vector<double>& angles() const { return now_.angles; }

 private:
  struct State {
    RigidTransform T_world_camera;
    std::vector<double> angles;
  };
  State now_, before_;
};

}  // namespace burnish
