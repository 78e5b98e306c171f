#include "burnish/pipeline/confinement.h"

#include <algorithm>

#include "burnish/core/vertex_weights.h"

namespace burnish {
namespace {

auto channel_called(TriangleMesh& mesh, std::string_view name) {
  std::vector<Channel>& channels = mesh.attributes.channels;
  return std::find_if(channels.begin(), channels.end(),
                      [&](const Channel& channel) { return channel.name == name; });
}

Result<std::vector<bool>> unless_none(std::vector<bool> inside, const char* failure,
                                      const Region& region) {
  if (std::find(inside.begin(), inside.end(), true) != inside.end()) return inside;
  return Error{
      ErrorCode::invalid_argument, std::string(failure) + " '" + to_string(region) + "'", {}};
}

}  // namespace

Result<std::vector<bool>> vertices_inside(const TriangleMesh& mesh, const Region& region) {
  std::vector<bool> inside(mesh.positions.size());
  for (std::size_t v = 0; v < inside.size(); ++v) {
    inside[v] = contains(region, mesh.frame.origin + Vec3d(mesh.positions[v]));
  }
  return unless_none(std::move(inside), "no vertex lies in", region);
}

Result<std::vector<bool>> corners_of_triangles_in(const TriangleMesh& mesh, const Region& region) {
  std::vector<bool> inside(mesh.positions.size());
  const auto place = [&](std::uint32_t v) { return mesh.frame.origin + Vec3d(mesh.positions[v]); };
  for (const auto& [a, b, c] : mesh.triangles) {
    if (!meets(region, place(a), place(b), place(c))) continue;
    inside[a] = inside[b] = inside[c] = true;
  }
  return unless_none(std::move(inside), "no triangle has a point in", region);
}

Result<std::vector<float>> confined_weights(const TriangleMesh& mesh, std::string_view channel,
                                            const std::vector<bool>& inside) {
  Result<std::vector<float>> weights = vertex_weights(mesh, channel);
  if (!weights) return weights;
  if (weights->empty()) weights->assign(mesh.positions.size(), 1.0f);
  for (std::size_t v = 0; v < inside.size(); ++v) {
    if (!inside[v]) (*weights)[v] = 0;
  }
  return weights;
}

TemporaryWeights::TemporaryWeights(TriangleMesh& mesh, std::string_view channel,
                                   std::vector<float> weights)
    : mesh_(mesh), channel_(channel), set_aside_(channel) {
  std::vector<Channel>& channels = mesh.attributes.channels;
  const auto found = channel_called(mesh, channel);
  if (found != channels.end()) {
    while (channel_called(mesh, set_aside_) != channels.end()) set_aside_ += " before";
    found->name = set_aside_;
  }
  channels.push_back({channel_, std::move(weights)});
}

TemporaryWeights::~TemporaryWeights() {
  mesh_.attributes.channels.erase(channel_called(mesh_, channel_));
  if (set_aside_ != channel_) channel_called(mesh_, set_aside_)->name = channel_;
}

}  // namespace burnish
