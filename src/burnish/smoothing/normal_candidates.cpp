#include "burnish/smoothing/normal_candidates.h"

#include <algorithm>

#include "burnish/smoothing/normal_filter.h"

namespace burnish {
namespace {

constexpr float kReach = 2;  // of the weights' fall with distance, in units of FaceSurface

/// Passes of one filter, of which some results are kept.
struct Chain {
  float width;  ///< of the weights' fall with the difference of normals; 0: they do not fall
  std::vector<int> kept_after;
};

const std::vector<Chain>& chains() {
  static const std::vector<Chain> list{{0, {1, 2, 4, 8}}, {0.35f, {3, 8}}, {0.7f, {3, 8}}};
  return list;
}

int all_passes() {
  int sum = 0;
  for (const Chain& chain : chains()) sum += chain.kept_after.back();
  return sum;
}

}  // namespace

bool normal_candidates(const FaceGeometry& faces, const Adjacency& around, const Context& context,
                       NormalCandidates& candidates) {
  candidates.normals.resize(faces.normals.size() * NormalCandidates::kCount);
  std::size_t place = 0;
  const auto keep = [&](const FaceNormals& normals) {
    for (std::size_t f = 0; f < normals.size(); ++f) {
      candidates.normals[f * NormalCandidates::kCount + place] = normals[f];
    }
    ++place;
  };
  keep(faces.normals);
  std::vector<float> weights;
  if (!near_weights(context.part(0, 0.05), around, faces, kReach, weights)) return false;
  FaceNormals normals, next;
  const Context filtering = context.part(0.05, 1);
  const double passes = all_passes();
  double done = 0;
  for (const Chain& chain : chains()) {
    normals = faces.normals;
    for (int i = 1; i <= chain.kept_after.back(); ++i) {
      const std::span<const Quad> guidance = chain.width > 0 ? normals : std::span<const Quad>{};
      const Context share = filtering.part(done / passes, (done + 1) / passes);
      if (!filter_normals(share, around, weights, guidance, chain.width, normals, next)) {
        return false;
      }
      std::swap(normals, next);
      done += 1;
      const auto& kept = chain.kept_after;
      if (std::find(kept.begin(), kept.end(), i) != kept.end()) keep(normals);
    }
  }
  return true;
}

}  // namespace burnish
