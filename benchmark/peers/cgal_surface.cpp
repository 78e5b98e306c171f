#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "surface_peer.h"

// surface_cgal IN OUT front|delaunay: advancing front (Cohen-Steiner and Da 2004) over the Delaunay
// triangulation of all points, with the defaults of CGAL's manual; or the Delaunay triangulation of
// x and y.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

static int advancing_front(char** argv) {
  using Facets = std::vector<std::array<std::size_t, 3>>;
  std::vector<Point> positions;
  return run_peer(
      argv,
      [&](const Points& points) {
        positions = points.positions;
        std::vector<Kernel::Point_3> input;
        for (const Point& p : points.positions) input.emplace_back(p[0], p[1], p[2]);
        return input;
      },
      [](const std::vector<Kernel::Point_3>& input) {
        Facets facets;
        CGAL::advancing_front_surface_reconstruction(input.begin(), input.end(),
                                                     std::back_inserter(facets));
        return facets;
      },
      [&](const Facets& facets) {
        Surface surface{positions, {}};
        for (const auto& [a, b, c] : facets) {
          surface.triangles.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                                       static_cast<std::uint32_t>(c)});
        }
        return surface;
      });
}

static int delaunay(char** argv) {
  using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
  using Structure = CGAL::Triangulation_data_structure_2<Vertex>;
  using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, Structure>;
  std::vector<Point> positions;
  return run_peer(
      argv,
      [&](const Points& points) {
        positions = points.positions;
        std::vector<std::pair<Kernel::Point_2, std::uint32_t>> input;
        for (const Point& p : points.positions) {
          input.emplace_back(Kernel::Point_2(p[0], p[1]), static_cast<std::uint32_t>(input.size()));
        }
        return input;
      },
      [](const auto& input) {
        const Delaunay delaunay(input.begin(), input.end());
        Triangles triangles;
        for (const auto& face : delaunay.finite_face_handles()) {
          triangles.push_back(
              {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
        }
        return triangles;
      },
      [&](const Triangles& triangles) {
        return Surface{positions, triangles};
      });
}

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  return std::strcmp(argv[3], "delaunay") == 0 ? delaunay(argv) : advancing_front(argv);
}
