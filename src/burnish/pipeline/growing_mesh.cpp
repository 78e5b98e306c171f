#include "burnish/pipeline/growing_mesh.h"

namespace burnish {

void GrowingMesh::reserve(std::size_t vertices, std::size_t triangles) {
  stars.reserve(vertices, triangles);
  vertex_indices.reserve(vertices);
  triangle_indices.reserve(triangles);
}

void GrowingMesh::add_vertex(std::uint32_t index) {
  vertex_indices.push_back(index);
  stars.add_vertex();
}

void GrowingMesh::add_triangle(const Triangle& triangle, std::uint32_t index) {
  triangle_indices.push_back(index);
  stars.add_triangle(triangle);
}

void GrowingMesh::split(const VertexSplit& split) {
  const auto vertex = static_cast<std::uint32_t>(stars.vertices());
  add_vertex(split.index);
  stars.move(split.into, vertex, split.moves);
  for (std::size_t i = 0; i < split.returning_count; ++i) {
    const ReturningTriangle& back = split.returning[i];
    const std::array<std::uint32_t, 3> names{split.into, vertex, back.apex};
    const std::array<std::uint8_t, 3>& order = kCornerOrders[back.order];
    add_triangle({names[order[0]], names[order[1]], names[order[2]]}, back.index);
  }
}

}  // namespace burnish
