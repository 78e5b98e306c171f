#include "burnish/pipeline/confinement.h"

#include <algorithm>
#include <string>

#include "burnish/smoothing/smoothing_weights.h"

namespace burnish {
namespace {

auto weights_channel(std::vector<Channel>& channels) {
  return std::find_if(channels.begin(), channels.end(),
                      [](const Channel& channel) { return channel.name == kSmoothingWeight; });
}

}  // namespace

Result<std::vector<float>> weights_inside(const TriangleMesh& mesh, const Region& region) {
  Result<std::vector<float>> weights = smoothing_weights(mesh);
  if (!weights) return weights;
  if (weights->empty()) weights->assign(mesh.positions.size(), 1.0f);
  bool any = false;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (contains(region, mesh.frame.origin + Vec3d(mesh.positions[v]))) {
      any = true;
    } else {
      (*weights)[v] = 0;
    }
  }
  if (any) return weights;
  return Error{ErrorCode::invalid_argument, "no vertex lies in '" + to_string(region) + "'", {}};
}

TemporaryWeights::TemporaryWeights(TriangleMesh& mesh, std::vector<float> weights) : mesh_(mesh) {
  std::vector<Channel>& channels = mesh.attributes.channels;
  const auto found = weights_channel(channels);
  if (found == channels.end()) {
    channels.push_back({std::string(kSmoothingWeight), std::move(weights)});
  } else {
    before_.push_back(std::move(*found));
    *found = {std::string(kSmoothingWeight), std::move(weights)};
  }
}

TemporaryWeights::~TemporaryWeights() {
  std::vector<Channel>& channels = mesh_.attributes.channels;
  const auto found = weights_channel(channels);
  if (before_.empty()) {
    channels.erase(found);
  } else {
    *found = std::move(before_.front());
  }
}

}  // namespace burnish
