#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <limits>

#include "conformance/suite.h"
#include "support/progress.h"
#include "support/test_data.h"

// What an operation must never do: touch its input when it fails, work on broken input, forget to
// tell how far it is, or print.
namespace burnish::test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

class Safety : public Conformance {
 protected:
  /// `broken` must be refused as bad geometry, and stay as it is.
  void expect_refusal(const char* what, Workpiece broken) const {
    const std::string before = bytes(broken);
    const auto outcome = subject().run(broken, {}, {});
    ASSERT_FALSE(outcome) << what << " was accepted";
    EXPECT_EQ(outcome.error().code, ErrorCode::bad_geometry)
        << what << ": " << outcome.error().text();
    EXPECT_FALSE(outcome.error().message.empty()) << what;
    EXPECT_TRUE(bytes(broken) == before) << what << " changed the input";
  }

  void spoil(Workpiece& workpiece, std::size_t place, float bad) const {
    if (subject().takes_frames()) {
      workpiece.frames.back().depth[place] = bad;
    } else if (subject().takes_mesh()) {
      workpiece.mesh.positions[place].y = bad;
    } else {
      workpiece.clouds.back().positions[place].y = bad;
    }
  }
  Attributes& attributes(Workpiece& workpiece) const {
    return subject().takes_mesh() ? workpiece.mesh.attributes : workpiece.clouds.back().attributes;
  }
};

TEST_P(Safety, RefusesPositionsThatAreNoNumbers) {
  for (const float bad : {kNaN, kInfinity, -kInfinity}) {
    Workpiece broken = unorganized(subject().sample);
    spoil(broken, 17, bad);
    expect_refusal("a position that is not finite", broken);
  }
}

TEST_P(Safety, RefusesAttributesOfAnotherLength) {
  Workpiece broken = subject().sample;
  if (subject().takes_frames()) {
    broken.frames.back().noise_share.pop_back();
    expect_refusal("a noise share that is too short", broken);
    broken = subject().sample;
    broken.frames.back().observations.push_back(1);
    expect_refusal("observations that are too long", broken);
    return;
  }
  attributes(broken).sigma.pop_back();
  expect_refusal("sigma that is too short", broken);
  broken = subject().sample;
  attributes(broken).normals.push_back({});
  expect_refusal("normals that are too long", broken);
  broken = subject().sample;
  attributes(broken).channels.push_back({"short", std::vector<double>{1, 2, 3}});
  expect_refusal("a channel that is too short", broken);
}

TEST_P(Safety, RefusesWhatDoesNotHangTogether) {
  Workpiece broken = subject().sample;
  if (subject().takes_mesh()) {
    broken.mesh.triangles[5][1] = static_cast<std::uint32_t>(broken.mesh.positions.size());
    expect_refusal("an index out of range", broken);
  } else if (subject().takes_frames()) {
    broken.frames.back().camera.width += 1;
    expect_refusal("a camera of another size", broken);
  } else {
    broken.clouds.back().grid->width += 1;
    expect_refusal("a grid of another size", broken);
  }
}

TEST_P(Safety, SurvivesEmptyInput) {
  Workpiece nothing = subject().sample;
  nothing.mesh = {};
  for (PointCloud& cloud : nothing.clouds) cloud = {};
  for (DepthFrame& frame : nothing.frames) frame = {};
  const auto outcome = subject().outcome_of(nothing);
  if (!outcome) {
    EXPECT_EQ(outcome.error().code, ErrorCode::bad_geometry) << outcome.error().text();
    EXPECT_FALSE(outcome.error().message.empty());
  } else {
    EXPECT_TRUE(outcome->output.mesh.triangles.empty());
    for (const PointCloud& cloud : outcome->output.clouds) EXPECT_TRUE(cloud.positions.empty());
  }
}

TEST_P(Safety, RefusesSettingsThatCannotBeAndLeavesTheInput) {
  Workpiece input = subject().sample;
  const auto outcome = subject().run(input, {{"no_such_parameter", "1"}}, {});
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, ErrorCode::invalid_argument);
  EXPECT_TRUE(bytes(input) == bytes(subject().sample));
}

TEST_P(Safety, LeavesTheInputWhereverItIsCancelled) {
  const std::string before = bytes(subject().sample);
  const std::string complete = bytes(expected());
  bool stopped_inside = false;
  for (const double fraction : {0.0, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0}) {
    CancelAt cancel(fraction);
    Workpiece input = subject().sample;
    const auto outcome = subject().run(input, {}, cancel.context());
    if (outcome) {
      EXPECT_GE(cancel.reported(), 0.95) << "a stop at " << cancel.reported() << " was not heeded";
      EXPECT_TRUE(bytes(*outcome) == complete) << "a stop at " << fraction << " changed the result";
    } else {
      EXPECT_EQ(outcome.error().code, ErrorCode::cancelled) << outcome.error().text();
      EXPECT_TRUE(bytes(input) == before) << "a stop at " << fraction << " changed the input";
      stopped_inside |= cancel.reported() > 0 && cancel.reported() < 1;
    }
  }
  EXPECT_TRUE(stopped_inside) << "nothing was reported between beginning and end";
}

TEST_P(Safety, DoesNothingWhenCancelledBeforehand) {
  std::stop_source stop;
  stop.request_stop();
  Context context;
  context.stop = stop.get_token();
  Workpiece input = subject().sample;
  const auto outcome = subject().run(input, {}, context);
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, ErrorCode::cancelled) << outcome.error().text();
  EXPECT_TRUE(bytes(input) == bytes(subject().sample));
}

TEST_P(Safety, ReportsProgressThatRisesToTheEnd) {
  for (const int threads : {1, 3}) {
    ProgressLog log;
    Context context;
    context.threads = threads;
    context.sink = &log;
    expected({}, context.part(0.25, 0.75));
    ASSERT_FALSE(log.fractions().empty());
    EXPECT_TRUE(log.monotone());
    EXPECT_TRUE(log.from_one_thread());
    EXPECT_GE(log.fractions().front(), 0.25);
    EXPECT_EQ(log.fractions().back(), 0.75);
  }
}

TEST_P(Safety, KeepsEveryAttributeAsLongAsTheVertices) {
  const Outcome outcome = expected();
  // A merged point is the mean of several; frames have no colours.
  const bool keeps_colors = subject().family != "merge" && subject().family != "fuse";
  const auto expect_complete = [&](const auto& vertices, const Attributes& attributes) {
    ASSERT_FALSE(vertices.empty());
    EXPECT_TRUE(check_lengths(attributes, vertices.size()));
    EXPECT_EQ(attributes.normals.size(), vertices.size());
    EXPECT_EQ(attributes.colors.size(), keeps_colors ? vertices.size() : 0);
    EXPECT_EQ(attributes.sigma.size(), vertices.size());
    EXPECT_EQ(attributes.observations.size(), vertices.size());
    EXPECT_EQ(attributes.origin.size(), vertices.size());
  };
  for (const PointCloud& cloud : outcome.output.clouds) {
    EXPECT_TRUE(check(cloud));
    expect_complete(cloud.positions, cloud.attributes);
  }
  for (const DepthFrame& frame : outcome.output.frames) {
    EXPECT_TRUE(check(frame));
    EXPECT_EQ(frame.noise_share.size(), frame.depth.size());
    EXPECT_EQ(frame.sigma_share.size(), frame.depth.size());
    EXPECT_EQ(frame.observations.size(), frame.depth.size());
  }
  if (outcome.output.clouds.empty() && outcome.output.frames.empty()) {
    EXPECT_TRUE(check(outcome.output.mesh));
    EXPECT_FALSE(outcome.output.mesh.triangles.empty());
    expect_complete(outcome.output.mesh.positions, outcome.output.mesh.attributes);
  }
}

/// Standard output and error of this process, into a file for as long as this lives.
class Capture {
 public:
  Capture() {
    std::fflush(nullptr);
    const int file = ::open((folder_ / "printed").c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
    for (int stream : {1, 2}) {
      saved_[stream - 1] = ::dup(stream);
      ::dup2(file, stream);
    }
    ::close(file);
  }
  ~Capture() { restore(); }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  std::uintmax_t printed_bytes() {
    restore();
    return std::filesystem::file_size(folder_ / "printed");
  }

 private:
  void restore() {
    std::fflush(nullptr);
    for (int stream : {1, 2}) {
      if (saved_[stream - 1] < 0) continue;
      ::dup2(saved_[stream - 1], stream);
      ::close(saved_[stream - 1]);
      saved_[stream - 1] = -1;
    }
  }

  TemporaryFolder folder_;
  int saved_[2] = {-1, -1};
};

TEST_P(Safety, PrintsNothing) {
  Capture capture;
  Context many_threads;
  many_threads.threads = 64;
  const auto good = subject().outcome({}, many_threads);
  const auto refused = subject().outcome({{"no_such_parameter", "1"}});
  Workpiece broken = unorganized(subject().sample);
  spoil(broken, 0, kNaN);
  const auto failed = subject().outcome_of(broken);
  EXPECT_EQ(capture.printed_bytes(), 0u);
  EXPECT_TRUE(good);
  EXPECT_FALSE(refused);
  EXPECT_FALSE(failed);
}

TEST(CaptureTest, SeesWhatIsPrinted) {
  Capture capture;
  std::printf("four");
  EXPECT_EQ(::write(2, "five", 4), 4);
  EXPECT_EQ(capture.printed_bytes(), 8u);
}

BURNISH_FOR_EVERY_OPERATION(Safety);

}  // namespace
}  // namespace burnish::test
