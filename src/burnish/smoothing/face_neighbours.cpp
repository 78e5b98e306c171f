#include "burnish/smoothing/face_neighbours.h"

#include <algorithm>
#include <iterator>

#include "burnish/smoothing/parallel_rows.h"

namespace burnish {
namespace {

bool has_corner(const Triangle& t, std::uint32_t v) {
  return t[0] == v || t[1] == v || t[2] == v;
}

/// Adds to `items` what `found` holds beyond its first `from` entries, sorted, each once.
void sort_new(std::vector<std::uint32_t>& items, std::size_t from) {
  const auto begin = items.begin() + static_cast<std::ptrdiff_t>(from);
  std::sort(begin, items.end());
  items.erase(std::unique(begin, items.end()), items.end());
}

}  // namespace

bool edge_neighbours(const Context& context, const TriangleMesh& mesh,
                     const Adjacency& faces_of_vertices, Adjacency& neighbours) {
  const auto make_append = [&] {
    return [&, on_edge = std::vector<std::uint32_t>()](std::size_t f, auto& items) mutable {
      const std::size_t begin = items.size();
      const Triangle& face = mesh.triangles[f];
      for (std::size_t i = 0; i < 3; ++i) {
        std::uint32_t a = face[i], b = face[(i + 1) % 3];
        if (a == b) continue;
        if (faces_of_vertices.row(b).size() < faces_of_vertices.row(a).size()) std::swap(a, b);
        on_edge.clear();
        for (const std::uint32_t g : faces_of_vertices.row(a)) {
          if (g != f && has_corner(mesh.triangles[g], b)) on_edge.push_back(g);
        }
        if (on_edge.size() < kMostFacesOfACorner) {
          items.insert(items.end(), on_edge.begin(), on_edge.end());
        }
      }
      sort_new(items, begin);
    };
  };
  return build_rows(context, mesh.triangles.size(), make_append, neighbours);
}

bool vertex_neighbours(const Context& context, const TriangleMesh& mesh,
                       const Adjacency& faces_of_vertices, const Adjacency& edge_neighbours,
                       Adjacency& neighbours) {
  const auto make_append = [&] {
    return [&, merged = std::vector<std::uint32_t>(), sum = std::vector<std::uint32_t>()](
               std::size_t f, auto& items) mutable {
      const auto across_edges = edge_neighbours.row(f);
      merged.assign(across_edges.begin(), across_edges.end());
      merged.insert(std::lower_bound(merged.begin(), merged.end(), f),
                    static_cast<std::uint32_t>(f));
      for (const std::uint32_t v : mesh.triangles[f]) {
        const auto around = faces_of_vertices.row(v);
        if (around.size() > kMostFacesOfACorner) continue;
        sum.clear();
        std::set_union(merged.begin(), merged.end(), around.begin(), around.end(),
                       std::back_inserter(sum));
        std::swap(merged, sum);
      }
      items.insert(items.end(), merged.begin(), merged.end());
    };
  };
  return build_rows(context, mesh.triangles.size(), make_append, neighbours);
}

bool connected_within(const Context& context, float radius, const std::vector<Quad>& points,
                      const Adjacency& neighbours, Adjacency& balls) {
  constexpr std::uint32_t kNever = ~0u;
  const float limit = radius * radius;
  const auto make_append = [&] {
    return [&, seen_from = std::vector<std::uint32_t>(points.size(), kNever)](std::size_t i,
                                                                              auto& items) mutable {
      // Breadth first; what is found is its own queue.
      const std::size_t begin = items.size();
      const auto own = static_cast<std::uint32_t>(i);
      seen_from[i] = own;
      items.push_back(own);
      for (std::size_t next = begin; next < items.size(); ++next) {
        for (const std::uint32_t j : neighbours.row(items[next])) {
          if (seen_from[j] == own) continue;
          seen_from[j] = own;
          const Quad offset = points[j] - points[i];
          if (!(dot3(offset, offset) < limit)) continue;
          items.push_back(j);
          if (items.size() - begin == kMostInABall) return sort_new(items, begin);
        }
      }
      sort_new(items, begin);
    };
  };
  return build_rows(context, points.size(), make_append, balls);
}

}  // namespace burnish
