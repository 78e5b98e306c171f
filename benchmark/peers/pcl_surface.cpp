#include <pcl/features/normal_3d.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/gp3.h>
#include <pcl/surface/organized_fast_mesh.h>

#include <cmath>

#include "surface_peer.h"

// surface_pcl IN OUT greedy|organized, as PCL's tutorials do: normals of 20 neighbours where
// the points bring none; greedy projection (Marton, Rusu and Beetz 2009) with mu 2.5, at most 100
// neighbours and the tutorial's angles, and as its radius 5 mean nearest distances (the tutorial's
// is the absolute 0.025 for the bunny); a fast mesh of an organized PCD with its adaptive cut.
using Cloud = pcl::PointCloud<pcl::PointNormal>;

static double mean_nearest_distance(const Cloud::Ptr& cloud,
                                    const pcl::search::KdTree<pcl::PointNormal>& tree) {
  std::vector<int> found(2);
  std::vector<float> squared(2);
  double sum = 0;
  for (const auto& p : *cloud) {
    tree.nearestKSearch(p, 2, found, squared);
    sum += std::sqrt(squared[1]);
  }
  return sum / static_cast<double>(cloud->size());
}

static std::vector<pcl::Vertices> greedy(const Cloud::Ptr& cloud, bool with_normals) {
  const pcl::search::KdTree<pcl::PointNormal>::Ptr tree(new pcl::search::KdTree<pcl::PointNormal>);
  tree->setInputCloud(cloud);
  if (!with_normals) {
    pcl::NormalEstimation<pcl::PointNormal, pcl::PointNormal> normals;
    normals.setInputCloud(cloud);
    normals.setSearchMethod(tree);
    normals.setKSearch(20);
    normals.compute(*cloud);
  }
  pcl::GreedyProjectionTriangulation<pcl::PointNormal> triangulation;
  triangulation.setSearchRadius(5 * mean_nearest_distance(cloud, *tree));
  triangulation.setMu(2.5);
  triangulation.setMaximumNearestNeighbors(100);
  triangulation.setMaximumSurfaceAngle(M_PI / 4);
  triangulation.setMinimumAngle(M_PI / 18);
  triangulation.setMaximumAngle(2 * M_PI / 3);
  triangulation.setNormalConsistency(false);
  triangulation.setInputCloud(cloud);
  triangulation.setSearchMethod(tree);
  std::vector<pcl::Vertices> polygons;
  triangulation.reconstruct(polygons);
  return polygons;
}

static Surface surface_of(std::vector<Point> positions,
                          const std::vector<pcl::Vertices>& polygons) {
  Surface surface{std::move(positions), {}};
  for (const pcl::Vertices& polygon : polygons) {
    surface.triangles.push_back({static_cast<std::uint32_t>(polygon.vertices[0]),
                                 static_cast<std::uint32_t>(polygon.vertices[1]),
                                 static_cast<std::uint32_t>(polygon.vertices[2])});
  }
  return surface;
}

static int organized(char** argv) {
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  if (pcl::io::loadPCDFile(argv[1], *cloud) != 0) return 1;
  const Stopwatch stopwatch;
  pcl::OrganizedFastMesh<pcl::PointXYZ> mesh;
  mesh.setTriangulationType(pcl::OrganizedFastMesh<pcl::PointXYZ>::TRIANGLE_ADAPTIVE_CUT);
  mesh.setInputCloud(cloud);
  std::vector<pcl::Vertices> polygons;
  mesh.reconstruct(polygons);
  stopwatch.print();
  std::vector<Point> positions;
  for (const auto& p : *cloud) {
    positions.push_back(std::isfinite(p.z) ? Point{p.x, p.y, p.z} : Point{0, 0, 0});
  }
  write_ply(argv[2], surface_of(std::move(positions), polygons));
  return 0;
}

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  if (std::strcmp(argv[3], "organized") == 0) return organized(argv);
  std::vector<Point> positions;
  bool with_normals = false;
  return run_peer(
      argv,
      [&](const Points& points) {
        positions = points.positions;
        with_normals = !points.normals.empty();
        const Cloud::Ptr cloud(new Cloud);
        for (std::size_t i = 0; i < positions.size(); ++i) {
          pcl::PointNormal p;
          p.x = positions[i][0], p.y = positions[i][1], p.z = positions[i][2];
          if (with_normals) {
            p.normal_x = points.normals[i][0], p.normal_y = points.normals[i][1];
            p.normal_z = points.normals[i][2];
          }
          cloud->push_back(p);
        }
        return cloud;
      },
      [&](const Cloud::Ptr& cloud) { return greedy(cloud, with_normals); },
      [&](const std::vector<pcl::Vertices>& polygons) { return surface_of(positions, polygons); });
}
