// Trains the networks of the smoothing `auto`: generates its examples, and writes the weights.
//   train_fusion OUT.inc white|camera [EXAMPLES] [EPOCHS] [SEED]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>

#include "burnish/base/random.h"
#include "burnish/core/edges.h"
#include "burnish/io/geometry_file.h"
#include "examples.h"
#include "network.h"

namespace burnish::training {
namespace {

std::vector<Vec3d> in_double(const std::vector<Vec3f>& positions) {
  return {positions.begin(), positions.end()};
}

/// A noisy mesh on its way through the stages.
struct Work {
  std::vector<Triangle> triangles;
  std::vector<Vec3d> positions;
  std::vector<Vec3f> truth;        // of the faces
  std::vector<Vec3f> first, last;  // normals as it came, after the stage before
  Adjacency around, of_vertices;
  double edge = 1;
  Roughness rough;
};

Work work_of(const Example& example) {
  Work work;
  work.triangles = example.noisy.triangles;
  work.positions = in_double(example.noisy.positions);
  work.truth = face_geometry(in_double(example.clean.positions), work.triangles, 1).normals;
  work.around = faces_around_faces(example.noisy);
  work.of_vertices = triangles_of_vertices(example.noisy);
  work.edge = mean_edge_length(example.noisy);
  return work;
}

void update(Work& work, const std::vector<Vec3f>& normals, int passes) {
  std::vector<Vec3d> next = work.positions;
  std::vector<double> area(work.triangles.size());
  std::vector<Vec3d> centre(work.triangles.size());
  for (int i = 0; i < passes; ++i) {
    for (std::size_t f = 0; f < work.triangles.size(); ++f) {
      const auto [a, b, c] = work.triangles[f];
      const auto& p = work.positions;
      area[f] = norm(cross(p[b] - p[a], p[c] - p[a]));
      centre[f] = (p[a] + p[b] + p[c]) / 3.0;
    }
    for (std::size_t v = 0; v < next.size(); ++v) {
      Vec3d move;
      double weight = 0;
      for (const std::uint32_t f : work.of_vertices.row(v)) {
        const Vec3d n(normals[f]);
        move += (area[f] * dot(n, centre[f] - work.positions[v])) * n;
        weight += area[f];
      }
      next[v] = weight > 0 ? work.positions[v] + move / weight : work.positions[v];
    }
    work.positions = next;
  }
}

double error_of(const std::vector<Vec3f>& normals, const std::vector<Vec3f>& truth) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t f = 0; f < truth.size(); ++f) {
    if (truth[f] == Vec3f{}) continue;
    sum += std::acos(std::clamp(dot(Vec3d(normals[f]), Vec3d(truth[f])), -1.0, 1.0));
    ++count;
  }
  return sum / static_cast<double>(std::max<std::size_t>(count, 1)) * 180 / std::numbers::pi;
}

/// What the network of a stage sees of a mesh. With a network, also what it says.
void stage(Work& work, const FusionNetwork* network, double share, Random& random, Samples* samples) {
  const FaceGeometry faces = face_geometry(work.positions, work.triangles, work.edge);
  NormalCandidates candidates;
  (void)normal_candidates(faces, work.around, {}, candidates);
  if (work.first.empty()) work.rough = roughness(candidates);
  const FusionInput input{&faces, &work.around, &candidates, work.rough, work.first, work.last};
  std::vector<Vec3f> fused(faces.normals.size());
  std::array<float, kFusionInputs> features;
  for (std::size_t f = 0; f < fused.size(); ++f) {
    const FusionFrame frame = fusion_features(input, f, features);
    if (samples != nullptr && random.uniform() < share && work.truth[f] != Vec3f{}) {
      samples->features.insert(samples->features.end(), features.begin(), features.end());
      const Vec3d t(work.truth[f]);
      samples->truth.push_back(Vec3f(Vec3d{dot(t, Vec3d(frame.x)), dot(t, Vec3d(frame.y)), dot(t, Vec3d(frame.z))}));
    }
    if (network != nullptr) fused[f] = fused_normal(*network, features, frame);
  }
  if (network == nullptr) return;
  if (work.first.empty()) work.first = faces.normals;
  work.last = fused;
  update(work, fused, 15);
}

double judge(Work work, const std::vector<FusionNetwork>& stages) {
  Random random(1);
  for (const FusionNetwork& network : stages) stage(work, &network, 0, random, nullptr);
  return error_of(face_geometry(work.positions, work.triangles, 1).normals, work.truth);
}

void write(std::FILE* file, const char* name, const FusionNetwork& network) {
  std::fprintf(file, "inline constexpr FusionNetwork %s{\n", name);
  const auto part = [&](std::span<const float> values) {
    std::fprintf(file, "{");
    for (std::size_t i = 0; i < values.size(); ++i) {
      std::fprintf(file, "%.5gf,%s", static_cast<double>(values[i]), i % 12 == 11 ? "\n" : "");
    }
    std::fprintf(file, "},\n");
  };
  part(network.first);
  part(network.second);
  part(network.last);
  std::fprintf(file, "};\n");
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
    std::vector<Work> works;
    for (const Example& e : kind == "camera" ? camera_examples(n, seed) : white_examples(n, seed)) {
      works.push_back(work_of(e));
    }
    return works;
  };
  std::vector<Work> works = make(count, params.seed), held_out = make(8, params.seed + 1000);
  std::size_t faces = 0;
  for (const Work& work : works) faces += work.truth.size();
  const double share = std::min(1.0, 600000.0 / static_cast<double>(faces));
  std::printf("%zu faces, %.0f s\n", faces, seconds());
  std::vector<FusionNetwork> stages;
  for (int s = 0; s < 2; ++s) {
    Samples samples;
    Random random(params.seed + 7);
    for (Work& work : works) stage(work, nullptr, share, random, &samples);
    stages.push_back(train(samples, params, {}));
    std::printf("stage %d: %zu samples, trained to %.2f, %.0f s\n", s + 1, samples.size(),
                mean_error(stages.back(), samples), seconds());
    for (Work& work : works) stage(work, &stages.back(), 0, random, nullptr);
    double before = 0, after = 0;
    for (const Work& work : held_out) {
      before += error_of(face_geometry(work.positions, work.triangles, 1).normals, work.truth);
      after += judge(work, stages);
    }
    std::printf("held out: %.2f -> %.2f\n", before / static_cast<double>(held_out.size()),
                after / static_cast<double>(held_out.size()));
    std::fflush(stdout);
  }
  std::FILE* file = std::fopen(argv[1], "w");
  write(file, "kFirst", stages[0]);
  write(file, "kSecond", stages[1]);
  std::fclose(file);
#ifdef JUDGE
  for (const auto& [noisy, clean] : std::vector<std::pair<std::string, std::string>>{JUDGE}) {
    const auto a = read_geometry(noisy), b = read_geometry(clean);
    if (!a || !b) { std::printf("cannot read %s\n", noisy.c_str()); continue; }
    Work work = work_of({a->mesh, b->mesh});
    std::printf("%s: %.2f ->", noisy.substr(noisy.size() > 30 ? noisy.size() - 30 : 0).c_str(), error_of(face_geometry(work.positions, work.triangles, 1).normals, work.truth));
    std::printf(" %.2f", judge(work, {stages[0]}));
    std::printf(" %.2f  rough", judge(work, stages));
    Random r(1); stage(work, &stages[0], 0, r, nullptr);
    std::printf(" %.4f %.4f\n", static_cast<double>(work.rough.fine), static_cast<double>(work.rough.coarse));
  }
#endif
  return 0;
}

}  // namespace
}  // namespace burnish::training

int main(int argc, char** argv) { return burnish::training::run(argc, argv); }
