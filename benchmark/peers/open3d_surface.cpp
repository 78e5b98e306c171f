#include <open3d/geometry/KDTreeFlann.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/geometry/TriangleMesh.h>

#include <cmath>

#include "surface_peer.h"

// surface_open3d IN OUT pivoting|poisson, as Open3D's tutorial on surface reconstruction
// does: normals of 30 neighbours oriented along a minimum spanning tree (20 neighbours) where the
// points bring none; ball pivoting with radii of 1.5, 3 and 6 mean nearest distances (the
// tutorial's are absolute: 0.005, 0.01, 0.02, 0.04 for a bunny of 0.15 m; its text says "slightly
// larger than the average distance between points"); Poisson at depth 9.
using open3d::geometry::PointCloud;
using open3d::geometry::TriangleMesh;

static double mean_nearest_distance(const PointCloud& cloud) {
  double sum = 0;
  const std::vector<double> distances = cloud.ComputeNearestNeighborDistance();
  for (const double d : distances) sum += d;
  return sum / static_cast<double>(distances.size());
}

static std::shared_ptr<TriangleMesh> build(PointCloud& cloud, bool poisson) {
  if (!cloud.HasNormals()) {
    cloud.EstimateNormals(open3d::geometry::KDTreeSearchParamKNN(30));
    cloud.OrientNormalsConsistentTangentPlane(20);
  }
  if (poisson) return std::get<0>(TriangleMesh::CreateFromPointCloudPoisson(cloud, 9));
  const double d = mean_nearest_distance(cloud);
  return TriangleMesh::CreateFromPointCloudBallPivoting(cloud, {1.5 * d, 3 * d, 6 * d});
}

static Surface surface_of(const TriangleMesh& mesh) {
  Surface surface;
  for (const Eigen::Vector3d& p : mesh.vertices_) {
    surface.positions.push_back(
        {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
  }
  for (const Eigen::Vector3i& t : mesh.triangles_) {
    surface.triangles.push_back({static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]),
                                 static_cast<std::uint32_t>(t[2])});
  }
  return surface;
}

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const bool poisson = std::strcmp(argv[3], "poisson") == 0;
  const auto vectors = [](const std::vector<Point>& points) {
    std::vector<Eigen::Vector3d> result;
    for (const Point& p : points) result.emplace_back(p[0], p[1], p[2]);
    return result;
  };
  return run_peer(
      argv,
      [&](const Points& points) {
        PointCloud cloud(vectors(points.positions));
        cloud.normals_ = vectors(points.normals);
        return cloud;
      },
      [&](PointCloud& cloud) { return build(cloud, poisson); },
      [](const std::shared_ptr<TriangleMesh>& mesh) { return surface_of(*mesh); });
}
