#pragma once

#include <functional>
#include <string>
#include <vector>

#include "burnish/io/file_format.h"
#include "burnish/io/output.h"
#include "burnish/io/vertex_columns.h"

namespace burnish {

/// How PLY and PCD name normals, and whether colours are four numbers or one packed as 0xAARRGGBB.
enum class FieldNames { ply, pcd };

/// The counterpart of VertexColumns: positions and attributes as rows of named numbers, packed and
/// little endian. Refers to `view`, which must outlive it.
class VertexRows {
 public:
  VertexRows(const GeometryView& view, FieldNames names);

  const std::vector<Field>& fields() const { return fields_; }
  std::size_t row_bytes() const { return row_bytes_; }

  /// Why the fields cannot be written: a channel's name with a blank in it, or one that is taken.
  Result<void> check() const;

  /// All rows, as bytes or as lines of text.
  void write(Output& out, bool ascii) const;

 private:
  /// Writes the values of rows [first, first + rows) of some fields, the first one at `out`.
  using Packer = std::function<void(std::size_t first, std::size_t rows, char* out)>;

  template <class T>
  void add(std::initializer_list<std::string_view> names, Packer packer);
  template <class T, class Values>
  void add_values(std::string_view name, const Values& values);
  void add_positions();
  void add_colors(FieldNames names);
  void print(Output& out, const char* row) const;

  const GeometryView& view_;
  std::vector<Field> fields_;
  std::vector<Packer> packers_;
  std::size_t row_bytes_ = 0;
};

}  // namespace burnish
