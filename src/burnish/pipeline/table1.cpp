#include "burnish/pipeline/table1.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "burnish/base/parallel.h"
#include "burnish/io/geometry_file.h"
#include "burnish/pipeline/phases.h"
#include "burnish/shapes/shapes.h"
#include "burnish/shapes/teapot.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

PointCloud positions_of(PointCloud cloud) {
  PointCloud bare;
  bare.positions = std::move(cloud.positions);
  bare.frame = cloud.frame;
  return bare;
}

/// The points of the body above the neck, which is at 85.5 % of its height; y is up.
PointCloud head_of(const PointCloud& body) {
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for (const Vec3f& p : body.positions) low = std::min(low, p.y), high = std::max(high, p.y);
  const float neck = low + 0.855f * (high - low);
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < body.positions.size(); ++i) {
    if (body.positions[i].y > neck) kept.push_back(i);
  }
  return select(body, kept);
}

/// Where the points of a model come from, and what takes their place.
struct ModelSource {
  std::string_view name, file, taken;
  PointCloud (*cut)(const PointCloud&);  ///< null: all of the file's points
  std::string_view shape;
  TriangleMesh (*make_shape)();
};

constexpr ModelSource kSources[] = {
    {"Bunny", "stanford/bun_zipper.ply", "the vertices of Stanford's file", nullptr, "torus",
     [] { return make_torus(1, 0.4, 300, 120); }},
    {"Buddha", "stanford/buddha_photon.obj", "the vertices of Stanford's Happy Buddha, simplified",
     nullptr, "teapot", [] { return make_teapot(28); }},
    {"Head", "human/makehuman_body_tri.obj", "the vertices of MakeHuman's body above the neck",
     head_of, "sphere", [] { return make_sphere(1, 5); }},
    {"Body", "human/makehuman_body_tri.obj", "the vertices of MakeHuman's body", nullptr,
     "cylinder", [] { return make_cylinder(0.3, 1.8, 96, 52); }},
};

/// What the paper prints, in the order of kSources.
struct ComparedMethod {
  std::string_view name, triangulate, smooth;  ///< `smooth` empty: none
  std::optional<Table1Printed> printed[4];
};

constexpr ComparedMethod kMethods[] = {
    {"Point cloud generation algorithm via Delaunay triangulation",
     "global",
     "nearest_farthest:iterations=2",
     {Table1Printed{35947, 69451, 13}, Table1Printed{25003, 49999, 9},
      Table1Printed{8254, 16483, 3}, Table1Printed{15697, 31324, 6}}},
    {"Global triangulation",
     "global:agreement=front",
     "",
     {Table1Printed{35948, 69460, 8}, Table1Printed{20021, 40036, 4}, std::nullopt, std::nullopt}},
    {"Fan cloud triangulation",
     "fan_cloud",
     "",
     {Table1Printed{100001, 193227, 17}, Table1Printed{47109, 94203, 5}, std::nullopt,
      std::nullopt}},
};

Result<Table1Model> load(const ModelSource& source, const std::optional<fs::path>& data,
                         const Context& context) {
  Table1Model model{std::string(source.name), {}, true, {}};
  std::error_code unreadable;
  if (data && fs::is_regular_file(*data / source.file, unreadable)) {
    Result<PointCloud> cloud = read_cloud(*data / source.file, context);
    if (!cloud) return std::move(cloud).error();
    const PointCloud points = positions_of(*std::move(cloud));
    model.points = source.cut ? source.cut(points) : points;
    model.source = fmt::format("{} ({})", source.taken, source.file);
    model.generated = false;
    return model;
  }
  TriangleMesh shape = source.make_shape();
  model.points.positions = std::move(shape.positions);
  model.name += fmt::format(" ({})", source.shape);
  model.source = fmt::format("the vertices of a {}, generated", source.shape);
  if (data) model.source += fmt::format(": there is no {} in the folder", source.file);
  return model;
}

/// Runs a method on a model once, and keeps the shortest times.
Result<void> run(const ComparedMethod& method, const Table1Model& model, Table1Row& row,
                 const Context& context) {
  Record record;
  const Result<Method> triangulate = parse_method(method.triangulate);
  if (!triangulate) return triangulate.error();
  Result<TriangleMesh> mesh =
      triangulate_cloud(model.points, *triangulate, record, context.part(0, 0.8));
  if (!mesh) return mesh.error();
  if (!method.smooth.empty()) {
    const Result<Method> smooth = parse_method(method.smooth);
    if (!smooth) return smooth.error();
    if (auto done = smooth_in_phases(*mesh, {*smooth}, {}, false, record, context.part(0.8, 1));
        !done) {
      return done;
    }
    row.smoothing = std::min(row.smoothing, record.steps.back().seconds);
  }
  row.triangulation = std::min(row.triangulation, record.steps.front().seconds);
  row.triangles = mesh->triangles.size();
  row.unused_points = model.points.positions.size() - mesh->positions.size();
  row.shape = topology(*mesh);
  return {};
}

Table1Row empty_row(const ComparedMethod& method, const Table1Model& model, std::size_t index) {
  constexpr double kLong = std::numeric_limits<double>::infinity();
  Table1Row row;
  row.model = model.name;
  row.points = model.points.positions.size();
  row.triangulation = kLong;
  row.smoothing = method.smooth.empty() ? 0 : kLong;
  row.printed = method.printed[index];
  return row;
}

}  // namespace

Result<std::vector<Table1Model>> table1_models(const std::optional<fs::path>& data,
                                               const Context& context) {
  std::error_code unreadable;
  if (data && !fs::is_directory(*data, unreadable))
    return Error{ErrorCode::not_found, "there is no such folder of data", data->string()};
  std::vector<Table1Model> models;
  constexpr double kCount = static_cast<double>(std::size(kSources));
  for (const ModelSource& source : kSources) {
    const double done = static_cast<double>(models.size());
    Result<Table1Model> model =
        load(source, data, context.part(done / kCount, (done + 1) / kCount));
    if (!model) return std::move(model).error();
    models.push_back(*std::move(model));
  }
  return models;
}

Result<Table1> reproduce_table1(const Table1Options& options, const Context& context) {
  if (options.rounds < 1 || options.rounds > 1000) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("{} rounds, 1 to 1000 expected", options.rounds),
                 {}};
  }
  context.stage("reading the models");
  Result<std::vector<Table1Model>> models = table1_models(options.data, context.part(0, 0.1));
  if (!models) return std::move(models).error();
  Table1 table{*std::move(models), {}, thread_count(context)};
  for (const ComparedMethod& method : kMethods) {
    Table1Part part{std::string(method.name), std::string(method.triangulate), {}};
    if (!method.smooth.empty()) part.how += fmt::format(", then {}", method.smooth);
    for (std::size_t i = 0; i < table.models.size(); ++i)
      part.rows.push_back(empty_row(method, table.models[i], i));
    table.parts.push_back(std::move(part));
  }
  const Context runs = context.part(0.1, 1);
  const double count = static_cast<double>(options.rounds) *
                       static_cast<double>(std::size(kMethods) * table.models.size());
  double done = 0;
  for (int round = 0; round < options.rounds; ++round) {
    for (std::size_t m = 0; m < table.parts.size(); ++m) {
      for (std::size_t i = 0; i < table.models.size(); ++i, ++done) {
        if (auto ok = run(kMethods[m], table.models[i], table.parts[m].rows[i],
                          runs.part(done / count, (done + 1) / count));
            !ok) {
          return ok.error();
        }
      }
    }
  }
  context.progress(1);
  return table;
}

std::string_view table1_explanation() {
  return "All methods ran here, on one machine, in turns, with positions alone; a time is the\n"
         "shortest of its rounds, without the reading of files.\n"
         "The first part is the paper's whole pipeline: points joined by a Delaunay "
         "triangulation,\n"
         "then smoothed. A shape with a front and a back has no plane to be triangulated in; here\n"
         "every point's triangles are those of the Delaunay triangulation of its neighbours in "
         "its\n"
         "tangent plane, all of them vote on the surface (`global`), and two passes of Equation 1\n"
         "follow.\n"
         "Global triangulation and fan clouds are Linsen and Prautzsch's as far as their "
         "abstracts\n"
         "tell; what these leave open is our choice. Fans do not ask each other: where they\n"
         "disagree, triangles overlap, and edges have more than two.\n"
         "The printed figures are the paper's own, not confirmed, and no measure for the times\n"
         "here: another machine (a Core i7 laptop, C#), for the two comparators very likely an\n"
         "older one still. Its points and triangles are those of its files: 35947 and 69451 are "
         "the\n"
         "bunny's own in Stanford's file, in which 1113 points belong to no triangle; its Buddha,\n"
         "head and body are not known, others stand for them.";
}

}  // namespace burnish
