#pragma once

#include <span>
#include <string>
#include <vector>

#include "burnish/report/html.h"

namespace burnish {

/// One curve of a histogram.
struct Series {
  std::string name;
  std::span<const float> values;
};

/// What is shown along the axis.
struct Axis {
  std::string title;  ///< "Angles of the triangles"
  std::string unit;   ///< "mm"
  double factor = 1;  ///< from the unit of the values to the unit of the axis
  double low = 0, high = 1;
  int bins = 60;
  double mark = 0;  ///< a thin line with a label here; not within the axis: none
  std::string mark_label{};
};

/// The share of `values` in each of the axis' bins; those outside count in the whole but in no bin.
std::vector<double> shares(std::span<const float> values, const Axis& axis);

/// 1, 2 or 5 times a power of ten, so that `extent` has at most `steps` of them.
double nice_step(double extent, int steps);

/// All series over one axis as inline SVG: the first filled, the others as outlines, the last one
/// the strongest; with a legend. `id` is unique on the page.
void write_histogram(HtmlWriter& html, std::string_view id, const Axis& axis,
                     const std::vector<Series>& series);

/// The style class of series `i` of `count`: "s0" for the first, "s5" for the last.
std::string series_class(std::size_t i, std::size_t count);

}  // namespace burnish
