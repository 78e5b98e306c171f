#include <fmt/format.h>

#include "../verb.h"
#include "burnish/pipeline/figure6.h"

namespace burnish::app {
namespace {

std::string numbers_text(const std::vector<double>& numbers) {
  return fmt::format("{:.9g}", fmt::join(numbers, " "));
}

void print(const Figure6& figure) {
  int phase = -1;
  for (const Figure6Row& row : figure.rows) {
    if (row.phase != phase) {
      phase = row.phase;
      fmt::print("\n{}\n{:<12} {:<42} {:<42} {:>10}\n",
                 phase == 0 ? "Original" : fmt::format("Phase {}", phase), "", "printed",
                 "computed", "difference");
    }
    fmt::print("{:<12} {:<42} {:<42} {:>10.2g}{}{}\n", row.quantity, numbers_text(row.printed),
               numbers_text(row.computed), row.difference(), row.agrees() ? "" : "  DIFFERS",
               row.remark.empty() ? "" : "  " + row.remark);
  }
  fmt::print("\nLargest difference: coordinates {:.2g}, distances and their means {:.2g}.\n\n{}\n",
             figure.largest_difference("P"), figure.largest_difference("d"), figure6_explanation());
}

Result<void> reproduce(const std::string& what) {
  if (what != "figure6") {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("'{}' cannot be reproduced, known: figure6", what),
                 {}};
  }
  const Figure6 figure = reproduce_figure6();
  print(figure);
  if (figure.agrees()) return {};
  return Error{ErrorCode::bad_geometry, "the figures differ from the paper's", {}};
}

}  // namespace

Action add_reproduce(CLI::App& app) {
  auto* verb = app.add_subcommand(
      "reproduce", "Compute a table of Ozbay and Cinar's paper anew, beside the printed one.");
  auto what = std::make_shared<std::string>();
  verb->add_option("WHAT", *what,
                   "figure6: the teapot's coordinates and distances, original and two phases")
      ->required();
  verb->footer("Example:\n  burnish reproduce figure6");
  return [what](const Session&, const Context&) { return reproduce(*what); };
}

}  // namespace burnish::app
