#pragma once

#include "burnish/pipeline/recipe.h"
#include "burnish/pipeline/record.h"
#include "burnish/pipeline/scans.h"

namespace burnish {

/// What to do besides the recipe.
struct ReconstructOptions {
  std::optional<std::filesystem::path> truth;  ///< a mesh to compare points and phases with
  bool keep_phases = false;                    ///< keep the mesh of every phase in the record
};

/// A mesh from scans, and the record of how it came about.
struct Reconstruction {
  TriangleMesh mesh;
  Record record;
};

/// The whole pipeline: reads the scans, cleans each, merges them, triangulates, repairs,
/// smooths and simplifies. `record` is continued (title, command and inputs are the caller's).
Result<Reconstruction> reconstruct(const ScanInputs& inputs, const Recipe& recipe,
                                   const ReconstructOptions& options, Record record,
                                   const Context& context = {});

}  // namespace burnish
