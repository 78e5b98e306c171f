#include "open3d_registration.h"

#include <open3d/camera/PinholeCameraIntrinsic.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/geometry/RGBDImage.h>
#include <open3d/pipelines/odometry/Odometry.h>
#include <open3d/pipelines/registration/GeneralizedICP.h>
#include <open3d/pipelines/registration/Registration.h>

#include <algorithm>

namespace registration = open3d::pipelines::registration;

static open3d::geometry::PointCloud cloud_of(const PlainFrame& frame) {
  open3d::geometry::PointCloud cloud;
  for (const auto& p : frame.points) cloud.points_.emplace_back(p[0], p[1], p[2]);
  return cloud;
}

static PlainPose plain(const Eigen::Matrix4d& T) {
  PlainPose pose;
  for (int i = 0; i < 16; ++i) pose[static_cast<std::size_t>(i)] = T(i / 4, i % 4);
  return pose;
}

/// From coarse to fine in two steps: correspondences within the reach, then within 5 cm.
static PlainPose icp(Peer peer, const PlainFrame& source, const PlainFrame& target,
                     Eigen::Matrix4d T, double reach) {
  auto from = cloud_of(source), to = cloud_of(target);
  const open3d::geometry::KDTreeSearchParamKNN neighbours(16);
  to.EstimateNormals(neighbours);
  if (peer == Peer::generalized) from.EstimateNormals(neighbours);
  for (const double within : {std::max(reach, 0.05), 0.05}) {
    T = peer == Peer::generalized
            ? registration::RegistrationGeneralizedICP(from, to, within, T).transformation_
            : registration::RegistrationICP(from, to, within, T,
                                            registration::TransformationEstimationPointToPlane())
                  .transformation_;
  }
  return plain(T);
}

/// Of the hybrid term of depth and colour only the depth says anything: all is of one grey. (The
/// odometry of Open3D's tensors, by depth alone, needs a library that Debian does not build with.)
static PlainPose rgbd(const PlainFrame& source, const PlainFrame& target,
                      const Eigen::Matrix4d& guess, double reach) {
  const auto image = [](const PlainFrame& frame) {
    open3d::geometry::RGBDImage result;
    result.depth_.Prepare(frame.width, frame.height, 1, 4);
    result.color_.Prepare(frame.width, frame.height, 1, 4);
    for (int v = 0; v < frame.height; ++v) {
      for (int u = 0; u < frame.width; ++u) {
        *result.depth_.PointerAt<float>(u, v) =
            frame.depth[static_cast<std::size_t>(v * frame.width + u)];
        *result.color_.PointerAt<float>(u, v) = 0.5f;
      }
    }
    return result;
  };
  const open3d::camera::PinholeCameraIntrinsic camera(target.width, target.height, target.fx,
                                                      target.fy, target.cx, target.cy);
  open3d::pipelines::odometry::OdometryOption option;
  option.depth_diff_max_ = std::max(reach, 0.07);
  option.depth_max_ = 10;
  const auto found = open3d::pipelines::odometry::ComputeRGBDOdometry(
      image(source), image(target), camera, guess,
      open3d::pipelines::odometry::RGBDOdometryJacobianFromHybridTerm(), option);
  return plain(std::get<1>(found));
}

PlainPose align_with_open3d(Peer peer, const PlainFrame& source, const PlainFrame& target,
                            const PlainPose& guess, double reach) {
  Eigen::Matrix4d T;
  for (int i = 0; i < 16; ++i) T(i / 4, i % 4) = guess[static_cast<std::size_t>(i)];
  return peer == Peer::odometry ? rgbd(source, target, T, reach)
                                : icp(peer, source, target, T, reach);
}
