#pragma once

#include <string>

#include "burnish/io/cursor.h"
#include "burnish/pipeline/growing_mesh.h"
#include "burnish/pipeline/progressive_columns.h"

// One vertex split as bytes (docs/progressive-file.md), without the check at its end. What it means
// depends on the mesh that is to be split: vertices and corners are named by their places in it.
namespace burnish {

/// The numbers of vertices and triangles in the original mesh.
struct OriginalSize {
  std::uint64_t vertices = 0, triangles = 0;
};

/// Appends what comes before the row of the new vertex, and what comes behind it. `error` is that
/// of `mesh` as it is, at least that of the split.
void put_split_head(std::string& bytes, const GrowingMesh& mesh, float error,
                    const VertexSplit& split);
void put_split_tail(std::string& bytes, const GrowingMesh& mesh, const ProgressiveColumns& columns,
                    const VertexSplit& split);

/// Reads a whole split; `row` is where the attributes of its vertex lie. Null, or what is wrong
/// with it: a split that was read can be made.
const char* read_split(Cursor& cursor, const GrowingMesh& mesh, float error,
                       const ProgressiveColumns& columns, const OriginalSize& original,
                       VertexSplit& split, const std::byte*& row);

}  // namespace burnish
