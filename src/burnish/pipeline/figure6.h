#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace burnish {

/// One line of Figure 6's table: what Ozbay and Cinar print and what comes out here.
struct Figure6Row {
  std::string quantity;         ///< "P3", "d3", "d_avg", "|d_avg - d3|"
  int phase = 0;                ///< 0: original, 1 and 2: after so many passes
  std::vector<double> printed;  ///< three coordinates, or one number
  std::vector<double> computed;
  double tolerance = 0;  ///< within which they are to agree
  std::string remark;    ///< possibly empty

  /// The largest difference of a number.
  double difference() const;
  bool agrees() const { return difference() <= tolerance; }
};

struct Figure6 {
  std::vector<Figure6Row> rows;  ///< phase by phase: points, distances, their mean, deviations

  bool agrees() const;
  /// The largest difference among rows whose quantity begins with `prefix`: "P", "d", "|".
  double largest_difference(std::string_view prefix) const;
};

/// Makes the paper's teapot, smooths it once and twice and compares the ring of P0 with every
/// coordinate (21 triples, within 2e-6), distance (18, within 1e-6), mean and deviation (within
/// 2e-6) that Figure 6 prints. The model's coordinates are rounded to six significant digits, as
/// the paper's were.
Figure6 reproduce_figure6();

/// What the printed table really is, in one paragraph.
std::string_view figure6_explanation();

}  // namespace burnish
