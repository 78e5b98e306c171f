#include "burnish/triangulation/iso_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "burnish/base/parallel.h"
#include "burnish/core/transform.h"
#include "burnish/triangulation/surface_loops.h"

namespace burnish {
namespace {

using Voxel = DistanceVolume::Voxel;
using State = Voxel::State;

constexpr int kSide = VoxelBlock::kSide;
constexpr std::size_t kBlocksAtOnce = 8;
constexpr float kLeastShare = 1.f / 32;  // of an edge, between a crossing and the voxels
constexpr float kMostSlope = 2;          // of the distance along an edge, besides the noise

/// A cube, its lowest corner a voxel of a block.
struct Cube {
  std::uint16_t first = 0;   ///< of its vertices, in its block
  std::uint8_t mask = 0;     ///< 0: the surface does not pass through it
  std::uint8_t turned = 0;   ///< see surface_loops
  std::uint8_t crossed = 0;  ///< bit a: the surface crosses the edge from the lowest corner along a
};

struct Vertex {
  Vec3f position;
  float sigma = 0;
  std::uint32_t observations = 0;  ///< 0: there is no vertex
  Origin origin = Origin::seen;
};

/// What one block adds to the surface.
struct BlockSurface {
  std::vector<Cube> cubes;  ///< empty where no cube has a vertex
  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;
  std::uint32_t first_vertex = 0;
};

std::size_t number_of(int x, int y, int z) {
  return static_cast<std::size_t>((z * kSide + y) * kSide + x);
}

/// Where the surface crosses the edge between two voxels, as a share from the first; negative where
/// it does not.
float crossing(const Voxel& a, const Voxel& b) {
  const bool a_inside = a.state == State::measured && a.distance < 0;
  const bool b_inside = b.state == State::measured && b.distance < 0;
  if (a_inside == b_inside) return -1;
  const Voxel &inside = a_inside ? a : b, &outside = a_inside ? b : a;
  const float noise = 3 / std::sqrt(inside.weight);
  float share = 0;
  if (outside.state == State::measured) {
    const float rise = outside.distance - inside.distance;
    if (rise > kMostSlope + noise + 3 / std::sqrt(outside.weight)) return -1;
    share = -inside.distance / rise;
  } else {
    if (-inside.distance > 1 + noise) return -1;
    share = -inside.distance;
  }
  share = std::clamp(share, kLeastShare, 1 - kLeastShare);
  return a_inside ? share : 1 - share;
}

class Extraction {
 public:
  Extraction(const DistanceVolume& volume, std::uint32_t min_observations)
      : volume_(volume),
        min_observations_(min_observations),
        order_(volume.blocks().in_order()),
        surfaces_(order_.size()),
        rank_(order_.size()) {
    for (std::uint32_t i = 0; i < order_.size(); ++i) rank_[order_[i]] = i;
    // The voxels around a vertex look through patches beside each other, or through the same one:
    // as through one patch half as wide again. It is nearly the same share for 2 and 8 pixels.
    vertex_share_ = variance_of_mean(6) / variance_of_mean(4);
  }

  Result<TriangleMesh> run(const Context& context) {
    TriangleMesh mesh;
    mesh.frame = frame_of_all();
    origin_ = mesh.frame.origin;
    const auto for_blocks = [&](const Context& part, auto work) {
      return parallel_for(
          part, order_.size(),
          [&](IndexRange range) {
            for (std::size_t i = range.begin; i < range.end; ++i) (this->*work)(i);
          },
          kBlocksAtOnce);
    };
    if (!for_blocks(context.part(0, 0.5), &Extraction::find_vertices)) return cancelled();
    std::uint32_t count = 0;
    for (BlockSurface& surface : surfaces_) {
      surface.first_vertex = count;
      count += static_cast<std::uint32_t>(surface.vertices.size());
    }
    if (!for_blocks(context.part(0.5, 0.9), &Extraction::find_triangles)) return cancelled();
    join(mesh);
    return mesh;
  }

 private:
  /// The voxels of a block and of the planes beyond it.
  using Corners = std::array<Voxel, (kSide + 1) * (kSide + 1) * (kSide + 1)>;

  static const Voxel& corner(const Corners& corners, int x, int y, int z) {
    return corners[static_cast<std::size_t>((z * (kSide + 1) + y) * (kSide + 1) + x)];
  }

  Frame frame_of_all() const {
    Vec3d low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high = -low;
    for (const BlockPlace& place : volume_.blocks().places()) {
      const Vec3d at = VoxelBlock::lowest(place);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], at[axis]);
        high[axis] = std::max(high[axis], at[axis]);
      }
    }
    if (order_.empty()) return {};
    return frame_near((low + high) * (volume_.voxel() / 2));
  }

  const VoxelBlock* block_at(const BlockPlace& place) const {
    const std::uint32_t i = volume_.blocks().find(place);
    return i == VoxelBlocks::kNone ? nullptr : &volume_.blocks()[i];
  }

  /// False where no cube of the block can have a vertex.
  bool read_corners(const BlockPlace& place, Corners& corners) const {
    bool any_inside = false;
    std::size_t n = 0;
    std::array<const VoxelBlock*, 8> blocks{};
    for (int i = 0; i < 8; ++i) {
      blocks[static_cast<std::size_t>(i)] =
          block_at({place.x + (i & 1), place.y + (i >> 1 & 1), place.z + (i >> 2)});
    }
    for (int z = 0; z <= kSide; ++z) {
      for (int y = 0; y <= kSide; ++y) {
        for (int x = 0; x <= kSide; ++x, ++n) {
          const int which = x / kSide + 2 * (y / kSide) + 4 * (z / kSide);
          const VoxelBlock* block = blocks[static_cast<std::size_t>(which)];
          corners[n] = {};
          if (!block) continue;
          corners[n] = DistanceVolume::read(*block, number_of(x % kSide, y % kSide, z % kSide),
                                            min_observations_);
          any_inside |= corners[n].state == State::measured && corners[n].distance < 0;
        }
      }
    }
    return any_inside;
  }

  /// Of eight corners; 0 where one was not seen.
  template <class VoxelAt>
  static unsigned mask_of(VoxelAt voxel_at) {
    unsigned mask = 0;
    for (int c = 0; c < 8; ++c) {
      const Voxel& voxel = voxel_at(c & 1, c >> 1 & 1, c >> 2);
      if (voxel.state == State::unseen) return 0;
      if (voxel.state == State::measured && voxel.distance < 0) mask |= 1u << c;
    }
    return mask == 255 ? 0 : mask;
  }

  /// The mask of a cube that may lie in another block.
  unsigned mask_at(BlockPlace place, std::array<int, 3> at) const {
    return mask_of([&](int x, int y, int z) -> Voxel {
      const std::array<int, 3> voxel{at[0] + x, at[1] + y, at[2] + z};
      const auto block_of = [](int i) { return (i + kSide) / kSide - 1; };
      const VoxelBlock* block =
          block_at({place.x + block_of(voxel[0]), place.y + block_of(voxel[1]),
                    place.z + block_of(voxel[2])});
      const auto within = [](int i) { return (i + kSide) % kSide; };
      if (!block) return {};
      return DistanceVolume::read(*block,
                                  number_of(within(voxel[0]), within(voxel[1]), within(voxel[2])),
                                  min_observations_);
    });
  }

  /// Which faces of a cube are to be turned.
  unsigned turned_faces(unsigned mask, const BlockPlace& place, std::array<int, 3> at) const {
    const unsigned doubled = doubled_faces(mask);
    unsigned turned = 0;
    for (unsigned face = 0; face < 6; ++face) {
      if (!(doubled >> face & 1)) continue;
      std::array<int, 3> beside = at;
      beside[face / 2] += face % 2 ? 1 : -1;
      if (doubled_faces(mask_at(place, beside)) >> (face ^ 1) & 1) turned |= 1u << face;
    }
    return turned;
  }

  void find_vertices(std::size_t rank) {
    const BlockPlace& place = volume_.blocks().places()[order_[rank]];
    Corners corners;
    if (!read_corners(place, corners)) return;
    BlockSurface& surface = surfaces_[rank];
    for (int z = 0; z < kSide; ++z) {
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          const auto voxel_at = [&](int i, int j, int k) -> const Voxel& {
            return corner(corners, x + i, y + j, z + k);
          };
          Cube cube;
          cube.mask = static_cast<std::uint8_t>(mask_of(voxel_at));
          if (cube.mask == 0) continue;
          cube.turned = static_cast<std::uint8_t>(turned_faces(cube.mask, place, {x, y, z}));
          cube.first = static_cast<std::uint16_t>(surface.vertices.size());
          const Vec3d lowest = VoxelBlock::lowest(place) + Vec3d(Vec3<int>{x, y, z});
          add_vertices(voxel_at, lowest, cube, surface.vertices);
          if (surface.cubes.empty()) surface.cubes.resize(VoxelBlock::kVoxels);
          surface.cubes[number_of(x, y, z)] = cube;
        }
      }
    }
  }

  /// The vertices of a cube: the means of the crossings of its loops.
  template <class VoxelAt>
  void add_vertices(VoxelAt voxel_at, const Vec3d& lowest, Cube& cube,
                    std::vector<Vertex>& vertices) const {
    const SurfaceLoops loops = surface_loops(cube.mask, cube.turned);
    struct Sum {
      Vec3d place;
      double count = 0, weight = 0;
      std::uint32_t observations = std::numeric_limits<std::uint32_t>::max();
      bool seen = true, whole = true;
    };
    std::array<Sum, 4> sums{};
    for (int edge = 0; edge < 12; ++edge) {
      const int loop = loops.of_edge[static_cast<std::size_t>(edge)];
      if (loop < 0) continue;
      const int begin = edge_begin(edge), end = begin | 1 << edge / 4;
      const Voxel& a = voxel_at(begin & 1, begin >> 1 & 1, begin >> 2);
      const Voxel& b = voxel_at(end & 1, end >> 1 & 1, end >> 2);
      const float share = crossing(a, b);
      Sum& sum = sums[static_cast<std::size_t>(loop)];
      if (share < 0) {
        sum.whole = false;
        continue;
      }
      if (edge % 4 == 0) cube.crossed = static_cast<std::uint8_t>(cube.crossed | 1u << edge / 4);
      Vec3d place{double(begin & 1), double(begin >> 1 & 1), double(begin >> 2)};
      place[static_cast<std::size_t>(edge / 4)] += share;
      sum.place += place;
      sum.count += 1;
      for (const auto& [voxel, part] : {std::pair(&a, 1 - share), std::pair(&b, share)}) {
        if (voxel->state == State::measured) {
          sum.weight += part * voxel->weight;
          sum.observations = std::min(sum.observations, voxel->observations);
        } else {
          sum.weight += part * (voxel == &a ? b : a).weight;
          sum.seen = false;
        }
      }
    }
    for (int loop = 0; loop < loops.count; ++loop) {
      const Sum& sum = sums[static_cast<std::size_t>(loop)];
      Vertex vertex;
      if (sum.whole) {
        vertex.position = Vec3f((lowest + sum.place / sum.count) * volume_.voxel() - origin_);
        vertex.sigma =
            static_cast<float>(volume_.voxel() * std::sqrt(vertex_share_ * sum.count / sum.weight));
        vertex.observations = sum.observations;
        vertex.origin = sum.seen ? Origin::seen : Origin::interpolated;
      }
      vertices.push_back(vertex);  // where the loop is not whole no triangle uses it
    }
  }

  /// The cubes around an edge, and which of their edges it is.
  void find_triangles(std::size_t rank) {
    BlockSurface& surface = surfaces_[rank];
    if (surface.cubes.empty()) return;
    const BlockPlace& place = volume_.blocks().places()[order_[rank]];
    std::array<const BlockSurface*, 8> before{};  // bit a: the block before along axis a
    for (int i = 0; i < 8; ++i) {
      const std::uint32_t block =
          volume_.blocks().find({place.x - (i & 1), place.y - (i >> 1 & 1), place.z - (i >> 2)});
      if (block != VoxelBlocks::kNone)
        before[static_cast<std::size_t>(i)] = &surfaces_[rank_[block]];
    }
    for (int n = 0; n < static_cast<int>(VoxelBlock::kVoxels); ++n) {
      const Cube& cube = surface.cubes[static_cast<std::size_t>(n)];
      const std::array<int, 3> at{n % kSide, n / kSide % kSide, n / kSide / kSide};
      for (int axis = 0; axis < 3; ++axis) {
        if (cube.crossed >> axis & 1) add_quad(before, at, axis, cube.mask & 1, surface.triangles);
      }
    }
  }

  /// The quadrilateral around the edge from voxel `at` along `axis`.
  void add_quad(const std::array<const BlockSurface*, 8>& before, const std::array<int, 3>& at,
                int axis, bool begins_inside, std::vector<Triangle>& triangles) const {
    const auto u = static_cast<std::size_t>((axis + 1) % 3),
               v = static_cast<std::size_t>((axis + 2) % 3);
    constexpr std::array<std::array<int, 2>, 4> kAround{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    std::array<std::uint32_t, 4> corners{};
    std::array<Vec3f, 4> places;
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<int, 3> cell = at;
      cell[u] -= kAround[i][0], cell[v] -= kAround[i][1];
      std::size_t block = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        if (cell[a] >= 0) continue;
        cell[a] += kSide;
        block |= std::size_t{1} << a;
      }
      if (!before[block] || before[block]->cubes.empty()) return;
      const Cube& cube = before[block]->cubes[number_of(cell[0], cell[1], cell[2])];
      if (cube.mask == 0) return;
      const int edge = 4 * axis + kAround[i][0] + 2 * kAround[i][1];
      const int loop =
          surface_loops(cube.mask, cube.turned).of_edge[static_cast<std::size_t>(edge)];
      const auto vertex = cube.first + static_cast<std::uint32_t>(loop);
      if (before[block]->vertices[vertex].observations == 0) return;
      corners[i] = before[block]->first_vertex + vertex;
      places[i] = before[block]->vertices[vertex].position;
    }
    if (!begins_inside) {
      std::swap(corners[1], corners[3]);
      std::swap(places[1], places[3]);
    }
    // The shorter diagonal.
    const auto [a, b, c, d] = corners;
    if (squared_norm(places[0] - places[2]) <= squared_norm(places[1] - places[3])) {
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    } else {
      triangles.push_back({b, c, d});
      triangles.push_back({b, d, a});
    }
  }

  void join(TriangleMesh& mesh) const {
    for (const BlockSurface& surface : surfaces_) {
      for (const Vertex& vertex : surface.vertices) {
        mesh.positions.push_back(vertex.position);
        mesh.attributes.sigma.push_back(vertex.sigma);
        mesh.attributes.observations.push_back(vertex.observations);
        mesh.attributes.origin.push_back(vertex.origin);
      }
      mesh.triangles.insert(mesh.triangles.end(), surface.triangles.begin(),
                            surface.triangles.end());
    }
    mesh = without_unused_vertices(mesh);
    mesh.attributes.normals = vertex_normals(mesh);
  }

  const DistanceVolume& volume_;
  std::uint32_t min_observations_;
  std::vector<std::uint32_t> order_;  ///< of the blocks, by place
  std::vector<BlockSurface> surfaces_;
  std::vector<std::uint32_t> rank_;  ///< of block i in the order
  Vec3d origin_;
  double vertex_share_ = 1;
};

}  // namespace

Result<TriangleMesh> iso_surface(const DistanceVolume& volume, int min_observations,
                                 const Context& context) {
  Result<TriangleMesh> mesh =
      Extraction(volume, static_cast<std::uint32_t>(min_observations)).run(context);
  if (mesh) context.progress(1);
  return mesh;
}

}  // namespace burnish
