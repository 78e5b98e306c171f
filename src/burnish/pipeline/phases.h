#pragma once

#include <optional>

#include "burnish/catalogue/operations.h"
#include "burnish/pipeline/record.h"
#include "burnish/pipeline/region.h"
#include "burnish/smoothing/noise_bound.h"

namespace burnish {

/// The steps of a run. Each runs methods of one family, and adds to the record what was done, with
/// every parameter as it was used, what came of it and how long it took.

Result<DepthFrame> average_frames(std::span<const DepthFrame> frames, const Method& method,
                                  Record& record, const Context& context);

Result<void> filter_frame(DepthFrame& frame, const std::vector<Method>& methods, Record& record,
                          const Context& context);

Result<void> clean_cloud(PointCloud& cloud, const std::vector<Method>& methods, Record& record,
                         const Context& context);

Result<PointCloud> merge_clouds(std::span<const PointCloud> clouds, const Method& method,
                                Record& record, const Context& context);

Result<void> thin_cloud(PointCloud& cloud, const std::vector<Method>& methods, Record& record,
                        const Context& context);

/// A mesh without a triangle is an error (bad_geometry).
Result<TriangleMesh> triangulate_cloud(const PointCloud& cloud, const Method& method,
                                       Record& record, const Context& context);

Result<void> repair_mesh(TriangleMesh& mesh, const std::vector<Method>& methods, Record& record,
                         const Context& context);

/// With `keep_phases` the record gets the mesh after each method, as the next phase, and where it
/// has none yet first as it is now ("original"). So with those below.
Result<void> repair_in_phases(TriangleMesh& mesh, const std::vector<Method>& methods,
                              bool keep_phases, Record& record, const Context& context);
Result<void> simplify_in_phases(TriangleMesh& mesh, const std::vector<Method>& methods,
                                bool keep_phases, Record& record, const Context& context);

/// What holds a smoothing back.
struct SmoothingLimits {
  std::optional<Region> region;           ///< world coordinates; only what lies inside moves
  std::optional<NoiseBoundParams> bound;  ///< no vertex leaves the region of its measurement
};

/// Moves the vertices alone that lie in the region before the first phase, where one is given; a
/// channel smoothing_weight that the mesh brings counts besides. With a bound no vertex leaves the
/// region in which the mesh as it is now says that it can be: it is put back after each method, and
/// the record gets the certificate, which a computation of its own makes. With `keep_phases` the
/// record gets the mesh as it is now ("original") and after each method ("phase 1", ...). Errors:
/// also bad_geometry where a bound is wanted and the mesh knows of no noise, before anything is
/// smoothed; refuted where the certificate does not hold.
Result<void> smooth_in_phases(TriangleMesh& mesh, const std::vector<Method>& methods,
                              const SmoothingLimits& limits, bool keep_phases, Record& record,
                              const Context& context);

/// Makes triangles smaller, around a region (world coordinates) alone where one is given: each
/// method refines every triangle that has a point in it, as far as a channel refinement that the
/// mesh brings allows, and fits those around. With `keep_phases` as smooth_in_phases.
Result<void> refine_in_phases(TriangleMesh& mesh, const std::vector<Method>& methods,
                              const std::optional<Region>& region, bool keep_phases, Record& record,
                              const Context& context);

/// A record with its title, the command line and the versions filled in.
Record new_record(std::string title, std::string command, std::vector<std::string> inputs);

}  // namespace burnish
