#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/spatial_sort.h>

#include "surface_peer.h"

// surface_cgal IN OUT ROUNDS: advancing front (Cohen-Steiner and Da 2004) over the Delaunay
// triangulation of all points, with the defaults of CGAL's manual.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Facets = std::vector<std::array<std::size_t, 3>>;

int main(int argc, char** argv) {
  if (argc != 4) return 2;
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
