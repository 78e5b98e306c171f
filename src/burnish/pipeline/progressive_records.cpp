#include "burnish/pipeline/progressive_records.h"

#include <bit>

#include "burnish/pipeline/progressive_bytes.h"

namespace burnish {
namespace {

/// Stars up to this are told by a bit a corner, larger ones by runs.
constexpr std::size_t kMaskedCorners = 32;

void put_moves(std::string& bytes, const std::vector<std::uint8_t>& moves) {
  if (moves.size() <= kMaskedCorners) {
    std::uint32_t mask = 0;
    for (std::size_t i = 0; i < moves.size(); ++i)
      mask |= static_cast<std::uint32_t>(moves[i]) << i;
    for (std::size_t i = 0; i < moves.size(); i += 8) bytes += static_cast<char>(mask >> i & 0xff);
    return;
  }
  std::uint8_t kind = 0;
  for (std::size_t begin = 0, end = 0; begin < moves.size(); begin = end, kind ^= 1) {
    while (end < moves.size() && moves[end] == kind) ++end;
    put_number(bytes, end - begin);
  }
}

/// Into `moves`, which has its length.
bool read_moves(Cursor& cursor, std::vector<std::uint8_t>& moves) {
  const std::size_t count = moves.size();
  if (count <= kMaskedCorners) {
    std::uint64_t mask = 0;
    for (std::size_t i = 0; i < count; i += 8) {
      std::uint8_t byte = 0;
      if (!cursor.read(byte)) return false;
      mask |= static_cast<std::uint64_t>(byte) << i;
    }
    for (std::size_t i = 0; i < count; ++i) moves[i] = mask >> i & 1;
    return mask >> count == 0;
  }
  std::uint8_t kind = 0;
  for (std::size_t done = 0; done < count; kind ^= 1) {
    std::uint64_t run = 0;
    if (!read_number(cursor, count - done + 1, run) || (run == 0 && done > 0)) return false;
    for (; run > 0; --run) moves[done++] = kind;
  }
  return true;
}

/// The corner of the triangle of `corner` that is `step` corners on.
std::uint32_t turned(std::uint32_t corner, std::uint32_t step) {
  return corner - corner % 3 + (corner % 3 + step) % 3;
}

/// An apex by its first place among the neighbours of the vertex to be split: two a corner, in the
/// order of the star. `near` is what the number of the returning triangle is near to.
struct NamedApex {
  std::uint64_t place = 0;
  std::uint32_t near = 0;
};

/// `apex` is a neighbour of `into`: a removal that leaves the surface what it is cuts no edge off.
NamedApex name_of(const GrowingMesh& mesh, std::uint32_t into, std::uint32_t apex) {
  NamedApex named;
  for (const std::uint32_t corner : mesh.stars.corners_at(into)) {
    named.near = mesh.triangle_indices[corner / 3];
    if (mesh.stars.vertex_at(turned(corner, 1)) == apex) break;
    ++named.place;
    if (mesh.stars.vertex_at(turned(corner, 2)) == apex) break;
    ++named.place;
  }
  return named;
}

/// The apex at `named.place`, and sets `named.near`.
std::uint32_t apex_of(const GrowingMesh& mesh, std::uint32_t into, NamedApex& named) {
  auto corner = mesh.stars.corners_at(into).begin();
  for (std::uint64_t i = 0; i < named.place / 2; ++i) ++corner;
  named.near = mesh.triangle_indices[*corner / 3];
  return mesh.stars.vertex_at(turned(*corner, 1 + static_cast<std::uint32_t>(named.place % 2)));
}

constexpr unsigned kNoTriangle = 7;  ///< in place of the second one's order

const char* read_triangle(Cursor& cursor, const GrowingMesh& mesh,
                          const ProgressiveColumns& columns, const OriginalSize& original,
                          const VertexSplit& split, ReturningTriangle& back) {
  NamedApex apex;
  if (!read_number(cursor, 2 * split.moves.size(), apex.place)) return "no apex of a triangle";
  back.apex = apex_of(mesh, split.into, apex);
  if (back.apex == split.into) return "a triangle names a vertex twice";
  if (!read_near(cursor, apex.near, original.triangles, back.index))
    return "no number of a triangle";
  if (columns.triangle_origin()) {
    std::uint8_t origin = 0;
    if (!cursor.read(origin) || origin > static_cast<std::uint8_t>(Origin::invented))
      return "no origin of a triangle";
    back.origin = static_cast<Origin>(origin);
  }
  if (columns.triangle_owner() && !read_near(cursor, split.index, original.vertices, back.owner))
    return "no owner of a triangle";
  return nullptr;
}

}  // namespace

void put_split_head(std::string& bytes, const GrowingMesh& mesh, float error,
                    const VertexSplit& split) {
  put_number(bytes, split.into);
  put_number(bytes,
             std::bit_cast<std::uint32_t>(error) - std::bit_cast<std::uint32_t>(split.error));
  put_near(bytes, split.index, mesh.vertex_indices[split.into]);
}

void put_split_tail(std::string& bytes, const GrowingMesh& mesh, const ProgressiveColumns& columns,
                    const VertexSplit& split) {
  const unsigned second = split.returning_count == 2 ? split.returning[1].order : kNoTriangle;
  bytes += static_cast<char>(split.returning[0].order | second << 3);
  put_moves(bytes, split.moves);
  for (std::size_t i = 0; i < split.returning_count; ++i) {
    const ReturningTriangle& back = split.returning[i];
    const NamedApex apex = name_of(mesh, split.into, back.apex);
    put_number(bytes, apex.place);
    put_near(bytes, back.index, apex.near);
    if (columns.triangle_origin()) bytes += static_cast<char>(back.origin);
    if (columns.triangle_owner()) put_near(bytes, back.owner, split.index);
  }
}

const char* read_split(Cursor& cursor, const GrowingMesh& mesh, float error,
                       const ProgressiveColumns& columns, const OriginalSize& original,
                       VertexSplit& split, const std::byte*& row) {
  if (!read_number(cursor, mesh.stars.vertices(), split.into)) return "no vertex to split";
  const auto error_bits = std::bit_cast<std::uint32_t>(error);
  std::uint32_t fall = 0;
  if (!read_number(cursor, std::uint64_t{error_bits} + 1, fall)) return "no error";
  split.error = std::bit_cast<float>(error_bits - fall);
  if (!read_near(cursor, mesh.vertex_indices[split.into], original.vertices, split.index))
    return "no number of a vertex";
  row = cursor.take(columns.row_size());
  if (!row) return "no vertex";
  std::uint8_t orders = 0;
  if (!cursor.read(orders)) return "no triangles";
  const unsigned first = orders & 7;
  const unsigned second = orders >> 3;
  if (first >= kCornerOrders.size() || (second >= kCornerOrders.size() && second != kNoTriangle))
    return "no order of corners";
  split.moves.clear();
  for ([[maybe_unused]] const std::uint32_t corner : mesh.stars.corners_at(split.into))
    split.moves.push_back(0);
  if (!read_moves(cursor, split.moves)) return "no choice of corners";
  split.returning_count = second == kNoTriangle ? 1 : 2;
  split.returning[0].order = static_cast<std::uint8_t>(first);
  split.returning[1].order = static_cast<std::uint8_t>(second);
  for (std::size_t i = 0; i < split.returning_count; ++i) {
    const char* wrong = read_triangle(cursor, mesh, columns, original, split, split.returning[i]);
    if (wrong) return wrong;
  }
  return nullptr;
}

}  // namespace burnish
