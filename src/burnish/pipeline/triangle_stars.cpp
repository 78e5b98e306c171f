#include "burnish/pipeline/triangle_stars.h"

namespace burnish {

void TriangleStars::reserve(std::size_t vertices, std::size_t triangles) {
  first_.reserve(vertices);
  triangles_.reserve(triangles);
}

void TriangleStars::add_triangle(const Triangle& triangle) {
  const auto corner = static_cast<std::uint32_t>(3 * triangles_.size());
  triangles_.emplace_back();
  for (std::uint32_t k = 0; k < 3; ++k) put(corner + k, triangle[k]);
}

void TriangleStars::take(std::uint32_t corner) {
  std::uint32_t* link = &first_[vertex_at(corner)];
  while (*link != corner) link = &next_of(*link);
  *link = next_of(corner);
}

void TriangleStars::put(std::uint32_t corner, std::uint32_t vertex) {
  triangles_[corner / 3].vertices[corner % 3] = vertex;
  next_of(corner) = first_[vertex];
  first_[vertex] = corner;
}

void TriangleStars::move(std::uint32_t from, std::uint32_t to,
                         std::span<const std::uint8_t> moves) {
  const std::array<std::uint32_t, 2> owners{from, to};
  std::array<std::uint32_t*, 2> ends{&first_[from], &first_[to]};
  std::uint32_t corner = first_[from];
  for (const std::uint8_t moved : moves) {
    triangles_[corner / 3].vertices[corner % 3] = owners[moved];
    *ends[moved] = corner;
    ends[moved] = &next_of(corner);
    corner = *ends[moved];
  }
  for (std::uint32_t* end : ends) *end = kEnd;
}

}  // namespace burnish
