#include "burnish/pipeline/reconstruct.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "burnish/io/geometry_file.h"
#include "burnish/measure/truth.h"
#include "burnish/pipeline/phases.h"

namespace burnish {
namespace {

std::size_t count_points(const PointCloud& cloud) {
  std::size_t count = 0;
  for (const Vec3f& p : cloud.positions) count += is_finite(p);
  return count;
}

/// Takes what is outside of `region` out of a cloud: missing pixels where it is organized.
void crop(PointCloud& cloud, const Region& region) {
  const auto inside = [&](const Vec3f& p) {
    return contains(region, cloud.frame.origin + Vec3d(p));
  };
  if (cloud.grid) {
    constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
    for (Vec3f& p : cloud.positions) {
      if (is_finite(p) && !inside(p)) p = {kMissing, kMissing, kMissing};
    }
    return;
  }
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < cloud.positions.size(); ++i) {
    if (inside(cloud.positions[i])) kept.push_back(i);
  }
  cloud = select(cloud, kept);
}

/// The record's lines for all scans together: facts of the single ones added up, or what their
/// names say of them.
class SummedSteps {
 public:
  void add(const std::vector<Step>& steps) {
    if (totals_.empty()) {
      totals_ = steps;
    } else {
      for (std::size_t k = 0; k < totals_.size(); ++k) add(totals_[k], steps[k]);
    }
    scans_ += 1;
  }

  void move_to(std::vector<Step>& steps) && {
    for (Step& step : totals_) steps.push_back(std::move(step));
  }

 private:
  void add(Step& total, const Step& step) const {
    total.seconds += step.seconds;
    for (std::size_t i = 0; i < total.facts.size(); ++i) {
      double& sum = total.facts[i].value;
      const double value = step.facts[i].value;
      const std::string& key = total.facts[i].key;
      if (key.starts_with("max_")) {
        sum = std::max(sum, value);
      } else if (key.starts_with("mean_")) {
        sum = (scans_ * sum + value) / (scans_ + 1);
      } else if (key.starts_with("rms_")) {
        sum = std::sqrt((scans_ * sum * sum + value * value) / (scans_ + 1));
      } else {
        sum += value;
      }
    }
  }

  std::vector<Step> totals_;
  double scans_ = 0;
};

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
Result<std::vector<PointCloud>> read_scans(const Scans& scans, const Recipe& recipe, Judge& judge,
                                           Record& record, const Context& context) {
  std::vector<PointCloud> clouds;
  Step reading{"read", "scans", {}, {}, 0, {}};
  SummedSteps on_frames, cleaning;
  std::size_t points = 0;
  const double count = static_cast<double>(scans.size());
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const double done = static_cast<double>(i);
    const Context share = context.part(done / count, (done + 1) / count);
    share.stage(fmt::format("reading scan {} of {}", i + 1, scans.size()));
    const auto start = std::chrono::steady_clock::now();
    Result<Scan> scan = scans.read(i, share.part(0, 0.5));
    if (!scan) return std::move(scan).error();
    record.notes.insert(record.notes.end(), scan->notes.begin(), scan->notes.end());
    PointCloud& cloud = scan->cloud;
    if (recipe.crop) {
      crop(cloud, *recipe.crop);
      if (scan->raw) crop(*scan->raw, *recipe.crop);
    }
    points += count_points(cloud);
    reading.seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (const Step& step : scan->steps) reading.seconds -= step.seconds;
    on_frames.add(scan->steps);
    judge.see_raw_points(scan->raw ? *scan->raw : cloud);
    if (cloud.grid) {
      Record single;
      if (auto clean = clean_cloud(cloud, recipe.clean_scan, single, share.part(0.5, 1)); !clean) {
        return clean.error();
      }
      cleaning.add(single.steps);
    }
    clouds.push_back(std::move(cloud));
  }
  if (points == 0) {
    return Error{
        ErrorCode::bad_geometry,
        recipe.crop ? "no point is left of the scans after cropping" : "the scans hold no point",
        {}};
  }
  reading.facts = {{"scans", count, ""}, {"points", static_cast<double>(points), ""}};
  record.steps.push_back(std::move(reading));
  std::move(on_frames).move_to(record.steps);
  std::move(cleaning).move_to(record.steps);
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

  Result<std::vector<PointCloud>> clouds =
      read_scans(**scans, recipe, *judge, record, context.part(0.12, 0.3));
  if (!clouds) return std::move(clouds).error();
  if (clouds->front().grid) record.viewpoint = (*scans)->viewpoint();
  const Result<PointCloud> cloud =
      merge_scans(*std::move(clouds), recipe, record, context.part(0.3, 0.6));
  if (!cloud) return cloud.error();

  const Method by_default{cloud->grid ? "organized" : "global", {}};
  Result<TriangleMesh> mesh = triangulate_cloud(*cloud, recipe.triangulate.value_or(by_default),
                                                record, context.part(0.6, 0.8));
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
