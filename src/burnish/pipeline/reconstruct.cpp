#include "burnish/pipeline/reconstruct.h"

#include <fmt/format.h>

#include "burnish/io/geometry_file.h"
#include "burnish/measure/truth.h"
#include "burnish/pipeline/phases.h"
#include "burnish/pipeline/scan_reader.h"

namespace burnish {
namespace {

/// Compares raw points and phases with the true surface, where there is one.
class Judge {
 public:
  static Result<Judge> of(const std::optional<std::filesystem::path>& file,
                          const Context& context) {
    Judge judge;
    if (!file) return judge;
    Result<TriangleMesh> truth = read_mesh(*file, context);
    if (!truth) return std::move(truth).error();
    judge.truth_ = *std::move(truth);
    judge.raw_.frame = judge.truth_->frame;
    return judge;
  }

  /// The points of one scan as the sensor gave them. Only their positions are kept.
  void see_raw_points(const PointCloud& cloud) {
    if (!truth_) return;
    const Vec3d shift = cloud.frame.origin - raw_.frame.origin;
    for (const Vec3f& p : cloud.positions) {
      if (is_finite(p)) raw_.positions.push_back(Vec3f(shift + Vec3d(p)));
    }
  }

  Result<void> judge_phases(Record& record, const Context& context) const {
    if (!truth_) return {};
    context.stage("comparing with the true surface");
    const Result<Distances> raw = compare_to_truth(raw_, *truth_, context.part(0, 0.2));
    if (!raw) return raw.error();
    record.comparisons.emplace_back("raw points", raw->facts());
    const double count = static_cast<double>(record.phases.size());
    for (std::size_t i = 0; i < record.phases.size(); ++i) {
      const double done = static_cast<double>(i);
      Phase& phase = record.phases[i];
      auto comparison =
          compare_to_truth(phase.mesh, *truth_, {},
                           context.part(0.2 + 0.8 * done / count, 0.2 + 0.8 * (done + 1) / count));
      if (!comparison) return std::move(comparison).error();
      phase.deviation = std::move(comparison->deviation);
      record.comparisons.emplace_back(phase.name, comparison->facts());
    }
    return {};
  }

 private:
  std::optional<TriangleMesh> truth_;
  PointCloud raw_;
};

/// Reads and cleans every scan.
Result<std::vector<PointCloud>> read_clouds(ScanReader& reader, const Context& context) {
  std::vector<PointCloud> clouds;
  const double count = static_cast<double>(reader.size());
  for (std::size_t i = 0; i < reader.size(); ++i) {
    const double done = static_cast<double>(i);
    Result<Scan> scan = reader.read(i, context.part(done / count, (done + 1) / count));
    if (!scan) return std::move(scan).error();
    clouds.push_back(std::move(scan->cloud));
  }
  return clouds;
}

/// One cloud from all: organized only where there is a single organized scan.
Result<PointCloud> merge_scans(std::vector<PointCloud> clouds, const Recipe& recipe, Record& record,
                               const Context& context) {
  if (clouds.size() == 1 && clouds.front().grid) return std::move(clouds.front());
  Result<PointCloud> merged =
      clouds.size() == 1 ? Result<PointCloud>(std::move(clouds.front()))
                         : merge_clouds(clouds, recipe.merge, record, context.part(0, 0.8));
  if (!merged) return merged;
  if (auto clean = clean_cloud(*merged, recipe.clean_merged, record, context.part(0.8, 1));
      !clean) {
    return clean.error();
  }
  return merged;
}

/// The surface by way of one cloud that is triangulated.
Result<TriangleMesh> surface_of_clouds(const Scans& scans, ScanReader reader, const Recipe& recipe,
                                       Record& record, const Context& context) {
  Result<std::vector<PointCloud>> clouds = read_clouds(reader, context.part(0, 0.35));
  if (!clouds) return std::move(clouds).error();
  if (auto read = reader.finish(record); !read) return read.error();
  if (clouds->front().grid) record.viewpoint = scans.viewpoint();
  const Result<PointCloud> cloud =
      merge_scans(*std::move(clouds), recipe, record, context.part(0.35, 0.75));
  if (!cloud) return cloud.error();
  const Method by_default{cloud->grid ? "organized" : "global", {}};
  return triangulate_cloud(*cloud, recipe.triangulate.value_or(by_default), record,
                           context.part(0.75, 1));
}

/// The surface that frames see together.
Result<TriangleMesh> surface_of_frames(const Scans& scans, ScanReader reader, const Recipe& recipe,
                                       Record& record, const Context& context) {
  const Result<ReadFrames> frames = ReadFrames::read_all(reader, context.part(0, 0.5));
  if (!frames) return frames.error();
  if (auto read = reader.finish(record); !read) return read.error();
  record.viewpoint = scans.viewpoint();
  return fuse_frames(*frames, recipe.merge, record, context.part(0.5, 1));
}

}  // namespace

Result<Reconstruction> reconstruct(const ScanInputs& inputs, const Recipe& recipe,
                                   const ReconstructOptions& options, Record record,
                                   const Context& context) {
  if (auto sound = check(recipe); !sound) return sound.error();
  const Result<std::unique_ptr<Scans>> scans =
      open_scans(inputs, recipe.frames, options.truth.has_value(), context.part(0, 0.1));
  if (!scans) return scans.error();
  Result<Judge> judge = Judge::of(options.truth, context.part(0.1, 0.12));
  if (!judge) return std::move(judge).error();
  record.notes.insert(record.notes.end(), (*scans)->notes().begin(), (*scans)->notes().end());
  record.steps.insert(record.steps.end(), (*scans)->steps().begin(), (*scans)->steps().end());

  ScanReader reader(**scans, recipe, [&](const PointCloud& raw) { judge->see_raw_points(raw); });
  const auto surface_of = fuses(recipe.merge) ? surface_of_frames : surface_of_clouds;
  Result<TriangleMesh> mesh =
      surface_of(**scans, std::move(reader), recipe, record, context.part(0.12, 0.8));
  if (!mesh) return std::move(mesh).error();
  if (auto repaired = repair_mesh(*mesh, recipe.repair, record, context.part(0.8, 0.82));
      !repaired) {
    return repaired.error();
  }
  const bool keep_phases = options.keep_phases || options.truth;
  if (auto done = smooth_in_phases(*mesh, recipe.smooth, {recipe.smooth_region, recipe.bound},
                                   keep_phases, record, context.part(0.82, 0.88));
      !done) {
    return done.error();
  }
  if (auto done =
          simplify_in_phases(*mesh, recipe.simplify, keep_phases, record, context.part(0.88, 0.9));
      !done) {
    return done.error();
  }
  if (auto judged = judge->judge_phases(record, context.part(0.9, 1)); !judged)
    return judged.error();
  context.progress(1);
  return Reconstruction{*std::move(mesh), std::move(record)};
}

}  // namespace burnish
