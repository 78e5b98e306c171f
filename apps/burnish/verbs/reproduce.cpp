#include <fmt/format.h>

#include <cstdlib>

#include "../verb.h"
#include "burnish/pipeline/figure6.h"
#include "burnish/pipeline/table1.h"

namespace burnish::app {
namespace {

struct Options {
  std::string what, data;
  int rounds = 3;
};

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

Result<void> figure6() {
  const Figure6 figure = reproduce_figure6();
  print(figure);
  if (figure.agrees()) return {};
  return Error{ErrorCode::bad_geometry, "the figures differ from the paper's", {}};
}

std::string seconds_text(double seconds) {
  return seconds >= 1 ? fmt::format("{:.2f} s", seconds) : fmt::format("{:.1f} ms", seconds * 1e3);
}

std::string printed_text(const std::optional<Table1Printed>& printed) {
  if (!printed) return "";
  return fmt::format("    {:>8}{:>11}{:>6.0f} s", printed->points, printed->triangles,
                     printed->seconds);
}

void print(const Table1Part& part) {
  fmt::print("\n{}\n{}\n{:<18}{:>8}{:>9}{:>11}{:>11}{:>11}{:>12}{:>8}{:>14}    {}\n", part.method,
             "  " + part.how, "", "points", "unused", "triangles", "time", "smoothing",
             "components", "loops", "non-manifold", "  points  triangles    time, as printed");
  for (const Table1Row& row : part.rows) {
    const std::string smoothing = row.smoothing > 0 ? seconds_text(row.smoothing) : "";
    fmt::print("{:<18}{:>8}{:>9}{:>11}{:>11}{:>11}{:>12}{:>8}{:>14}{}\n", row.model, row.points,
               row.unused_points, row.triangles, seconds_text(row.seconds()), smoothing,
               row.shape.components, row.shape.boundary_loops, row.shape.non_manifold_edges,
               printed_text(row.printed));
  }
}

/// --data; or the folder that the tests use; or none.
std::optional<std::filesystem::path> data_folder(const std::string& given) {
  if (!given.empty()) return given;
  const char* folder = std::getenv("BURNISH_TEST_DATA");
  if (folder && *folder) return folder;
  return std::nullopt;
}

Result<void> table1(const Options& options, const Context& context) {
  const Result<Table1> table =
      reproduce_table1({.data = data_folder(options.data), .rounds = options.rounds}, context);
  if (!table) return table.error();
  fmt::print("Table 1, on {} thread{}, the shortest of {} round{}\n", table->threads,
             table->threads == 1 ? "" : "s", options.rounds, options.rounds == 1 ? "" : "s");
  for (const Table1Model& model : table->models) fmt::print("{:<18}{}\n", model.name, model.source);
  for (const Table1Part& part : table->parts) print(part);
  fmt::print(
      "\ntime: with smoothing; loops: boundary loops; non-manifold: edges of more than two "
      "triangles\n\n{}\n",
      table1_explanation());
  return {};
}

Result<void> reproduce(const Options& options, bool for_table1, const Context& context) {
  if (options.what == "table1") return table1(options, context);
  if (options.what != "figure6") {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("'{}' cannot be reproduced, known: figure6, table1", options.what),
                 {}};
  }
  if (for_table1) {
    return Error{ErrorCode::invalid_argument, "--data and --rounds belong to table1", {}};
  }
  return figure6();
}

}  // namespace

Action add_reproduce(CLI::App& app) {
  auto* verb = app.add_subcommand(
      "reproduce", "Compute a table of Ozbay and Cinar's paper anew, beside the printed one.");
  auto options = std::make_shared<Options>();
  verb->add_option("WHAT", options->what,
                   "figure6: the teapot's coordinates and distances, original and two phases; "
                   "table1: points, triangles, times and wholeness of three triangulations")
      ->required();
  verb->add_option(
      "--data", options->data,
      "table1: the folder with stanford/bun_zipper.ply, stanford/buddha_photon.obj and "
      "human/makehuman_body_tri.obj; default: what BURNISH_TEST_DATA names; shapes are "
      "generated for files that are not there");
  verb->add_option("--rounds", options->rounds,
                   "table1: run everything so often and take the shortest times; default: 3");
  verb->footer("Examples:\n  burnish reproduce figure6\n  burnish reproduce table1 --data models/");
  return [options, verb](const Session&, const Context& context) {
    return reproduce(*options, verb->count("--data") + verb->count("--rounds") > 0, context);
  };
}

}  // namespace burnish::app
