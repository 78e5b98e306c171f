#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "burnish/base/context.h"

namespace burnish {

/// Several passes over the same chunks, one pass not waiting for the end of the one before: a wave
/// that goes through the chunks once while they are in the processor's caches. Calls
/// `body(pass, chunk)` once for every pass below `passes` and every chunk; pass p + 1 comes to
/// chunk c when pass p is through with all chunks before needs[c]. needs[c] > c, and never falls.
/// What `body` reads in chunk c of other chunks must be within those, and what it overwrites must
/// be read by none but them in the pass before; then two buffers that change roles are enough, and
/// the result is that of one pass after the other, for any number of threads.
///
/// Progress, cancellation and exceptions as for parallel_for.
[[nodiscard]] bool parallel_passes(
    const Context& context, std::size_t passes, std::span<const std::uint32_t> needs,
    const std::function<void(std::size_t pass, std::size_t chunk)>& body);

}  // namespace burnish
