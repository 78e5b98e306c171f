#include "burnish/report/histogram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "burnish/report/numbers.h"

namespace burnish {
namespace {

constexpr double kWidth = 640, kHeight = 260, kLeft = 46, kRight = 12, kTop = 16, kBottom = 40;

/// From values to places in the picture.
struct Plot {
  Axis axis;
  double highest;  ///< share at the top

  double x(double value) const {
    return kLeft + (value - axis.low) / (axis.high - axis.low) * (kWidth - kLeft - kRight);
  }
  double y(double share) const {
    return kHeight - kBottom - share / highest * (kHeight - kTop - kBottom);
  }
};

/// The outline of the bars as a path, from the axis and back to it.
std::string outline(const Plot& plot, const std::vector<double>& heights) {
  std::string path = fmt::format("M{:.1f} {:.1f}", plot.x(plot.axis.low), plot.y(0));
  const double step = (plot.axis.high - plot.axis.low) / static_cast<double>(heights.size());
  for (std::size_t i = 0; i < heights.size(); ++i) {
    path += fmt::format("V{:.1f}H{:.1f}", plot.y(heights[i]),
                        plot.x(plot.axis.low + step * static_cast<double>(i + 1)));
  }
  return path + fmt::format("V{:.1f}", plot.y(0));
}

void write_line(HtmlWriter& html, double x1, double y1, double x2, double y2,
                std::string_view style) {
  const std::string d = fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", x1, y1, x2, y2);
  html.open("path", {{"class", style}, {"d", d}}).close();
}

void write_label(HtmlWriter& html, double x, double y, std::string_view text,
                 std::string_view anchor) {
  html.element(
      "text", text,
      {{"x", fmt::format("{:.1f}", x)}, {"y", fmt::format("{:.1f}", y)}, {"text-anchor", anchor}});
}

void write_axes(HtmlWriter& html, const Plot& plot) {
  const double step = nice_step(plot.axis.high - plot.axis.low, 9);
  for (double i = std::ceil(plot.axis.low / step); i * step <= plot.axis.high * (1 + 1e-9); ++i) {
    write_line(html, plot.x(i * step), plot.y(0), plot.x(i * step), plot.y(0) + 4, "axis");
    write_label(html, plot.x(i * step), plot.y(0) + 17, number_text(i * step), "middle");
  }
  const double rise = nice_step(plot.highest, 4);
  for (double i = 0; i * rise <= plot.highest * (1 + 1e-9); ++i) {
    write_line(html, kLeft, plot.y(i * rise), kWidth - kRight, plot.y(i * rise),
               i == 0 ? "axis" : "grid");
    write_label(html, kLeft - 6, plot.y(i * rise) + 4, number_text(100 * i * rise) + " %", "end");
  }
  write_label(html, kWidth - kRight, kHeight - 6, plot.axis.unit, "end");
}

void write_legend(HtmlWriter& html, const std::vector<Series>& series) {
  html.open("p", {{"class", "legend"}});
  for (std::size_t i = 0; i < series.size(); ++i) {
    html.open("span", {{"class", "key " + series_class(i, series.size())}}).close();
    html.element("span", series[i].name);
  }
  html.close();
}

}  // namespace

std::vector<double> shares(std::span<const float> values, const Axis& axis) {
  std::vector<double> result(static_cast<std::size_t>(axis.bins));
  if (values.empty()) return result;
  for (const float value : values) {
    const double place =
        std::floor((value * axis.factor - axis.low) / (axis.high - axis.low) * axis.bins);
    if (place >= 0 && place < axis.bins) ++result[static_cast<std::size_t>(place)];
  }
  for (double& share : result) share /= static_cast<double>(values.size());
  return result;
}

double nice_step(double extent, int steps) {
  if (!(extent > 0)) return 1;
  const double least = extent / steps;
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= least * (1 - 1e-9)) return digit * power;
  }
  return 10 * power;
}

std::string series_class(std::size_t i, std::size_t count) {
  constexpr std::size_t kLast = 5;
  if (i == 0) return "s0";
  return fmt::format("s{}", i + 1 == count ? kLast : 1 + (i - 1) % (kLast - 1));
}

void write_histogram(HtmlWriter& html, std::string_view id, const Axis& axis,
                     const std::vector<Series>& series) {
  std::vector<std::vector<double>> heights;
  double highest = 0;
  for (const Series& one : series) {
    heights.push_back(shares(one.values, axis));
    for (const double share : heights.back()) highest = std::max(highest, share);
  }
  const Plot plot{axis, highest > 0 ? highest * 1.06 : 1};
  const std::string label = fmt::format("{}-title", id);
  html.open("figure", {{"class", "chart"}});
  html.element("figcaption", axis.title, {{"id", label}});
  html.open("svg", {{"viewBox", fmt::format("0 0 {} {}", kWidth, kHeight)},
                    {"role", "img"},
                    {"aria-labelledby", label}});
  write_axes(html, plot);
  for (std::size_t i = 0; i < series.size(); ++i) {
    html.open("path", {{"class", "curve " + series_class(i, series.size())},
                       {"d", outline(plot, heights[i])}})
        .close();
  }
  if (axis.mark > axis.low && axis.mark < axis.high) {
    write_line(html, plot.x(axis.mark), kTop, plot.x(axis.mark), plot.y(0), "mark");
    write_label(html, plot.x(axis.mark) + 5, kTop + 10, axis.mark_label, "start");
  }
  html.close();
  write_legend(html, series);
  html.close();
}

}  // namespace burnish
