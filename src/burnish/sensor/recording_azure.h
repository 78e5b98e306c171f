#pragma once

#include "burnish/io/file.h"
#include "burnish/sensor/recording_format.h"

namespace burnish {

/// Opens what Azure Kinect's k4arecorder writes: a Matroska with a track DEPTH of 16-bit big-endian
/// millimetres (FOURCC b16g), where wanted a track COLOR, of which Motion JPEG is taken, and the
/// attachment calibration.json. Where that is there, the images are freed of the lens's distortion.
/// `bytes` must outlive the recording, `owner` may hold them. Errors: bad_file, unsupported.
Result<std::unique_ptr<Recording>> open_azure(std::string_view bytes, const std::string& name,
                                              const ImportParams& params, FileBytes owner = {});

}  // namespace burnish
