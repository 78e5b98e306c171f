#include "burnish/smoothing/patch_guidance.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "burnish/smoothing/parallel_rows.h"

namespace burnish {
namespace {

/// The normals of a patch, which are compared with each other four at a time.
class PatchNormals {
 public:
  explicit PatchNormals(std::size_t most) : members_(most + 3), fours_(most / 4 + 1) {}

  void gather(std::span<const std::uint32_t> faces, const FaceNormals& normals) {
    count_ = 0;
    sum_ = Quad();
    for (const std::uint32_t f : faces) {
      const Quad normal = normals[f];
      members_[count_] = normal;
      count_ += normal.w() > 0;
      sum_ += normal.w() * normal;
    }
    // The last four are filled up with copies, which differ from nothing more than what is there.
    for (std::size_t i = count_; i % 4 != 0; ++i) members_[i] = members_[0];
    for (std::size_t i = 0; i < count_; i += 4) {
      const Quad &a = members_[i], &b = members_[i + 1], &c = members_[i + 2], &d = members_[i + 3];
      fours_[i / 4] = {Quad(a[0], b[0], c[0], d[0]), Quad(a[1], b[1], c[1], d[1]),
                       Quad(a[2], b[2], c[2], d[2])};
    }
  }

  /// max |n_a - n_b|
  float largest_difference() const {
    Quad largest;
    for (std::size_t k = 0; 4 * k < count_; ++k) {
      const Four four = fours_[k];
      const std::size_t end = std::min(count_, 4 * k + 4);
      for (std::size_t i = 0; i < end; ++i) {
        const Quad dx = four.x - splat<0>(members_[i]);
        const Quad dy = four.y - splat<1>(members_[i]);
        const Quad dz = four.z - splat<2>(members_[i]);
        largest = larger(largest, dx * dx + dy * dy + dz * dz);
      }
    }
    return std::sqrt(std::max(std::max(largest[0], largest[1]), std::max(largest[2], largest[3])));
  }

  /// The area-mean normal; 0 where they cancel.
  Quad mean() const {
    const float length = std::sqrt(dot3(sum_, sum_));
    return length > 0 ? (1 / length) * sum_ : Quad();
  }

 private:
  struct Four {
    Quad x, y, z;
  };
  std::vector<Quad> members_;
  std::vector<Four> fours_;
  std::size_t count_ = 0;
  Quad sum_;
};

}  // namespace

bool PatchGuidance::prepare(const Context& context, const Adjacency& edge_neighbours,
                            const Adjacency& vertex_neighbours) {
  members_ = &vertex_neighbours;
  const std::size_t faces = edge_neighbours.size();
  // Pairs are numbered by their smaller face, then by the other.
  std::vector<std::uint32_t> first_pair(faces + 1, 0);
  pairs_.clear();
  for (std::uint32_t f = 0; f < faces; ++f) {
    first_pair[f] = static_cast<std::uint32_t>(pairs_.size());
    for (const std::uint32_t g : edge_neighbours.row(f)) {
      if (g > f) pairs_.push_back({f, g});
    }
  }
  first_pair[faces] = static_cast<std::uint32_t>(pairs_.size());
  differences_.resize(pairs_.size());
  patches_.resize(faces);
  inconsistencies_.resize(faces);
  most_members_ = 0;
  for (std::size_t f = 0; f < faces; ++f) {
    most_members_ = std::max(most_members_, vertex_neighbours.row(f).size());
  }

  const auto make_append = [&] {
    return [&](std::size_t f, auto& items) {
      const auto members = vertex_neighbours.row(f);
      std::uint64_t marks = 0;  // which residues there are among them: mostly settles who is not
      for (const std::uint32_t g : members) marks |= std::uint64_t{1} << (g % 64);
      for (const std::uint32_t g : members) {
        for (std::uint32_t pair = first_pair[g]; pair < first_pair[g + 1]; ++pair) {
          const std::uint32_t h = pairs_[pair][1];
          if ((marks >> (h % 64) & 1) == 0) continue;
          if (std::binary_search(members.begin(), members.end(), h)) items.push_back(pair);
        }
      }
    };
  };
  return build_rows(context, faces, make_append, inner_edges_);
}

bool PatchGuidance::find(const Context& context, const FaceNormals& normals,
                         std::vector<Quad>& guidance) {
  guidance.resize(normals.size());
  const bool differences_done =
      parallel_for(context.part(0, 0.2), pairs_.size(), [&](IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i) {
          const Quad one = normals[pairs_[i][0]], other = normals[pairs_[i][1]];
          const Quad apart = one - other;
          differences_[i] = one.w() > 0 && other.w() > 0 ? std::sqrt(dot3(apart, apart)) : 0;
        }
      });
  if (!differences_done) return false;

  const bool patches_done =
      parallel_for(context.part(0.2, 0.8), normals.size(), [&](IndexRange range) {
        PatchNormals patch(most_members_);
        for (std::size_t f = range.begin; f < range.end; ++f) {
          patch.gather(members_->row(f), normals);
          float largest = 0, sum = 1e-9f;
          for (const std::uint32_t pair : inner_edges_.row(f)) {
            largest = std::max(largest, differences_[pair]);
            sum += differences_[pair];
          }
          patches_[f] = patch.mean();
          inconsistencies_[f] = patch.largest_difference() * (largest / sum);
        }
      });
  if (!patches_done) return false;

  return parallel_for(context.part(0.8, 1), normals.size(), [&](IndexRange range) {
    for (std::size_t f = range.begin; f < range.end; ++f) {
      // Who is best cannot be predicted, so that no branch may depend on it. The bits of floats
      // that are not negative rise with them.
      std::uint64_t best = ~std::uint64_t{0};
      for (const std::uint32_t g : members_->row(f)) {
        const std::uint64_t rank = std::bit_cast<std::uint32_t>(inconsistencies_[g]);
        best = std::min(best, rank << 32 | g);
      }
      guidance[f] = patches_[static_cast<std::uint32_t>(best)];
    }
  });
}

}  // namespace burnish
