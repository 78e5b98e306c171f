// Binary PLY against a plain fread and fwrite of the same bytes. The file is in the page cache.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "burnish/base/random.h"
#include "burnish/io/file.h"
#include "burnish/io/geometry_file.h"

namespace {

using namespace burnish;

/// A grid of 1200 x 1200 vertices; `attributes` adds normals, colours, sigma, observations, origin.
TriangleMesh grid_mesh(bool attributes) {
  constexpr std::uint32_t kSide = 1200;
  TriangleMesh mesh;
  Random random(1);
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      mesh.positions.push_back(
          {static_cast<float>(x), static_cast<float>(y), static_cast<float>(random.uniform())});
      if (x == 0 || y == 0) continue;
      const std::uint32_t i = y * kSide + x;
      mesh.triangles.push_back({i - kSide - 1, i - kSide, i});
      mesh.triangles.push_back({i - kSide - 1, i, i - 1});
    }
  }
  if (attributes) {
    const std::size_t count = mesh.positions.size();
    mesh.attributes.normals.assign(count, {0, 0, 1});
    mesh.attributes.colors.assign(count, {1, 2, 3, 255});
    mesh.attributes.sigma.assign(count, 0.001f);
    mesh.attributes.observations.assign(count, 3);
    mesh.attributes.origin.assign(count, Origin::seen);
  }
  return mesh;
}

/// A written mesh, and its path; removed at the end of the program.
struct Sample {
  explicit Sample(bool attributes) : mesh(grid_mesh(attributes)) {
    const std::string name =
        "burnish-benchmark-" + std::to_string(::getpid()) + (attributes ? "-a" : "-p") + ".ply";
    path = std::filesystem::temp_directory_path() / name;
    if (!write_mesh(path, mesh)) std::abort();
    bytes = std::filesystem::file_size(path);
  }
  ~Sample() {
    std::filesystem::remove(path);
    std::filesystem::remove(path.string() + ".copy");
  }
  TriangleMesh mesh;
  std::filesystem::path path;
  std::size_t bytes = 0;
};

const Sample& sample(bool attributes) {
  static const Sample plain(false);
  static const Sample full(true);
  return attributes ? full : plain;
}

void finish(benchmark::State& state, const Sample& file) {
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * file.bytes));
}

void BM_Fread(benchmark::State& state) {
  const Sample& file = sample(state.range(0) != 0);
  for (auto _ : state) {
    std::vector<char> bytes(file.bytes);
    std::FILE* in = std::fopen(file.path.c_str(), "rb");
    if (std::fread(bytes.data(), 1, bytes.size(), in) != bytes.size())
      state.SkipWithError("short read");
    std::fclose(in);
    benchmark::DoNotOptimize(bytes.data());
  }
  finish(state, file);
}

void BM_ReadPly(benchmark::State& state) {
  const Sample& file = sample(state.range(0) != 0);
  for (auto _ : state) {
    const auto mesh = read_mesh(file.path);
    if (!mesh) state.SkipWithError("not read");
    benchmark::DoNotOptimize(mesh->positions.data());
  }
  finish(state, file);
}

/// With fsync, as burnish does it: without, the bytes may be lost when the machine goes down.
void BM_FwriteFsync(benchmark::State& state) {
  const Sample& file = sample(state.range(0) != 0);
  const auto bytes = read_file(file.path);
  const std::string copy = file.path.string() + ".copy";
  for (auto _ : state) {
    std::FILE* out = std::fopen(copy.c_str(), "wb");
    if (std::fwrite(bytes->text().data(), 1, bytes->size(), out) != bytes->size())
      state.SkipWithError("short write");
    std::fflush(out);
    ::fsync(::fileno(out));
    std::fclose(out);
  }
  finish(state, file);
}

void BM_WritePly(benchmark::State& state) {
  const Sample& file = sample(state.range(0) != 0);
  for (auto _ : state) {
    if (!write_mesh(file.path.string() + ".copy.ply", file.mesh))
      state.SkipWithError("not written");
  }
  std::filesystem::remove(file.path.string() + ".copy.ply");
  finish(state, file);
}

// 0: positions and triangles; 1: with normals, colours, sigma, observations and origin.
BENCHMARK(BM_Fread)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_ReadPly)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_FwriteFsync)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(BM_WritePly)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
