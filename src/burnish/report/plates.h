#pragma once

#include <optional>
#include <string>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/result.h"
#include "burnish/pipeline/record.h"
#include "burnish/report/image.h"

namespace burnish {

struct ReportOptions {
  std::uint32_t picture_width = 640, picture_height = 480;  ///< pixels
  int pictured_phases = 4;    ///< at most so many phases are pictured: first, last and some between
  std::optional<Vec3d> up{};  ///< in the world; none: the axis nearest to the camera's up, or z
};

/// The scale of a painted number.
struct ColorScale {
  std::string title;  ///< "Distance to the true surface"
  double low = 0, high = 1;
  std::string unit;  ///< SI
};

/// A value of the scale as it stands beside it: "0", "1.2 mm".
std::string limit_text(const ColorScale& scale, double value);

/// All pictured phases from one view.
struct Plate {
  std::string name;                 ///< "three-quarter"
  std::string caption;              ///< what more there is to say of it, possibly nothing
  std::optional<ColorScale> scale;  ///< where a number is painted
  std::vector<Image>
      pictures;  ///< one per pictured phase; without pixels where it lacks the number
};

struct Plates {
  std::vector<std::size_t> phases;  ///< which phases of the record are pictured
  std::vector<Plate> plates;
};

/// Pictures of the record's phases: front, three-quarter, top (or, where the first camera stood
/// within the surface, from that camera and from beside and above it), a close-up with edges, and
/// sigma and deviation where a phase has them. All phases are seen from the same places, which
/// frame the last one. Errors: invalid_argument, bad_geometry with the phase's name, cancelled.
Result<Plates> paint_plates(const Record& record, const ReportOptions& options = {},
                            const Context& context = {});

/// All plates in one picture, a row per view, a column per phase, with names at the edges.
Image contact_sheet(const Record& record, const Plates& plates);

}  // namespace burnish
