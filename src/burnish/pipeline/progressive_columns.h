#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "burnish/core/triangle_mesh.h"
#include "burnish/io/cursor.h"

namespace burnish {

/// Which attributes a progressive file holds, and the vertices that were read from it: one row of
/// bytes per vertex, the position and then its attributes in a fixed order, no byte between them.
class ProgressiveColumns {
 public:
  ProgressiveColumns() = default;
  /// Those of `mesh`, without a vertex.
  explicit ProgressiveColumns(const TriangleMesh& mesh);

  /// The list of attributes as the head of the file has it.
  void put_list(std::string& bytes) const;
  /// False where it cannot be one.
  bool read_list(Cursor& cursor);

  /// Of one vertex, bytes.
  std::size_t row_size() const { return row_size_; }
  bool triangle_origin() const { return triangle_origin_; }
  bool triangle_owner() const { return triangle_owner_; }

  void reserve(std::size_t vertices);
  /// The next vertex from row_size() bytes; false where its position is not finite or its origin is
  /// none. Then nothing more may be appended.
  bool append(const std::byte* row);

  /// Puts the vertices into this order; one attribute after the other, to need no memory for all of
  /// them twice.
  void reorder(std::span<const std::uint32_t> order);

  std::vector<Vec3f>& positions() { return positions_; }
  Attributes& attributes() { return attributes_; }

 private:
  void find_row_size();

  std::vector<Vec3f> positions_;
  Attributes attributes_;              ///< channels with their names and types from the beginning
  std::vector<std::uint8_t> present_;  ///< per attribute and channel, in the order of the row
  bool triangle_origin_ = false, triangle_owner_ = false;
  std::size_t row_size_ = 0;
};

/// values[order[0]], values[order[1]], ...; an empty array stays empty. Without the runs of
/// gather(): orders of a progressive file have none, and memory for them is what an extraction has
/// not.
template <class T>
std::vector<T> reordered(const std::vector<T>& values, std::span<const std::uint32_t> order) {
  std::vector<T> result;
  if (values.empty()) return result;
  result.reserve(order.size());
  for (const std::uint32_t i : order) result.push_back(values[i]);
  return result;
}

/// Appends the row of vertex `v`.
void put_row(std::string& bytes, const TriangleMesh& mesh, std::size_t v);

}  // namespace burnish
