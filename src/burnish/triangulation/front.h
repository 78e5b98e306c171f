#pragma once

#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/triangulation/local_fans.h"
#include "burnish/triangulation/manifold_surface.h"
#include "burnish/triangulation/vote.h"

namespace burnish {

/// Grows surfaces from seeds across their boundary edges, after the global triangulation of Linsen
/// and Prautzsch 2001 as far as abstracts tell of it; the order is our own. Across an active edge
/// the fans of its two ends each propose the triangle that they hold there; of all proposals that
/// wait the one on which most fans agree comes first, then the best shaped, then the one of the
/// smallest indices, and it is added where the surface stays an oriented manifold without folds.
/// Where nothing waits, the best triangle that three fans agree on and whose corners are all unused
/// is the next seed. `candidates` are those of count_votes(). Returns false where cancelled.
/// O(#P log #P).
[[nodiscard]] bool grow_front(std::span<const Candidate> candidates, const Fans& fans,
                              const TriangleJudge& judge, const Context& context,
                              ManifoldSurface& surface);

}  // namespace burnish
