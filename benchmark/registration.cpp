#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "burnish/points/unproject.h"
#include "burnish/registration/clouds.h"
#include "burnish/registration/projective.h"
#include "peers/open3d_registration.h"
#include "peers/stopwatch.h"
#include "support/registration_pairs.h"

// What registration accepts and refuses, and what it takes beside Open3D:
//   burnish_benchmark_registration [PAIRS [COMPARED]]
// PAIRS good and as many bad pairs of virtual Kinect frames (200), the first COMPARED good ones
// (40) with every method. One thread; set OMP_NUM_THREADS=1 so that Open3D has one, too.
namespace {

using namespace burnish;
using test::FramePair;

Context one_thread() {
  Context context;
  context.threads = 1;
  return context;
}

struct PoseError {
  double way, turn;  ///< m at the middle of what the source sees, rad
};

PoseError error_of(const RigidTransform& T, const FramePair& pair) {
  Vec3d middle;
  double count = 0;
  const Camera& camera = pair.source.camera;
  for (std::size_t i = 0; i < pair.source.depth.size(); i += 37) {
    const double z = pair.source.depth[i];
    if (!(z > 0)) continue;
    middle += camera.unproject(static_cast<double>(i % camera.width),
                               static_cast<double>(i / camera.width), z);
    count += 1;
  }
  middle = middle / std::max(count, 1.0);
  const auto [x, y, z, w] = quaternion(T.inverse() * pair.T_target_source);
  return {norm(T(middle) - pair.T_target_source(middle)),
          2 * std::asin(std::min(1.0, std::hypot(x, y, z)))};
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

PairRegistration registered(const FramePair& pair, const Context& context) {
  const SurfaceView source = surface_view(pair.source, {}, context).value();
  const SurfaceView target = surface_view(pair.target, {}, context).value();
  return register_projective(source, target, pair.guess, {.reach = pair.reach}, context).value();
}

struct Count {
  int refused = 0, of = 0;
};

/// Judges pairs, says which were judged wrongly and how many of each kind were refused.
void judge_pairs(int pairs, bool good) {
  std::map<std::string, Count> kinds;
  std::vector<double> ways;
  Count all;
  for (int i = 0; i < pairs; ++i) {
    const auto number = static_cast<std::uint64_t>(i);
    const FramePair pair = good ? test::good_pair(number) : test::bad_pair(number);
    const PairRegistration found = registered(pair, one_thread());
    const int refused = found.accepted() ? 0 : 1;
    for (Count* count : {&kinds[pair.kind], &all}) count->refused += refused, ++count->of;
    const PoseError error = error_of(found.T_target_source, pair);
    if (good && found.accepted()) ways.push_back(error.way);
    if ((refused == 1) != good) continue;
    std::printf("  %s %d (%s), off by %.2f mm, was %s%s\n", good ? "good" : "bad", i,
                pair.kind.c_str(), 1e3 * error.way, refused ? "refused: " : "accepted",
                found.reason.c_str());
  }
  std::printf("%s pairs: %d of %d refused (%.1f %%)\n", good ? "good" : "bad", all.refused, all.of,
              100.0 * all.refused / std::max(all.of, 1));
  for (const auto& [kind, count] : kinds) {
    std::printf("  %-18s %3d of %3d refused\n", kind.c_str(), count.refused, count.of);
  }
  if (good) {
    std::printf("  accepted ones off by %.2f mm (median), %.2f (95 %%), %.2f (most)\n",
                1e3 * quantile(ways, 0.5), 1e3 * quantile(ways, 0.95), 1e3 * quantile(ways, 1));
  }
}

PlainFrame plain(const DepthFrame& frame) {
  const Camera& c = frame.camera;
  PlainFrame result{static_cast<int>(c.width),
                    static_cast<int>(c.height),
                    c.fx,
                    c.fy,
                    c.cx,
                    c.cy,
                    frame.depth,
                    {}};
  for (std::uint32_t row = 0; row < c.height; row += 4) {
    for (std::uint32_t column = 0; column < c.width; column += 4) {
      const double z = frame.depth[std::size_t{row} * c.width + column];
      if (!(z > 0)) continue;
      const Vec3d p = c.unproject(column, row, z);
      result.points.push_back({p.x, p.y, p.z});
    }
  }
  return result;
}

PlainPose plain(const RigidTransform& T) {
  PlainPose pose{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) pose[4 * i + j] = T.rows[i][j];
    pose[4 * i + 3] = T.translation[i];
  }
  pose[15] = 1;
  return pose;
}

RigidTransform pose_of(const PlainPose& pose) {
  RigidTransform T;
  for (std::size_t i = 0; i < 3; ++i) {
    T.rows[i] = {pose[4 * i], pose[4 * i + 1], pose[4 * i + 2]};
    T.translation[i] = pose[4 * i + 3];
  }
  return T;
}

/// Every fourth row and column of a frame, from the camera, with what burnish knows of its noise.
PointCloud quarter(const DepthFrame& frame) {
  DepthFrame here = frame;
  here.T_world_camera = {};
  const PointCloud cloud = unproject(here, {.normals = false}, one_thread()).value();
  std::vector<std::uint32_t> kept;
  for (std::uint32_t row = 0; row < frame.camera.height; row += 4) {
    for (std::uint32_t column = 0; column < frame.camera.width; column += 4) {
      const std::uint32_t i = row * frame.camera.width + column;
      if (is_finite(cloud.positions[i])) kept.push_back(i);
    }
  }
  PointCloud result = select(cloud, kept);
  result.viewpoint = Vec3d{};
  return result;
}

struct Method {
  const char* name;
  std::vector<double> seconds{}, ways{}, turns{};
};

/// `first` and every second pair after it: 0 for rooms, 1 for objects.
void compare(int first, int pairs) {
  std::vector<Method> methods{{"burnish projective"},     {"  its views alone"},
                              {"burnish point_to_plane"}, {"burnish generalized"},
                              {"Open3D point to plane"},  {"Open3D generalized"},
                              {"Open3D odometry, depth"}};
  for (int i = first; i < pairs; i += 2) {
    const FramePair pair = test::good_pair(static_cast<std::uint64_t>(i));
    const PlainFrame source = plain(pair.source), target = plain(pair.target);
    const PointCloud from = quarter(pair.source), to = quarter(pair.target);
    std::size_t number = 0;
    const auto run = [&](const auto& align) {
      const Stopwatch watch;
      const RigidTransform T = align();
      Method& method = methods[number++];
      method.seconds.push_back(watch.seconds().processor);
      const PoseError error = error_of(T, pair);
      method.ways.push_back(error.way);
      method.turns.push_back(error.turn);
    };
    const auto clouds = [&](CloudError error) {
      const CloudsParams params{.error = error, .reach = pair.reach};
      return register_clouds(from, to, pair.guess, params, one_thread()).value().T_target_source;
    };
    const auto peer = [&](Peer which) {
      return pose_of(align_with_open3d(which, source, target, plain(pair.guess), pair.reach));
    };
    run([&] { return registered(pair, one_thread()).T_target_source; });
    run([&] {
      const bool made = surface_view(pair.source, {}, one_thread()).has_value() &&
                        surface_view(pair.target, {}, one_thread()).has_value();
      return made ? pair.guess : RigidTransform{};
    });
    run([&] { return clouds(CloudError::point_to_plane); });
    run([&] { return clouds(CloudError::generalized); });
    run([&] { return peer(Peer::point_to_plane); });
    run([&] { return peer(Peer::generalized); });
    run([&] { return peer(Peer::odometry); });
  }
  std::printf("%d pairs of 640 x 480 frames of %s; the processor's time\n", (pairs + 1 - first) / 2,
              first == 0 ? "rooms" : "objects");
  std::printf("  %-24s %10s %10s %10s %12s\n", "", "ms median", "mm median", "mm 90 %",
              "deg median");
  for (const Method& method : methods) {
    std::printf("  %-24s %10.1f %10.2f %10.2f %12.3f\n", method.name,
                1e3 * quantile(method.seconds, 0.5), 1e3 * quantile(method.ways, 0.5),
                1e3 * quantile(method.ways, 0.9),
                quantile(method.turns, 0.5) / test::pairs::kDegree);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int pairs = argc > 1 ? std::atoi(argv[1]) : 200;
  const int compared = argc > 2 ? std::atoi(argv[2]) : 40;
  if (pairs < 0 || compared < 0) return 2;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  if (pairs > 0) {
    judge_pairs(pairs, true);
    judge_pairs(pairs, false);
  }
  for (int first = 0; first < std::min(2, compared); ++first) compare(first, compared);
  return 0;
}
