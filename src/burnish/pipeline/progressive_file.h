#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "burnish/adaptation/removal.h"
#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"

// A mesh at every level of detail in one file: a coarse mesh, then one record for every vertex that
// was removed from the original, the last one first. docs/progressive-file.md has every byte.
namespace burnish {

struct ProgressiveFileReport {
  std::uint64_t vertices = 0, triangles = 0;  ///< of the original
  std::uint64_t coarse_vertices = 0, coarse_triangles = 0;
  float coarse_error = 0;       ///< m
  std::uint64_t bytes = 0;      ///< of the file
  std::uint64_t ply_bytes = 0;  ///< of the original's vertices and triangles in a binary PLY

  Facts facts() const;
};

/// Writes `mesh` with the removals that make it coarse, the first one first; whole or not at all
/// (AtomicWriter). Errors: bad_geometry; invalid_argument with the first removal that would not
/// leave the surface what it is (RemovalReplay) or whose error falls; unsupported beyond 2^32
/// corners; not_found, io_failure; cancelled. O(sum of the valences); about 100 bytes a triangle.
Result<ProgressiveFileReport> write_progressive(const std::filesystem::path& path,
                                                const TriangleMesh& mesh,
                                                std::span<const Removal> removals,
                                                const Context& context = {});

/// How far to read: to the original, or to the first of these. A file whose coarse mesh is beyond
/// already gives that.
struct ProgressiveStop {
  std::optional<std::uint64_t> triangles;  ///< the finest level of at most so many
  std::optional<double> error;  ///< the coarsest level that is this near to the original, m
};

/// A level of a progressive file: vertices and triangles of the original in its order. Corners of
/// triangles lie where they lie in the original, or at the vertex that theirs was removed into.
struct ProgressiveLevel {
  TriangleMesh mesh;
  float error = 0;               ///< how far the surface may be from the original, m
  std::uint64_t records = 0;     ///< that were read
  std::uint64_t bytes_read = 0;  ///< of the file, from its beginning
  ProgressiveFileReport file;    ///< what the file claims
  bool original = false;         ///< whether it is the original, to the last bit
  std::vector<std::string> notes;
};

/// Reads up to a level, and of the file no byte beyond it: time in proportion to the level's
/// triangles (the sum of the valences, and a sort), memory 40 bytes a triangle besides the level.
///
/// A file that ends behind a record is one of a coarser mesh, with a note. One that ends anywhere
/// else, or in which a byte that was read has changed, is refused: bad_file with the byte and the
/// record, and how much can be had of it. Errors besides: not_found, unsupported (another version),
/// io_failure, out_of_memory, cancelled.
///
/// The owners of triangles (TriangleAttributes::owner) come with the original only: a coarser level
/// need not have the vertices.
Result<ProgressiveLevel> read_progressive(const std::filesystem::path& path,
                                          const ProgressiveStop& stop = {},
                                          const Context& context = {});

/// The same of bytes in memory; errors name them `name`.
Result<ProgressiveLevel> parse_progressive(std::string_view bytes, const std::string& name,
                                           const ProgressiveStop& stop = {},
                                           const Context& context = {});

/// The finest level of a file and the removals that make it coarse, the first one first: what an
/// adaptive mesh is made from.
struct ProgressiveContent {
  ProgressiveLevel level;
  std::vector<Removal> removals;  ///< of the level's vertices
};
Result<ProgressiveContent> read_progressive_all(const std::filesystem::path& path,
                                                const Context& context = {});

}  // namespace burnish
