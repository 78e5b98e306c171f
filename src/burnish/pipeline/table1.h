#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/result.h"
#include "burnish/core/point_cloud.h"
#include "burnish/core/topology.h"

namespace burnish {

/// The points that stand for one of the models that Table 1 names.
struct Table1Model {
  std::string name;        ///< "Bunny", or "Bunny (torus)" where that stands for it
  std::string source;      ///< what was taken, a sentence
  bool generated = false;  ///< a shape in place of a file that is not there
  PointCloud points;       ///< positions alone
};

/// What Ozbay and Cinar print: another machine, most likely other files; not confirmed.
struct Table1Printed {
  std::size_t points = 0, triangles = 0;
  double seconds = 0;
};

/// One method on one model.
struct Table1Row {
  std::string model;
  std::size_t points = 0, triangles = 0;
  std::size_t unused_points = 0;            ///< that are in no triangle
  double triangulation = 0, smoothing = 0;  ///< s, the shortest of all rounds
  Topology shape;
  std::optional<Table1Printed> printed;  ///< where the paper has this row

  double seconds() const { return triangulation + smoothing; }
};

/// One method on all models.
struct Table1Part {
  std::string method;  ///< as the paper calls it
  std::string how;     ///< what is run here, as the program's options are written
  std::vector<Table1Row> rows;
};

struct Table1 {
  std::vector<Table1Model> models;
  std::vector<Table1Part> parts;
  int threads = 1;
};

struct Table1Options {
  std::optional<std::filesystem::path> data{};  ///< a folder with the models' files; none: shapes
  int rounds = 3;  ///< every method is run so often, in turns, and the shortest time is taken
};

/// The bunny, the Buddha, a head and a body: from `stanford/bun_zipper.ply`,
/// `stanford/buddha_photon.obj` and `human/makehuman_body_tri.obj` (head and body) in the folder,
/// or shapes where these are not. Errors: not_found where there is no such folder; those of
/// read_cloud.
Result<std::vector<Table1Model>> table1_models(const std::optional<std::filesystem::path>& data,
                                               const Context& context = {});

/// Table 1 of Ozbay and Cinar, run anew on one machine in one go: their pipeline as it is here
/// (`global`, then two passes of Eq. 1), global triangulation that grows as the comparator does
/// (`global:agreement=front`) and fan clouds (`fan_cloud`) on every model. Times vary, nothing else
/// does. Errors: those of table1_models, invalid_argument, cancelled.
Result<Table1> reproduce_table1(const Table1Options& options = {}, const Context& context = {});

/// What is compared with what, and what the printed figures are worth.
std::string_view table1_explanation();

}  // namespace burnish
