#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/rigid.h"
#include "burnish/registration/fpfh.h"

namespace burnish {

/// Points of two clouds that may be the same.
struct Correspondence {
  std::uint32_t source, target;
};

/// Each is the other's nearest in the space of the histograms. Only points take part whose
/// histogram is farther from the mean of its cloud than most: on a wall all are alike (Rusu et al.
/// 2009, section III.C). O(#source #target). None where cancelled.
std::optional<std::vector<Correspondence>> mutual_matches(const std::vector<Fpfh>& source,
                                                          const std::vector<Fpfh>& target,
                                                          const Context& context);

/// A pose and what speaks for it.
struct Hypothesis {
  RigidTransform T_target_source;
  double score = 0;
};

/// Poses on which correspondences agree, the best first, each unlike those before it: random sample
/// consensus (Fischler and Bolles 1981) over `draws` triples, of which those count whose sides are
/// alike within `tolerance`. The score is the number of correspondences that a pose brings within
/// `tolerance` and to like normals. The same for any number of threads. None where cancelled.
std::optional<std::vector<Hypothesis>> consensus(const OrientedPoints& source,
                                                 const OrientedPoints& target,
                                                 const std::vector<Correspondence>& matches,
                                                 double tolerance, std::size_t draws,
                                                 std::size_t wanted, const Context& context);

/// Whether two poses put points near `middle` of the source within `tolerance` of each other and
/// turn them alike within 10 degrees.
bool alike(const RigidTransform& a, const RigidTransform& b, const Vec3d& middle, double tolerance);

}  // namespace burnish
