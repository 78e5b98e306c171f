// Trains the networks of the smoothing `auto`: generates its examples, and writes the weights.
//   train_fusion OUT.inc white|camera [EXAMPLES] [EPOCHS] [SEED]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <string>

#include "burnish/base/random.h"
#include "burnish/core/edges.h"
#include "burnish/smoothing/fusion_stage.h"
#include "burnish/smoothing/fusion_weights.h"
#include "burnish/smoothing/vertex_update.h"
#include "examples.h"
#include "network.h"

namespace burnish::training {
namespace {

/// A noisy mesh on its way through the stages.
struct Work {
  TriangleMesh mesh;
  FaceWork faces;
  std::vector<Vec3d> positions;
  FaceNormals truth;
  std::unique_ptr<FusionStage> stage;
};

FaceNormals normals_of(const TriangleMesh& mesh, const std::vector<Vec3d>& positions) {
  FaceGeometry faces;
  (void)measure_faces({}, mesh.triangles, positions, faces);
  return faces.normals;
}

std::unique_ptr<Work> work_of(const Example& example) {
  auto work = std::make_unique<Work>();
  work->mesh = example.noisy;
  work->faces = begin_face_work(work->mesh, {}).value();
  work->positions = work->faces.surface.positions;
  work->truth =
      normals_of(example.clean, {example.clean.positions.begin(), example.clean.positions.end()});
  work->stage = std::make_unique<FusionStage>(work->mesh, work->faces);
  return work;
}

/// Mean angle between the faces and the truth, degrees.
double error_of(const Work& work) {
  const FaceNormals normals = normals_of(work.mesh, work.positions);
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t f = 0; f < normals.size(); ++f) {
    const Vec3d n(normals[f].xyz()), truth(work.truth[f].xyz());
    if (n == Vec3d{} || truth == Vec3d{}) continue;
    sum += std::acos(std::clamp(dot(n, truth), -1.0, 1.0));
    ++count;
  }
  return sum / static_cast<double>(std::max<std::size_t>(count, 1)) * 180 / std::numbers::pi;
}

/// Adds a share of the faces to what the network learns from.
void add_samples(const Work& work, double share, Random& random, Samples& samples) {
  const FusionInput input = work.stage->input();
  FusionFeatures features;
  for (std::size_t f = 0; f < work.truth.size(); ++f) {
    const Quad truth = work.truth[f];
    if (random.uniform() >= share || dot3(truth, truth) == 0) continue;
    const FusionFrame frame = fusion_features(input, f, features);
    samples.features.push_back(features);
    samples.truth.push_back({dot3(truth, frame.x), dot3(truth, frame.y), dot3(truth, frame.z)});
  }
}

void apply(Work& work, const FusionNetwork& network) {
  (void)work.stage->fuse({}, network);
  VertexUpdate update(work.mesh, work.faces.faces_of_vertices, {.boundary = BoundaryRule::free},
                      {});
  (void)update.run({}, work.stage->normals(), kFusionVertexPasses, work.positions);
}

void write(std::FILE* file, const FusionNetwork& network) {
  const auto part = [&](std::span<const float> values) {
    std::fprintf(file, "{");
    for (std::size_t i = 0; i < values.size(); ++i) {
      std::fprintf(file, "%#.5gf,%s", static_cast<double>(values[i]), i % 10 == 9 ? "\n" : "");
    }
    std::fprintf(file, "},\n");
  };
  std::fprintf(file, "{");
  part(network.first);
  part(network.second);
  part(network.last);
  std::fprintf(file, "},\n");
}

int run(int argc, char** argv) {
  const std::string kind = argv[2];
  const int count = argc > 3 ? std::atoi(argv[3]) : 60;
  TrainingParams params;
  if (argc > 4) params.epochs = std::atoi(argv[4]);
  if (argc > 5) params.seed = static_cast<std::uint64_t>(std::atoi(argv[5]));
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const auto make = [&](int n, std::uint64_t seed) {
    std::vector<std::unique_ptr<Work>> works;
    for (const Example& e : kind == "camera" ? camera_examples(n, seed) : white_examples(n, seed)) {
      works.push_back(work_of(e));
    }
    return works;
  };
  auto works = make(count, params.seed), held_out = make(32, params.seed + 1000);
  std::size_t faces = 0;
  for (const auto& work : works) faces += work->truth.size();
  const double share = std::min(1.0, 1200000.0 / static_cast<double>(faces));
  std::printf("%zu faces, %.0f s\n", faces, seconds());
  const auto mean_held_out = [&] {
    double sum = 0;
    for (const auto& work : held_out) sum += error_of(*work);
    return sum / static_cast<double>(held_out.size());
  };
  std::vector<FusionNetwork> stages;
  double before = mean_held_out();
  for (std::size_t s = 0; s < kFusionStages; ++s) {
    Samples samples;
    Random random(params.seed + 7);
    for (const auto& work : works) {
      (void)work->stage->look({}, work->positions);
      add_samples(*work, share, random, samples);
    }
    stages.push_back(train(samples, params, {}));
    std::printf("stage %zu: %zu samples, trained to %.2f, %.0f s\n", s + 1, samples.size(),
                mean_error(stages.back(), samples), seconds());
    for (const auto& work : works) apply(*work, stages.back());
    for (const auto& work : held_out) {
      (void)work->stage->look({}, work->positions);
      apply(*work, stages.back());
    }
    const double after = mean_held_out();
    std::printf("held out: %.2f -> %.2f\n", before, after);
    before = after;
    std::fflush(stdout);
  }
  std::FILE* file = std::fopen(argv[1], "w");
  std::fprintf(file, "constexpr std::array<FusionNetwork, %zu> %s{{\n", stages.size(),
               kind == "camera" ? "kCameraStages" : "kWhiteStages");
  for (const FusionNetwork& network : stages) write(file, network);
  std::fprintf(file, "}};\n");
  std::fclose(file);
  return 0;
}

}  // namespace
}  // namespace burnish::training

int main(int argc, char** argv) {
  return burnish::training::run(argc, argv);
}
