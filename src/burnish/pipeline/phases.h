#pragma once

#include "burnish/catalogue/operations.h"
#include "burnish/pipeline/record.h"
#include "burnish/pipeline/region.h"

namespace burnish {

/// The steps of a run. Each runs methods of one family, and adds to the record what was done, with
/// every parameter as it was used, what came of it and how long it took.

Result<void> clean_cloud(PointCloud& cloud, const std::vector<Method>& methods, Record& record,
                         const Context& context);

Result<PointCloud> merge_clouds(std::span<const PointCloud> clouds, const Method& method,
                                Record& record, const Context& context);

/// A mesh without a triangle is an error (bad_geometry).
Result<TriangleMesh> triangulate_cloud(const PointCloud& cloud, const Method& method,
                                       Record& record, const Context& context);

Result<void> repair_mesh(TriangleMesh& mesh, const std::vector<Method>& methods, Record& record,
                         const Context& context);

/// Moves the vertices alone that lie in `region` (world coordinates) before the first phase, where
/// one is given; a channel smoothing_weight that the mesh brings counts besides. With `keep_phases`
/// the record gets the mesh as it is now ("original") and after each method ("phase 1", ...).
Result<void> smooth_in_phases(TriangleMesh& mesh, const std::vector<Method>& methods,
                              const std::optional<Region>& region, bool keep_phases, Record& record,
                              const Context& context);

/// A record with its title, the command line and the versions filled in.
Record new_record(std::string title, std::string command, std::vector<std::string> inputs);

}  // namespace burnish
