#include "burnish/pipeline/registered_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

namespace burnish {
namespace {

using Json = nlohmann::ordered_json;

/// Drops what is out of the range of depths that counts.
void confine(DepthFrame& frame, const FrameRegistration& registration) {
  for (float& z : frame.depth) {
    const bool far = registration.farthest > 0 && z > registration.farthest;
    if (z < registration.nearest || far) z = 0;
  }
}

ViewSource views_of(const FrameSequence& frames, const FrameRegistration& registration) {
  return {frames.size(), [&](std::size_t i, const Context& context) -> Result<SurfaceView> {
            Result<DepthFrame> frame = frames.read(i);
            if (!frame) return std::move(frame).error();
            confine(*frame, registration);
            return surface_view(*frame, {}, context);
          }};
}

Result<RegisteredFrames> find_poses(const ViewSource& views, const FrameRegistration& registration,
                                    const Context& context) {
  RegisteredFrames result;
  if (registration.scene == FrameRegistration::Scene::turntable) {
    Result<TurntableViews> table = register_turntable(views, registration.turntable, context);
    if (!table) return std::move(table).error();
    result.facts = table->facts();
    result.poses = std::move(table->poses);
    result.angles = std::move(table->angles);
    result.axis_elevation = table->axis_elevation;
  } else {
    Result<ViewPoses> poses = register_sequence(views, registration.sequence, context);
    if (!poses) return std::move(poses).error();
    result.facts = poses->facts();
    result.poses = *std::move(poses);
  }
  return result;
}

/// Why a view has no pose: what its best pair says against it.
std::string reason_of(const ViewPoses& poses, std::size_t view) {
  std::string reason = "nothing was laid on it";
  std::optional<std::size_t> most;
  for (const RegisteredPair& pair : poses.pairs) {
    const bool of_view = pair.target == view || pair.source == view;
    const PairRegistration& r = pair.registration;
    if (!of_view || r.accepted() || (most && r.matched <= *most)) continue;
    most = r.matched;
    reason =
        fmt::format("with frame {}: {}", pair.target == view ? pair.source : pair.target, r.reason);
  }
  return reason;
}

Step step_of(const FrameRegistration& registration, const Facts& facts, double seconds) {
  if (registration.scene == FrameRegistration::Scene::turntable) {
    const auto& schema = TurntableViewsParams::schema();
    return {"register", "turntable", schema.settings(registration.turntable),
            facts,      seconds,     schema.fields()};
  }
  const auto& schema = SequenceViewsParams::schema();
  return {"register", "sequence", schema.settings(registration.sequence),
          facts,      seconds,    schema.fields()};
}

Json numbers(const Vec3d& v) {
  return {v.x, v.y, v.z};
}

Json pair_json(const FrameSequence& frames, const RegisteredPair& pair) {
  const PairRegistration& r = pair.registration;
  Json json;
  json["target"] = frames.name(pair.target);
  json["source"] = frames.name(pair.source);
  json["accepted"] = r.accepted();
  if (!r.accepted()) json["reason"] = r.reason;
  json["overlap"] = r.overlap;
  json["inlier_rmse"] = r.inlier_rmse;
  json["contradiction"] = r.contradiction;
  json["iterations"] = r.iterations;
  const auto [qx, qy, qz, qw] = quaternion(r.T_target_source);
  json["T_target_source"] = {{"translation", numbers(r.T_target_source.translation)},
                             {"quaternion", {qx, qy, qz, qw}}};
  json["weakest"] = {
      {"axis", numbers(r.weakest.axis)},
      {"turn", r.weakest.turn},
      {"eigenvalue", r.weakest.eigenvalue},
      {"deviation", std::isfinite(r.weakest.deviation) ? Json(r.weakest.deviation) : Json()}};
  json["covariance"] = r.covariance;
  return json;
}

}  // namespace

Result<RegisteredFrames> register_frames(const FrameSequence& frames,
                                         const FrameRegistration& registration, Record& record,
                                         const Context& context) {
  const auto start = std::chrono::steady_clock::now();
  context.stage(fmt::format("finding the poses of {} frames", frames.size()));
  Result<RegisteredFrames> found =
      find_poses(views_of(frames, registration), registration, context);
  if (!found) return found;
  found->reasons.resize(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (found->poses.T_world_view[i]) continue;
    found->reasons[i] = reason_of(found->poses, i);
    record.notes.push_back(
        fmt::format("{} has no pose and is left out: {}", frames.name(i), found->reasons[i]));
  }
  if (found->poses.placed() < 2) {
    return Error{ErrorCode::bad_geometry,
                 fmt::format("no two of {} frames can be laid on each other with certainty; the "
                             "first: {}",
                             frames.size(),
                             found->reasons.front().empty() ? found->reasons.back()
                                                            : found->reasons.front()),
                 "register"};
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  record.steps.push_back(step_of(registration, found->facts, seconds.count()));
  return found;
}

std::string registration_json(const FrameSequence& frames, const RegisteredFrames& registered) {
  Json json;
  for (const Fact& fact : registered.facts) json["result"][fact.key] = fact.value;
  if (!registered.angles.empty()) {
    json["turntable"] = {{"axis_elevation_rad", registered.axis_elevation},
                         {"angles_rad", registered.angles}};
  }
  for (std::size_t i = 0; i < frames.size(); ++i) {
    Json frame{{"name", frames.name(i)}, {"placed", registered.reasons[i].empty()}};
    if (registered.reasons[i].empty()) {
      frame["deviation_m"] = registered.poses.deviations[i];
    } else {
      frame["reason"] = registered.reasons[i];
    }
    json["frames"].push_back(std::move(frame));
  }
  for (const RegisteredPair& pair : registered.poses.pairs) {
    json["pairs"].push_back(pair_json(frames, pair));
  }
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace burnish
