#pragma once

#include "burnish/io/file.h"
#include "burnish/sensor/recording_format.h"

namespace burnish {

/// Opens a KLG, the log of Kintinuous and ElasticFusion (Whelan et al.): a count of frames, int32;
/// then per frame a timestamp in microseconds, int64, the bytes of depth and of colour, int32 each,
/// and these bytes. Depth is 16 bits a pixel in mm, as it is or as a zlib stream; colour is
/// nothing, JPEG, or three bytes a pixel. All little endian. The sizes of images are not in it:
/// they are known from the count of pixels. `bytes` must outlive the recording, `owner` may hold
/// them.
///
/// Looks at all frames' heads, so that counts that are wrong are refused here. Errors: bad_file,
/// unsupported for a count of pixels that no camera has.
Result<std::unique_ptr<Recording>> open_klg(std::string_view bytes, const std::string& name,
                                            FileBytes owner = {});

}  // namespace burnish
