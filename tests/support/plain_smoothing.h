#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "burnish/shapes/shapes.h"
#include "burnish/smoothing/smoothing.h"
#include "support/bunny.h"
#include "support/random_mesh.h"
#include "support/test_data.h"

// What the tests share that compare a smoothing with its paper's formula, evaluated as plainly as
// can be: in double, from sets and maps, without any of the library's helpers.
namespace burnish::test {

using PlainRings = std::vector<std::set<std::uint32_t>>;

/// The neighbours that the boundary rule leaves each vertex.
inline PlainRings plain_rings(const TriangleMesh& mesh, BoundaryRule rule) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const auto& [v, w] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
      if (v != w) ++edges[{std::min(v, w), std::max(v, w)}];
    }
  }
  PlainRings all(mesh.positions.size()), along = all;
  for (const auto& [ends, triangles] : edges) {
    all[ends.first].insert(ends.second);
    all[ends.second].insert(ends.first);
    if (triangles == 2) continue;
    along[ends.first].insert(ends.second);
    along[ends.second].insert(ends.first);
  }
  for (std::size_t v = 0; v < all.size(); ++v) {
    if (rule == BoundaryRule::free || along[v].empty()) continue;
    if (rule == BoundaryRule::fixed) all[v].clear();
    if (rule == BoundaryRule::along_boundary) all[v] = along[v];
  }
  return all;
}

/// The mean of `values` over the ring of v; that of v itself where the ring is empty.
inline Vec3d plain_mean(const PlainRings& rings, const std::vector<Vec3d>& values, std::size_t v) {
  Vec3d sum;
  for (const std::uint32_t w : rings[v]) sum += values[w];
  return rings[v].empty() ? values[v] : sum / static_cast<double>(rings[v].size());
}

inline std::vector<Vec3d> plain_positions(const TriangleMesh& mesh) {
  std::vector<Vec3d> result;
  for (const Vec3f& p : mesh.positions) result.push_back(Vec3d(p));
  return result;
}

inline double diagonal(const TriangleMesh& mesh) {
  Vec3d low(mesh.positions[0]), high = low;
  for (const Vec3f& p : mesh.positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min<double>(low[axis], p[axis]);
      high[axis] = std::max<double>(high[axis], p[axis]);
    }
  }
  return norm(high - low);
}

/// A closed polygon of n vertices, as the boundary of a disc; its waves are the eigenvectors of the
/// umbrella operator along it, with the frequencies 1 - cos(2 pi wave / n).
inline TriangleMesh disc_with_wave(std::uint32_t n, std::uint32_t wave) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    mesh.positions.push_back(
        Vec3f(Vec3d{std::cos(angle), std::sin(angle), 0.1 * std::cos(wave * angle)}));
    mesh.triangles.push_back({i, (i + 1) % n, n});
  }
  mesh.positions.push_back({});
  return mesh;
}

/// Of a closed mesh, m^3.
inline double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum +=
        dot(Vec3d(mesh.positions[a]), cross(Vec3d(mesh.positions[b]), Vec3d(mesh.positions[c]))) /
        6;
  }
  return sum;
}

/// `smooth(mesh, rule)` must move each vertex of `before` to where `plain(mesh, rule)` says, within
/// 1e-6 of the diagonal.
template <class Smooth, class Plain>
void expect_as_plain(const TriangleMesh& before, Smooth smooth, Plain plain) {
  for (const BoundaryRule rule :
       {BoundaryRule::fixed, BoundaryRule::along_boundary, BoundaryRule::free}) {
    SCOPED_TRACE(boundary_rule_names()[static_cast<std::size_t>(rule)].first);
    TriangleMesh mesh = before;
    const auto report = smooth(mesh, rule);
    ASSERT_TRUE(report) << report.error().text();
    const std::vector<Vec3d> expected = plain(before, rule);
    double largest = 0;
    for (std::size_t v = 0; v < expected.size(); ++v) {
      largest = std::max(largest, norm(Vec3d(mesh.positions[v]) - expected[v]));
    }
    EXPECT_LE(largest, 1e-6 * diagonal(before));
  }
}

/// The same on random meshes with every defect, on a noisy sphere and on a noisy patch.
template <class Smooth, class Plain>
void expect_as_plain_on_random_meshes(Smooth smooth, Plain plain) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    expect_as_plain(random_mesh(30, 40, seed), smooth, plain);
    expect_as_plain(random_mesh(200, 150, seed), smooth, plain);
    expect_as_plain(with_noise(make_sphere(0.7, 2), 0.02, seed), smooth, plain);
    expect_as_plain(with_noise(make_grid(12, 9, 0.1), 0.03, seed), smooth, plain);
  }
}

}  // namespace burnish::test

/// And on the bunny, in a test that is skipped where there is none.
#define BURNISH_EXPECT_AS_PLAIN_ON_THE_BUNNY(smooth, plain)    \
  BURNISH_DATA_OR_SKIP(bunny_path, "stanford/bun_zipper.ply"); \
  burnish::test::expect_as_plain(burnish::test::read_bunny(bunny_path), smooth, plain)
