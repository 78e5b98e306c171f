#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "burnish/core/triangle_mesh.h"

// What the tests of the filters of face normals hold the library against: the papers' formulas in
// double, as loops over everything, without a part of the library but its vectors.
namespace burnish::test {

struct PlainFaces {
  std::vector<Vec3d> normals, centroids;
  std::vector<double> areas;
};

inline PlainFaces plain_faces(const std::vector<Triangle>& triangles,
                              const std::vector<Vec3d>& points) {
  PlainFaces faces;
  for (const auto& [a, b, c] : triangles) {
    const Vec3d doubled = cross(points[b] - points[a], points[c] - points[a]);
    faces.areas.push_back(norm(doubled) / 2);
    faces.normals.push_back(normalized(doubled));
    faces.centroids.push_back((points[a] + points[b] + points[c]) / 3.);
  }
  return faces;
}

using FaceSets = std::vector<std::set<std::size_t>>;

/// Per face which other faces share at least so many corners with it.
inline FaceSets faces_sharing(const std::vector<Triangle>& triangles, int corners) {
  std::map<std::uint32_t, std::set<std::size_t>> users;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    for (const std::uint32_t v : triangles[f]) users[v].insert(f);
  }
  FaceSets result(triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    std::map<std::size_t, int> shared;
    for (const std::uint32_t v :
         std::set<std::uint32_t>(triangles[f].begin(), triangles[f].end())) {
      for (const std::size_t g : users[v]) ++shared[g];
    }
    for (const auto& [g, count] : shared) {
      if (g != f && count >= corners) result[f].insert(g);
    }
  }
  return result;
}

/// The mean distance of the centroids of faces that share an edge.
inline double plain_spacing(const PlainFaces& faces, const FaceSets& across_edges) {
  double sum = 0, count = 0;
  for (std::size_t f = 0; f < across_edges.size(); ++f) {
    for (const std::size_t g : across_edges[f]) {
      sum += norm(faces.centroids[f] - faces.centroids[g]);
      ++count;
    }
  }
  return sum / count;
}

inline double gaussian_weight(double distance, double sigma) {
  return std::exp(-distance * distance / (2 * sigma * sigma));
}

/// Faces that are connected to `f` within `radius`, f included: taken in until nothing changes.
inline std::set<std::size_t> plain_ball(std::size_t f, double radius,
                                        const std::vector<Vec3d>& centroids,
                                        const FaceSets& neighbours) {
  std::set<std::size_t> ball{f};
  for (bool grows = true; grows;) {
    grows = false;
    for (const std::size_t g : std::set<std::size_t>(ball)) {
      for (const std::size_t h : neighbours[g]) {
        if (norm(centroids[h] - centroids[f]) < radius) grows |= ball.insert(h).second;
      }
    }
  }
  return ball;
}

struct PlainUpdate {
  int passes = 10;
  double equalizing = 0.3;
  bool free_boundary = false;
};

/// Sun et al. 2007, eq. 9, with areas as weights, and the equalizing of bad triangles' vertices.
inline void plain_vertex_update(const std::vector<Triangle>& triangles,
                                const std::vector<Vec3d>& wanted, const PlainUpdate& update,
                                std::vector<Vec3d>& points) {
  const PlainFaces before = plain_faces(triangles, points);
  const std::vector<Vec3d> start = points;
  std::vector<std::vector<std::size_t>> around(points.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const Triangle& t = triangles[f];
    for (const std::uint32_t v : std::set<std::uint32_t>(t.begin(), t.end())) {
      around[v].push_back(f);
    }
    for (int i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
      if (low != high) ++edges[{low, high}];
    }
  }
  std::set<std::uint32_t> boundary;
  std::vector<std::set<std::uint32_t>> ring(points.size());
  for (const auto& [edge, count] : edges) {
    ring[edge.first].insert(edge.second);
    ring[edge.second].insert(edge.first);
    if (count != 2) boundary.insert({edge.first, edge.second});
  }
  const auto is_bad = [&](std::size_t f) {
    const auto [a, b, c] = triangles[f];
    const double sides = squared_norm(start[a] - start[b]) + squared_norm(start[b] - start[c]) +
                         squared_norm(start[c] - start[a]);
    return before.areas[f] == 0 || dot(before.normals[f], wanted[f]) < 0.8 ||
           4 * std::sqrt(3.) * before.areas[f] / sides < 0.35;
  };
  for (int pass = 0; pass < update.passes; ++pass) {
    const std::vector<Vec3d> old = points;
    for (std::uint32_t v = 0; v < points.size(); ++v) {
      if (boundary.count(v) > 0 && !update.free_boundary) continue;
      Vec3d move, normal;
      double area = 0;
      bool bad = false;
      for (const std::size_t f : around[v]) {
        const auto [a, b, c] = triangles[f];
        const Vec3d centroid = (old[a] + old[b] + old[c]) / 3.;
        move += before.areas[f] * dot(wanted[f], centroid - old[v]) * wanted[f];
        normal += before.areas[f] * wanted[f];
        area += before.areas[f];
        bad = bad || is_bad(f);
      }
      if (area > 0) points[v] += move / area;
      if (!bad || boundary.count(v) > 0) continue;
      normal = normalized(normal);
      double bend = 0;
      for (const std::size_t f : around[v]) {
        if (before.areas[f] > 0) bend = std::max(bend, 1 - dot(wanted[f], normal));
      }
      Vec3d way;
      double lengths = 0;
      for (const std::uint32_t w : ring[v]) {
        const Vec3d edge = old[w] - old[v];
        way += norm(edge) * edge;
        lengths += norm(edge);
      }
      if (lengths == 0) continue;
      way = way / lengths;
      way -= dot(way, normal) * normal;
      points[v] += update.equalizing * std::exp(-bend / 0.03) * way;
    }
  }
}

inline double diagonal(const std::vector<Vec3f>& points) {
  Vec3d low(points.front()), high = low;
  for (const Vec3f& p : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min<double>(low[axis], p[axis]);
      high[axis] = std::max<double>(high[axis], p[axis]);
    }
  }
  return norm(high - low);
}

inline std::vector<Vec3d> doubles(const std::vector<Vec3f>& points) {
  std::vector<Vec3d> result;
  for (const Vec3f& p : points) result.push_back(Vec3d(p));
  return result;
}

inline double farthest(const std::vector<Vec3f>& ours, const std::vector<Vec3d>& expected) {
  double largest = 0;
  for (std::size_t v = 0; v < ours.size(); ++v) {
    largest = std::max(largest, norm(Vec3d(ours[v]) - expected[v]));
  }
  return largest;
}

}  // namespace burnish::test
