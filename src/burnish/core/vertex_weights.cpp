#include "burnish/core/vertex_weights.h"

#include <string>
#include <variant>

namespace burnish {

Result<std::vector<float>> vertex_weights(const TriangleMesh& mesh, std::string_view name) {
  for (const Channel& channel : mesh.attributes.channels) {
    if (channel.name != name) continue;
    const auto* weights = std::get_if<std::vector<float>>(&channel.values);
    if (weights == nullptr) {
      return Error{ErrorCode::bad_geometry, "the channel must hold floats", channel.name};
    }
    for (std::size_t v = 0; v < weights->size(); ++v) {
      if (!((*weights)[v] >= 0 && (*weights)[v] <= 1)) {
        return Error{ErrorCode::bad_geometry,
                     "a weight from 0 to 1 was expected, not " + std::to_string((*weights)[v]),
                     channel.name + ", vertex " + std::to_string(v)};
      }
    }
    return *weights;
  }
  return std::vector<float>{};
}

}  // namespace burnish
