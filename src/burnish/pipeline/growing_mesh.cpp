#include "burnish/pipeline/growing_mesh.h"

#include <utility>

namespace burnish {

void CornerStars::reserve(std::size_t vertices, std::size_t triangles) {
  first_.reserve(vertices);
  next_.reserve(3 * triangles);
}

void CornerStars::add_triangle(const Triangle& triangle) {
  for (const std::uint32_t v : triangle) {
    next_.push_back(first_[v]);
    first_[v] = static_cast<std::uint32_t>(next_.size() - 1);
  }
}

void CornerStars::take(std::uint32_t vertex, std::uint32_t corner) {
  std::uint32_t* link = &first_[vertex];
  while (*link != corner) link = &next_[*link];
  *link = next_[corner];
}

void CornerStars::move(std::uint32_t from, std::uint32_t to, std::span<const std::uint8_t> moves) {
  std::uint32_t corner = first_[from];
  std::array<std::uint32_t*, 2> ends{&first_[from], &first_[to]};
  for (const std::uint8_t moved : moves) {
    *ends[moved] = corner;
    ends[moved] = &next_[corner];
    corner = next_[corner];
  }
  for (std::uint32_t* end : ends) *end = kEnd;
}

void GrowingMesh::reserve(std::size_t vertices, std::size_t triangles) {
  vertex_indices_.reserve(vertices);
  triangles_.reserve(triangles);
  triangle_indices_.reserve(triangles);
  stars_.reserve(vertices, triangles);
}

void GrowingMesh::add_vertex(std::uint32_t index) {
  vertex_indices_.push_back(index);
  stars_.add_vertex();
}

void GrowingMesh::add_triangle(const Triangle& triangle, std::uint32_t index) {
  triangles_.push_back(triangle);
  triangle_indices_.push_back(index);
  stars_.add_triangle(triangle);
}

void GrowingMesh::split(const VertexSplit& split) {
  const auto vertex = static_cast<std::uint32_t>(vertices());
  add_vertex(split.index);
  std::uint32_t corner = stars_.first(split.into);
  for (const std::uint8_t moved : split.moves) {
    if (moved != 0) triangles_[corner / 3][corner % 3] = vertex;
    corner = stars_.next(corner);
  }
  stars_.move(split.into, vertex, split.moves);
  for (std::size_t i = 0; i < split.returning_count; ++i) {
    const ReturningTriangle& back = split.returning[i];
    const std::array<std::uint32_t, 3> names{split.into, vertex, back.apex};
    const std::array<std::uint8_t, 3>& order = kCornerOrders[back.order];
    add_triangle({names[order[0]], names[order[1]], names[order[2]]}, back.index);
  }
}

GrowingMesh::Parts GrowingMesh::parts() && {
  stars_ = {};
  return {std::move(triangles_), std::move(vertex_indices_), std::move(triangle_indices_)};
}

}  // namespace burnish
