#pragma once

#include "burnish/base/context.h"
#include "burnish/registration/pair.h"
#include "burnish/registration/surface_view.h"

namespace burnish {

struct ProjectiveParams {
  double reach = 0.3;       ///< m; how far off the guess may put the surfaces
  int step = 2;             ///< every so-many-th row and column counts on the finest level
  int levels = 3;           ///< each coarser one takes every second of them
  int max_iterations = 30;  ///< on each level
  AcceptanceParams acceptance{};

  static const Schema<ProjectiveParams>& schema();
};

/// Where the camera of `source` stood in the coordinates of that of `target`, from a guess.
///
/// Iterated closest points with projective association (Blais and Levine 1995; Newcombe et al.
/// 2011, section 3.5): a point x of the source, brought to the target, has the pixel as counterpart
/// that it is seen in, where the normals agree within 60 degrees. What is made small is
///   sum rho(r / s),  r = n . (x - q),  s^2 = sigma_x^2 + sigma_q^2 + bias_x^2 + bias_q^2 + t^2,
/// with q and n of the target (Chen and Medioni 1991) and Tukey's biweight of c = 4.685 for rho
/// (Beaton and Tukey 1974; 95 % efficient on normal errors, Holland and Welsch 1977), by
/// Gauss-Newton on SE(3). It goes from few pixels to many, while t falls from reach / c by a factor
/// of three from level to level to 0 on the finest (graduated non-convexity, Blake and Zisserman
/// 1987).
///
/// What comes of it is judged, see pair.h: by the source in the target and the target in the
/// source. The same bytes for any number of threads. O(#pixels), about twice through all of them.
/// Errors: invalid_argument, bad_geometry, cancelled. That the two do not fit is no error but a
/// refusal.
Result<PairRegistration> register_projective(const SurfaceView& source, const SurfaceView& target,
                                             const RigidTransform& T_target_source_guess = {},
                                             const ProjectiveParams& params = {},
                                             const Context& context = {});

/// Judges a pose that is there, without a step.
Result<PairRegistration> assess_projective(const SurfaceView& source, const SurfaceView& target,
                                           const RigidTransform& T_target_source,
                                           const AcceptanceParams& acceptance = {},
                                           const Context& context = {});

}  // namespace burnish
