#pragma once

#include "burnish/io/file.h"
#include "burnish/sensor/recording_format.h"

namespace burnish {

/// Opens an ONI, OpenNI's recording (versions 1 and 2): records NIR of nodes, of their properties
/// and of their images. Taken are the first depth node (as it is, 16zP or 16zT), its size, field of
/// view, unit and mirroring, and the first image node where it is JPEG or three bytes a pixel.
/// Mirrored depth is turned back. `bytes` must outlive the recording, `owner` may hold them.
///
/// Looks at the heads of all records. Errors: bad_file, unsupported for other codecs and units.
Result<std::unique_ptr<Recording>> open_oni(std::string_view bytes, const std::string& name,
                                            const ImportParams& params, FileBytes owner = {});

}  // namespace burnish
