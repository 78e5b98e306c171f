#pragma once

#include <functional>

#include "burnish/io/cursor.h"
#include "burnish/pipeline/grown_mesh.h"
#include "burnish/pipeline/progressive_file.h"

namespace burnish {

/// What a progressive file begins with, the coarse mesh included.
struct ProgressiveHead {
  ProgressiveFileReport file;  ///< as far as it claims; `bytes` is 0
  Frame frame;
  GrownMesh coarse;  ///< with room for the level that is wanted
};

/// Reads all but the check at its end. `keep_going` is asked now and then. Errors: bad_file,
/// unsupported, cancelled. Memory in proportion to the bytes that are there, whatever is claimed.
Result<ProgressiveHead> read_progressive_head(Cursor& cursor, const ProgressiveStop& stop,
                                              const std::function<bool()>& keep_going);

}  // namespace burnish
