#include "burnish/triangulation/surface_loops.h"

namespace burnish {
namespace {

/// The corners of a face in turn around it, and the edges from each to the next.
struct Face {
  std::array<int, 4> corners;
  std::array<std::size_t, 4> edges;
};

constexpr std::array<Face, 6> make_faces() {
  std::array<Face, 6> faces{};
  for (int f = 0; f < 6; ++f) {
    const int axis = f / 2, u = (axis + 1) % 3, v = (axis + 2) % 3, base = f % 2 << axis;
    faces[static_cast<std::size_t>(f)].corners = {base, base | 1 << u, base | 1 << u | 1 << v,
                                                  base | 1 << v};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& corners = faces[static_cast<std::size_t>(f)].corners;
      const int a = corners[i], b = corners[(i + 1) % 4];
      for (int edge = 0; edge < 12; ++edge) {
        const int begin = edge_begin(edge), end = begin | 1 << edge / 4;
        if ((begin == a && end == b) || (begin == b && end == a)) {
          faces[static_cast<std::size_t>(f)].edges[i] = static_cast<std::size_t>(edge);
        }
      }
    }
  }
  return faces;
}

constexpr std::array<Face, 6> kFaces = make_faces();

constexpr bool inside(unsigned mask, int corner) {
  return mask >> corner & 1;
}

SurfaceLoops trace(unsigned mask, unsigned turned) {
  std::array<std::size_t, 12> parent{};
  for (std::size_t edge = 0; edge < 12; ++edge) parent[edge] = edge;
  const auto root = [&](std::size_t edge) {
    while (parent[edge] != edge) edge = parent[edge];
    return edge;
  };
  const auto join = [&](std::size_t a, std::size_t b) { parent[root(a)] = root(b); };
  for (std::size_t f = 0; f < 6; ++f) {
    const Face& face = kFaces[f];
    std::array<std::size_t, 4> crossed{};
    int count = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      if (inside(mask, face.corners[i]) != inside(mask, face.corners[(i + 1) % 4])) {
        crossed[static_cast<std::size_t>(count++)] = face.edges[i];
      }
    }
    if (count == 2) join(crossed[0], crossed[1]);
    if (count != 4) continue;
    const bool around_inside = !(turned >> f & 1);
    for (std::size_t i = 0; i < 4; ++i) {
      if (inside(mask, face.corners[i]) == around_inside)
        join(face.edges[(i + 3) % 4], face.edges[i]);
    }
  }
  SurfaceLoops loops;
  loops.of_edge.fill(-1);
  for (int edge = 0; edge < 12; ++edge) {
    const int begin = edge_begin(edge);
    if (inside(mask, begin) == inside(mask, begin | 1 << edge / 4)) continue;
    std::int8_t& loop = loops.of_edge[root(static_cast<std::size_t>(edge))];
    if (loop < 0) loop = static_cast<std::int8_t>(loops.count++);
    loops.of_edge[static_cast<std::size_t>(edge)] = loop;
  }
  return loops;
}

unsigned find_doubled(unsigned mask) {
  const SurfaceLoops loops = trace(mask, 0);
  unsigned doubled = 0;
  for (std::size_t f = 0; f < 6; ++f) {
    const auto& edges = kFaces[f].edges;
    bool one_loop = loops.of_edge[edges[0]] >= 0;
    for (std::size_t i = 1; i < 4; ++i) {
      one_loop = one_loop && loops.of_edge[edges[i]] == loops.of_edge[edges[0]];
    }
    if (one_loop) doubled |= 1u << f;
  }
  return doubled;
}

/// Both of them for every mask, without turned faces.
struct Cases {
  std::array<SurfaceLoops, 256> loops;
  std::array<unsigned, 256> doubled;

  Cases() {
    for (unsigned mask = 0; mask < 256; ++mask) {
      loops[mask] = trace(mask, 0);
      doubled[mask] = find_doubled(mask);
    }
  }
};

const Cases& cases() {
  static const Cases all;
  return all;
}

}  // namespace

SurfaceLoops surface_loops(unsigned mask, unsigned turned) {
  return turned == 0 ? cases().loops[mask] : trace(mask, turned);
}

unsigned doubled_faces(unsigned mask) {
  return cases().doubled[mask];
}

}  // namespace burnish
