#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "burnish/io/geometry_file.h"
#include "burnish/registration/turntable_views.h"
#include "burnish/registration/twist.h"
#include "burnish/sensor/frame_sequence.h"
#include "burnish/sensor/turntable.h"
#include "burnish/shapes/shapes.h"
#include "peers/stopwatch.h"

// burnish_benchmark_turntable DATA WORK [SEEDS]: lets a virtual Kinect scan three objects, 0.3 m
// large, in 12, 24 and 36 views on a turntable whose axis is 5 cm off and leans by 5 degrees, with
// steps jittered by 2 degrees, and finds the poses. Per run how far the axis is off, how far the
// views are, at most, after the one motion of the whole world that nobody can know has been taken
// out; and the same of poses that are chained from pair to pair. One thread. WORK is a folder for
// the frames.
namespace {

using namespace burnish;

constexpr double kDegrees = 180 / std::numbers::pi;

template <class T>
T required(Result<T> result) {
  if (result) return *std::move(result);
  std::fprintf(stderr, "%s\n", result.error().text().c_str());
  std::exit(1);
}

Vec3d middle_of(const TriangleMesh& mesh) {
  Vec3d sum{};
  for (const Vec3f& p : mesh.positions) sum += Vec3d(p);
  return sum / static_cast<double>(mesh.positions.size());
}

struct Errors {
  double turn = 0, shift = 0;  ///< the largest of any view: degrees; mm at the object's middle
};

/// How far poses are from the truth once both worlds have been laid on each other.
Errors errors_of(const std::vector<RigidTransform>& found, const std::vector<RigidTransform>& truth,
                 const Vec3d& middle) {
  RigidTransform T_truth_found = truth.front() * found.front().inverse();
  const auto off = [&](std::size_t i) {
    const Twist twist = difference(T_truth_found * found[i], truth[i]);
    return Twist{twist.rotation, twist.translation + cross(twist.rotation, middle)};
  };
  const double count = static_cast<double>(found.size());
  for (int pass = 0; pass < 20; ++pass) {
    Twist mean{};
    for (std::size_t i = 0; i < found.size(); ++i) {
      mean.rotation += off(i).rotation / count;
      mean.translation += off(i).translation / count;
    }
    mean.translation = mean.translation - cross(mean.rotation, middle);
    T_truth_found = moved(T_truth_found, mean);
  }
  Errors errors;
  for (std::size_t i = 0; i < found.size(); ++i) {
    errors.turn = std::max(errors.turn, norm(off(i).rotation) * kDegrees);
    errors.shift = std::max(errors.shift, norm(off(i).translation) * 1000);
  }
  return errors;
}

/// Every view from the one before it alone; the drift is what is left when the circle closes.
struct Chain {
  std::vector<RigidTransform> poses;
  RigidTransform around;
};

Chain chained(const std::vector<RegisteredPair>& pairs, std::size_t views) {
  Chain chain{{RigidTransform{}}, {}};
  for (std::uint32_t i = 0; i < views; ++i) {
    const std::uint32_t next = (i + 1) % static_cast<std::uint32_t>(views);
    const auto pair = std::find_if(pairs.begin(), pairs.end(), [&](const RegisteredPair& p) {
      return p.target == i && p.source == next;
    });
    if (pair == pairs.end()) return {};
    const RigidTransform pose = chain.poses.back() * pair->registration.T_target_source;
    if (next == 0) {
      chain.around = pose;
    } else {
      chain.poses.push_back(pose);
    }
  }
  return chain;
}

struct Axis {
  double turn = 0, shift = 0;  ///< degrees, mm
};

/// The axis as the first camera sees it, found beside true: from the half turn between two views.
Axis axis_error(const TurntableViews& found, const std::vector<RigidTransform>& truth) {
  const std::size_t half = truth.size() / 2;
  const RigidTransform T = truth[0].inverse() * truth[half];
  const Vec3d v = rotation_vector(T);
  Vec3d direction = normalized(v);
  const Vec3d across = T.translation - direction * dot(T.translation, direction);
  const Vec3d point = (across + cross(direction, across) / std::tan(norm(v) / 2)) * 0.5;
  const RigidTransform T_camera_world = found.poses.T_world_view[0]->inverse();
  const Vec3d found_direction = T_camera_world.rotate({0, 0, 1});
  if (dot(direction, found_direction) < 0) direction = -direction;
  const Vec3d apart = T_camera_world.translation - point;
  const double along = dot(apart, direction);
  return {std::acos(std::min(1., dot(direction, found_direction))) * kDegrees,
          norm(apart - direction * along) * 1000};
}

void run(const std::string& name, const TriangleMesh& model, int views, int seed,
         const std::filesystem::path& work) {
  const std::filesystem::path folder = work / "turntable";
  TurntableParams params;
  params.views = views;
  params.seed = seed;
  params.rings = 1;
  params.size = 0.3;
  params.distance = 0.65;
  params.axis_offset = 0.05;
  params.axis_tilt = 5 / kDegrees;
  params.step_jitter = 2 / kDegrees;
  required(simulate_turntable(model, find_sensor("kinect_v1").value(), params, folder));
  const FrameSequence frames = required(open_frames({folder}));
  std::vector<RigidTransform> truth;
  for (const FrameFile& file : frames.files()) truth.push_back(*file.T_world_camera);
  const ViewSource source{frames.size(), [&](std::size_t i, const Context& context) {
                            return surface_view(required(frames.read(i)), {}, context);
                          }};
  Context context;
  context.threads = 1;
  const Stopwatch clock;
  const TurntableViews found = required(register_turntable(source, {}, context));
  const double seconds = clock.seconds().processor;
  std::vector<RigidTransform> poses, true_poses;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!found.poses.T_world_view[i]) continue;
    poses.push_back(*found.poses.T_world_view[i]);
    true_poses.push_back(truth[i]);
  }
  std::printf("%s, %d views, seed %d: %zu placed, %.2f s", name.c_str(), views, seed, poses.size(),
              seconds);
  if (!poses.empty() && found.poses.T_world_view[0]) {
    const Vec3d middle = middle_of(required(read_mesh(folder / "truth" / "model.ply")));
    const Errors errors = errors_of(poses, true_poses, middle);
    const Axis axis = axis_error(found, truth);
    std::printf("; axis %.3f deg, %.2f mm; views %.3f deg, %.2f mm", axis.turn, axis.shift,
                errors.turn, errors.shift);
    const Chain chain = chained(found.poses.pairs, truth.size());
    if (chain.poses.size() == truth.size()) {
      const Errors loose = errors_of(chain.poses, truth, middle);
      const Vec3d seen = truth[0].inverse()(middle);
      std::printf("; chained %.3f deg, %.2f mm, drift %.2f mm", loose.turn, loose.shift,
                  1000 * norm(chain.around(seen) - seen));
    }
  }
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const std::filesystem::path data = argv[1], work = argv[2];
  const int seeds = argc > 3 ? std::atoi(argv[3]) : 5;
  std::filesystem::create_directories(work);
  const std::pair<std::string, TriangleMesh> objects[] = {
      {"bunny", required(read_mesh(data / "stanford/bun_zipper.ply"))},
      {"buddha", required(read_mesh(data / "stanford/buddha_photon.obj"))},
      {"teapot", make_shape("teapot").value()}};
  for (const auto& [name, model] : objects) {
    for (const int views : {12, 24, 36}) {
      for (int seed = 1; seed <= seeds; ++seed) run(name, model, views, seed, work);
    }
  }
}
