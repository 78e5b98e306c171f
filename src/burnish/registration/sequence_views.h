#pragma once

#include "burnish/base/schema.h"
#include "burnish/registration/projective.h"
#include "burnish/registration/view_poses.h"

namespace burnish {

struct SequenceViewsParams {
  double key_overlap = 0.75;  ///< a view that shares less with its key view becomes one itself
  int recalled = 8;           ///< key views that one which fits nowhere is tried on
  double max_deviation = 4;   ///< a pair farther from what the others say is left out
  ProjectiveParams pairs;

  static const Schema<SequenceViewsParams>& schema();
};

/// The poses of views of one scene that a camera took one after the other while it was carried
/// along. The world is the first view's camera.
///
/// Every view is laid on the key view before it, from where the last two say that it should be,
/// then from where the last was; where that is refused, on the last view, then on the key views
/// that were taken last, up to `recalled`. Accepted with less than `key_overlap` it is the next key
/// view. What fits nowhere begins a piece of its own, which later pairs may join. Then key views
/// that the poses say share half of what they see, and that have not been laid on each other, are:
/// that closes loops. The poses that fit all pairs best are the result (fit_poses). The same bytes
/// for any number of threads. Views are read one after the other; about `recalled` + 4 are held.
/// Errors: invalid_argument, cancelled, those of reading a view.
Result<ViewPoses> register_sequence(const ViewSource& views, const SequenceViewsParams& params = {},
                                    const Context& context = {});

}  // namespace burnish
