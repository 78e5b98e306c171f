#pragma once

#include "burnish/base/schema.h"
#include "burnish/registration/projective.h"
#include "burnish/registration/view_poses.h"

namespace burnish {

struct TurntableViewsParams {
  double step = 0;           ///< of the table from view to view, rad; 0: a full turn / views
  bool closed = true;        ///< the first view follows the last
  double max_deviation = 4;  ///< a pair farther from what the others say is left out
  ProjectiveParams pairs = near_pairs();

  static const Schema<TurntableViewsParams>& schema();
  static ProjectiveParams near_pairs();
};

/// Where a turntable was and how it turned.
struct TurntableViews {
  /// The world's z is the table's axis, pointing to the top of the first image; its origin is the
  /// point of the axis that is nearest to the middle of what the first view saw.
  ViewPoses poses;
  std::vector<double> angles;  ///< of the table at every view, rad; of the first 0
  double axis_elevation = 0;   ///< how far the camera looks down on the table, rad

  Facts facts() const;
};

/// The poses of views of an object on a turntable before a camera that stands still. Nothing but
/// the object may be seen: crop the views, take the table's plane out.
///
/// The axis is looked for where it can be: behind the middle of the first view, tilted by 0 to 75
/// degrees, turning either way; of the trials that a pair of neighbours accepts
/// (register_projective) the one with most matched points is taken. Then every view is laid on the
/// next and on the next but one, from where the table says that they should be; and axis, camera
/// and the angle of every view are the unknowns of one problem over all accepted pairs, the circle
/// closed (fit_poses with TurntablePoses). The nominal step is a start, not a truth. The same bytes
/// for any number of threads. O(views * pixels). Holds at most 4 views at a time. Errors:
/// invalid_argument, cancelled, those of reading a view. No accepted pair is no error: no view has
/// a pose then, and `notes` say why.
Result<TurntableViews> register_turntable(const ViewSource& views,
                                          const TurntableViewsParams& params = {},
                                          const Context& context = {});

}  // namespace burnish
