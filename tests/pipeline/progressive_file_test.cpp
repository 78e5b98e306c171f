// The progressive file: what was written comes back to the bit, at every level, and nothing else.
#include "burnish/pipeline/progressive_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "burnish/adaptation/point_removal.h"
#include "burnish/io/crc32.h"
#include "burnish/io/geometry_file.h"
#include "burnish/shapes/shapes.h"
#include "io/samples.h"
#include "support/peak_memory.h"
#include "support/plain_removals.h"
#include "support/progress.h"
#include "support/progressive_promises.h"
#include "support/random_mesh.h"

namespace burnish {
namespace {

struct Sample {
  std::string name;
  TriangleMesh mesh;
  std::vector<Removal> removals;
};

Sample sample_of(const std::string& name, TriangleMesh mesh, std::uint64_t seed = 1,
                 double share = 1) {
  const auto count = static_cast<std::size_t>(share * static_cast<double>(mesh.positions.size()));
  std::vector<Removal> removals = test::random_removals(mesh, count, seed);
  return {name, std::move(mesh), std::move(removals)};
}

TriangleMesh with_everything(TriangleMesh mesh, std::uint64_t seed) {
  mesh.attributes = test::any_attributes(seed, mesh.positions.size());
  mesh.triangle_attributes =
      test::any_triangle_attributes(seed, mesh.triangles.size(), mesh.positions.size());
  mesh.frame.origin = {4.5e6, -1.25, 0.1};
  return mesh;
}

/// Vertices and triangles in another order, triangles begun at another corner.
TriangleMesh shuffled(const TriangleMesh& mesh, std::uint64_t seed) {
  Random random(seed);
  const auto permutation = [&](std::size_t count) {
    std::vector<std::uint32_t> order(count);
    for (std::uint32_t i = 0; i < count; ++i) order[i] = i;
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    return order;
  };
  const std::vector<std::uint32_t> vertices = permutation(mesh.positions.size());
  TriangleMesh result = mesh;
  for (std::size_t v = 0; v < vertices.size(); ++v)
    result.positions[vertices[v]] = mesh.positions[v];
  keep_triangles(result, permutation(mesh.triangles.size()));
  for (Triangle& triangle : result.triangles) {
    for (std::uint32_t& v : triangle) v = vertices[v];
    const auto turn = static_cast<std::ptrdiff_t>(random.below(3));
    std::rotate(triangle.begin(), triangle.begin() + turn, triangle.end());
  }
  return result;
}

/// Spheres, a grid with a boundary, loose and odd triangles, unused vertices, in one mesh.
TriangleMesh motley_mesh(std::uint64_t seed, int size) {
  TriangleMesh mesh;
  const auto add = [&](const TriangleMesh& part) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
    for (const auto& [a, b, c] : part.triangles)
      mesh.triangles.push_back({a + first, b + first, c + first});
  };
  add(make_sphere(1, size));
  add(make_grid(3 * size, 2 * size));
  add(test::random_mesh(12, 20, seed));
  add(make_uv_sphere(1, 36, 2));  // poles whose stars are larger than a mask tells
  add(make_grid(1, 1));
  mesh.triangles.push_back({0, 5, 70});
  mesh.triangles.push_back(mesh.triangles[3]);
  mesh.triangles.push_back({7, 7, 9});
  return shuffled(mesh, seed);
}

/// Every kind of mesh and attribute.
std::vector<Sample> samples() {
  std::vector<Sample> all;
  all.push_back(sample_of("sphere", make_sphere(1, 3)));
  all.push_back(sample_of("open grid", make_grid(12, 9)));
  all.push_back(
      sample_of("torus, everything known", with_everything(make_torus(1, 0.4, 16, 8), 3)));
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    all.push_back(sample_of("motley " + std::to_string(seed),
                            with_everything(motley_mesh(seed, 2), seed), seed, 0.15 * seed));
  }
  all.push_back(sample_of("nothing", {}));
  all.push_back(sample_of("points", {{{1, 2, 3}, {4, 5, 6}}, {}, {}, {}, {}}));
  Sample untouched = sample_of("nothing removed", make_sphere(1, 1), 1, 0);
  untouched.mesh.attributes.channels = {{"empty", std::vector<double>{}},
                                        {"", std::vector<std::int8_t>(42)}};
  all.push_back(std::move(untouched));
  return all;
}

/// Some of them, small enough to be read at each of their bytes.
std::vector<Sample> small_samples() {
  return {sample_of("sphere", make_sphere(1, 1)), sample_of("open grid", make_grid(7, 6)),
          sample_of("motley", with_everything(motley_mesh(1, 1), 1)),
          sample_of("nothing removed", with_everything(make_sphere(1, 0), 1), 1, 0),
          sample_of("nothing", {})};
}

std::string written(const Sample& sample) {
  const test::TemporaryFolder folder;
  const auto report = write_progressive(folder / "mesh.bpm", sample.mesh, sample.removals);
  EXPECT_TRUE(report) << report.error().text();
  const std::string bytes = test::slurp(folder / "mesh.bpm");
  EXPECT_EQ(report ? report->bytes : 0, bytes.size());
  return bytes;
}

Result<ProgressiveLevel> parsed(std::string_view bytes, const ProgressiveStop& stop = {}) {
  // A buffer of exactly this size, so that a sanitizer sees a read beyond it.
  const std::vector<char> exact(bytes.begin(), bytes.end());
  return parse_progressive({exact.data(), exact.size()}, "sample", stop);
}

/// An error of a damaged file names the file and the byte.
void expect_place(const Error& error) {
  EXPECT_FALSE(error.message.empty());
  EXPECT_NE(error.where.find("sample, byte "), std::string::npos) << error.text();
}

/// What the removals leave of a mesh; of owners nothing, unless nothing is removed.
TriangleMesh after_removals(const TriangleMesh& mesh, std::span<const Removal> removals) {
  if (removals.empty()) return mesh;
  test::PlainRemovals plain(mesh);
  for (const Removal& removal : removals) plain.remove(removal.vertex, removal.into);
  return plain.mesh();
}

/// A file of the same mesh that ends behind record `records`.
ProgressiveLevel level_after(const Sample& sample, std::size_t records) {
  const std::span<const Removal> left(sample.removals.data(), sample.removals.size() - records);
  ProgressiveLevel level;
  level.mesh = after_removals(sample.mesh, left);
  level.error = left.empty() ? 0 : left.back().error;
  level.records = records;
  return level;
}

TEST(ProgressiveFile, GivesTheOriginalBack) {
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    const auto level = parsed(written(sample));
    ASSERT_TRUE(level) << level.error().text();
    EXPECT_TRUE(level->original);
    EXPECT_EQ(level->records, sample.removals.size());
    EXPECT_EQ(level->error, 0);
    EXPECT_TRUE(level->notes.empty());
    EXPECT_TRUE(level->mesh == sample.mesh);
    EXPECT_TRUE(test::same_bits(level->mesh.positions, sample.mesh.positions));
    EXPECT_TRUE(test::same_bits(level->mesh.attributes.noise, sample.mesh.attributes.noise));
  }
}

TEST(ProgressiveFile, HasSamplesThatAreMuchReduced) {
  for (const Sample& sample : samples()) {
    const std::size_t vertices = sample.mesh.positions.size();
    if (sample.name == "sphere" || sample.name == "open grid") {
      EXPECT_GT(sample.removals.size(), vertices * 8 / 10) << sample.name;
    }
    if (sample.name.starts_with("motley")) {
      EXPECT_GT(sample.removals.size(), vertices / 10) << sample.name;
    }
  }
}

TEST(ProgressiveFile, OpensAtTheEndOfEveryRecordAndNowhereElse) {
  for (const Sample& sample : small_samples()) {
    SCOPED_TRACE(sample.name);
    const std::string bytes = written(sample);
    std::size_t opened = 0;
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      const auto level = parsed(std::string_view(bytes).substr(0, size));
      if (!level) {
        expect_place(level.error());
        continue;
      }
      ASSERT_LE(opened, sample.removals.size());
      const ProgressiveLevel expected = level_after(sample, opened++);
      EXPECT_TRUE(check(level->mesh));
      EXPECT_TRUE(level->mesh == expected.mesh) << size;
      EXPECT_EQ(level->error, expected.error);
      EXPECT_EQ(level->records, expected.records);
      EXPECT_EQ(level->bytes_read, size);
      EXPECT_FALSE(level->notes.empty());
    }
    EXPECT_EQ(opened, sample.removals.size() + 1);  // the coarse mesh is one more
  }
}

TEST(ProgressiveFile, RefusesEveryChangeOfAByteWithItsPlace) {
  Random random(1);
  for (const Sample& sample : small_samples()) {
    SCOPED_TRACE(sample.name);
    const std::string bytes = written(sample);
    for (int i = 0; i < 2000; ++i) {
      std::string changed = bytes;
      const std::size_t at = random.below(bytes.size());
      const auto flip = static_cast<int>(1 + random.below(255));
      changed[at] = static_cast<char>(changed[at] ^ flip);
      const auto level = parsed(changed);
      ASSERT_FALSE(level) << "byte " << at;
      expect_place(level.error());
    }
    EXPECT_FALSE(parsed(bytes + '\0'));
  }
}

/// The bytes with checks that agree, where `ends` are the ends of the levels.
std::string with_checks(std::string bytes, const std::vector<std::size_t>& ends) {
  Crc32 crc;
  std::size_t done = 0;
  const auto set = [&](std::size_t end, std::size_t size) {
    crc.add(bytes.data() + done, end - size - done);
    done = end - size;
    const std::uint32_t value = crc.value();
    std::memcpy(bytes.data() + done, &value, size);
  };
  for (const std::size_t end : ends) set(end, end == ends.front() || end == bytes.size() ? 4 : 2);
  return bytes;
}

TEST(ProgressiveFile, GivesASoundMeshOrAnErrorWhereChangedBytesHaveAgreeingChecks) {
  Random random(1);
  for (const Sample& sample : small_samples()) {
    SCOPED_TRACE(sample.name);
    const std::string bytes = written(sample);
    std::vector<std::size_t> ends;
    for (std::size_t i = 0; i <= sample.removals.size(); ++i) {
      const std::uint64_t wanted = level_after(sample, i).mesh.triangles.size();
      const auto level = parsed(bytes, {.triangles = wanted, .error = {}});
      ASSERT_TRUE(level);
      ends.push_back(level->bytes_read);
    }
    if (sample.removals.empty() || ends.back() != bytes.size()) ends.push_back(bytes.size());
    ASSERT_EQ(with_checks(bytes, ends), bytes);
    for (int i = 0; i < 2000; ++i) {
      std::string changed = bytes;
      changed[random.below(bytes.size())] = static_cast<char>(random.next());
      changed = with_checks(changed, ends);
      const std::vector<char> exact(changed.begin(), changed.end());
      test::expect_progressive_promises_kept({exact.data(), exact.size()});
    }
  }
}

TEST(ProgressiveFile, ReadsTheFinestLevelOfSoManyTriangles) {
  const Sample sample = sample_of("grid", make_grid(9, 9));  // splits of one triangle and of two
  const std::string bytes = written(sample);
  std::size_t records = 0;
  for (std::uint64_t wanted = 0; wanted <= sample.mesh.triangles.size() + 1; ++wanted) {
    while (records < sample.removals.size() &&
           level_after(sample, records + 1).mesh.triangles.size() <= wanted) {
      ++records;
    }
    const auto level = parsed(bytes, {.triangles = wanted, .error = {}});
    ASSERT_TRUE(level) << level.error().text();
    EXPECT_EQ(level->records, records) << wanted;
    EXPECT_TRUE(level->mesh == level_after(sample, records).mesh) << wanted;
  }
  EXPECT_EQ(records, sample.removals.size());
}

TEST(ProgressiveFile, ReadsTheCoarsestLevelOfAnError) {
  const Sample sample = sample_of("sphere", make_sphere(1, 1));
  const std::string bytes = written(sample);
  std::vector<double> errors{0, 1e-9, 1};
  for (const Removal& removal : sample.removals) errors.push_back(removal.error);
  for (const double error : errors) {
    std::size_t records = 0;
    while (level_after(sample, records).error > error) ++records;
    const auto level = parsed(bytes, {.triangles = {}, .error = error});
    ASSERT_TRUE(level) << level.error().text();
    EXPECT_EQ(level->records, records) << error;
  }
  EXPECT_FALSE(parsed(bytes, {.triangles = {}, .error = -1}));
  EXPECT_FALSE(parsed(bytes, {.triangles = {}, .error = std::nan("")}));
}

TEST(ProgressiveFile, GivesWhatLiesBeforeTheDamage) {
  const Sample sample = sample_of("sphere", make_sphere(1, 2));
  const std::string bytes = written(sample);
  const auto half = parsed(bytes, {.triangles = 150, .error = {}});
  ASSERT_TRUE(half);
  std::string damaged = bytes;
  damaged[half->bytes_read + 5] ^= 1;
  const auto all = parsed(damaged);
  ASSERT_FALSE(all);
  const std::string offer = std::to_string(half->mesh.triangles.size()) + " triangles can be had";
  EXPECT_NE(all.error().message.find(offer), std::string::npos) << all.error().text();
  const auto again = parsed(damaged, {.triangles = half->mesh.triangles.size(), .error = {}});
  ASSERT_TRUE(again) << again.error().text();
  EXPECT_TRUE(again->mesh == half->mesh);
}

TEST(ProgressiveFile, GivesTheRemovalsBack) {
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    const test::TemporaryFolder folder;
    ASSERT_TRUE(write_progressive(folder / "mesh.bpm", sample.mesh, sample.removals));
    const auto content = read_progressive_all(folder / "mesh.bpm");
    ASSERT_TRUE(content) << content.error().text();
    EXPECT_TRUE(content->level.mesh == sample.mesh);
    EXPECT_EQ(content->removals, sample.removals);
  }
}

TEST(ProgressiveFile, GivesTheRemovalsOfWhatThereIsOfIt) {
  const Sample sample = sample_of("torus", make_torus(1, 0.4, 16, 8));
  const std::string bytes = written(sample);
  const auto half = parsed(bytes, {.triangles = 150, .error = {}});
  ASSERT_TRUE(half);
  const test::TemporaryFolder folder;
  std::ofstream(folder / "half.bpm", std::ios::binary) << bytes.substr(0, half->bytes_read);
  const auto content = read_progressive_all(folder / "half.bpm");
  ASSERT_TRUE(content) << content.error().text();
  EXPECT_TRUE(content->level.mesh == half->mesh);
  EXPECT_TRUE(after_removals(content->level.mesh, content->removals) ==
              level_after(sample, 0).mesh);
}

TEST(ProgressiveFile, IsSmallerThanThePlyOfTheOriginal) {
  const test::TemporaryFolder folder;
  const auto expect_smaller = [&](const Sample& sample) {
    ASSERT_TRUE(write_mesh(folder / "mesh.ply", sample.mesh));
    const auto report = write_progressive(folder / "mesh.bpm", sample.mesh, sample.removals);
    ASSERT_TRUE(report);
    const std::string ply = test::slurp(folder / "mesh.ply");
    EXPECT_LT(report->bytes, ply.size()) << sample.name;
    EXPECT_EQ(report->ply_bytes, ply.size() - ply.find("end_header\n") - 11) << sample.name;
  };
  for (const Sample& sample : small_samples()) expect_smaller(sample);
  expect_smaller(sample_of("in no order", shuffled(make_torus(1, 0.4, 100, 60), 1)));
  expect_smaller(sample_of("large stars", make_uv_sphere(1, 300, 4)));
}

TEST(ProgressiveFile, IsReadInProportionToTheLevel) {
  const Sample sample = sample_of("torus", make_torus(1, 0.4, 100, 60));
  const std::string bytes = written(sample);
  for (std::uint64_t wanted = 4000; wanted <= 12000; wanted *= 2) {
    const auto level = parsed(bytes, {.triangles = wanted, .error = {}});
    ASSERT_TRUE(level);
    // A row of 12 bytes and at most 26 of record per vertex, and the head.
    EXPECT_LT(level->bytes_read, 38 * level->mesh.positions.size() + 100);
  }
}

TEST(ProgressiveFile, TakesFortyBytesATriangleBesidesTheLevel) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers have memory of their own";
#endif
  const TriangleMesh mesh = make_torus(1, 0.4, 300, 200);
  const auto removals = removal_log(mesh);
  ASSERT_TRUE(removals);
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_progressive(folder / "mesh.bpm", mesh, *removals));
  // What a process has once, large pages rounded up among it, does not grow with the level.
  constexpr std::size_t kAllowance = std::size_t{3} << 20;
  for (const std::uint64_t triangles : {60000, 120000}) {
    const ProgressiveStop stop{triangles, {}};
    const std::size_t peak = test::peak_memory_of(
        [&] { return read_progressive(folder / "mesh.bpm", stop).has_value(); });
    const std::size_t level = triangles * sizeof(Triangle) + triangles / 2 * sizeof(Vec3f);
    EXPECT_LE(peak, kAllowance + level + 40 * triangles);
  }
}

TEST(ProgressiveFile, RefusesWhatIsNoLogOfRemovals) {
  const TriangleMesh mesh = make_sphere(1, 1);
  const test::TemporaryFolder folder;
  const auto [a, b, c] = mesh.triangles[0];
  std::uint32_t far = 0;
  for (const Triangle& triangle : mesh.triangles) {
    if (std::count(triangle.begin(), triangle.end(), a) == 0) far = triangle[0];
  }
  for (const Triangle& triangle : mesh.triangles) {
    if (std::count(triangle.begin(), triangle.end(), a) > 0 &&
        std::count(triangle.begin(), triangle.end(), far) > 0)
      GTEST_FAIL() << "the test's vertices are neighbours";
  }
  const float nan = std::nanf("");
  const std::vector<std::vector<Removal>> logs{{{a, a, 0}},
                                               {{a, far, 0}},
                                               {{42, a, 0}},
                                               {{a, 42, 0}},
                                               {{a, b, -1}},
                                               {{a, b, nan}},
                                               {{a, b, 1}, {a, c, 1}},
                                               {{a, b, 1}, {c, a, 1}},
                                               {{a, b, 1}, {c, b, 0.5}}};
  for (const auto& log : logs) {
    const auto report = write_progressive(folder / "mesh.bpm", mesh, log);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::invalid_argument);
    EXPECT_NE(report.error().message.find("removal " + std::to_string(log.size() - 1)),
              std::string::npos)
        << report.error().text();
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  TriangleMesh broken = mesh;
  broken.triangles[0][0] = 42;
  EXPECT_FALSE(write_progressive(folder / "mesh.bpm", broken, {}));
}

TEST(ProgressiveFile, LeavesNothingBehindWhenItIsCancelled) {
  const Sample sample = sample_of("torus", make_torus(1, 0.4, 160, 60), 1, 0.5);
  const test::TemporaryFolder folder;
  test::ProgressLog log;
  Context context;
  context.sink = &log;
  ASSERT_TRUE(write_progressive(folder / "mesh.bpm", sample.mesh, sample.removals, context));
  ASSERT_TRUE(read_progressive(folder / "mesh.bpm", {}, context));
  EXPECT_EQ(std::count(log.fractions().begin(), log.fractions().end(), 1.0), 2);
  for (const double when : {0.0, 0.5}) {
    test::CancelAt writing(when);
    const auto written =
        write_progressive(folder / "other.bpm", sample.mesh, sample.removals, writing.context());
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::cancelled);
    EXPECT_FALSE(std::filesystem::exists(folder / "other.bpm"));
    test::CancelAt reading(when);
    const auto read = read_progressive(folder / "mesh.bpm", {}, reading.context());
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::cancelled);
  }
}

TEST(ProgressiveFile, ClaimsNothingThatItDoesNotHave) {
  // Four thousand million of everything, and no byte of it.
  std::string claim(
      "\x89"
      "BPM\r\n\x1a\n\x01",
      9);
  for (int i = 0; i < 2; ++i) claim += "\xff\xff\xff\xff\x04";
  claim += std::string("\0", 1);
  claim += "\xff\xff\xff\xff\x04";
  claim.append(28, '\0');
  claim.append(2, '\0');
  claim += std::string("\0\xff\xff\xff\xff\x04", 6);
  const auto level = parsed(claim);
  ASSERT_FALSE(level);
  expect_place(level.error());
  EXPECT_NE(level.error().message.find("bytes are left"), std::string::npos)
      << level.error().text();
}

TEST(ProgressiveFile, EachSeedOfItsFuzzerIsOne) {
  const auto seeds = test::source_folder() / "fuzz" / "seeds" / "progressive";
  for (const auto& entry : std::filesystem::directory_iterator(seeds)) {
    const auto level = parsed(test::slurp(entry.path()));
    EXPECT_TRUE(level) << entry.path() << ": " << level.error().text();
  }
}

TEST(ProgressiveFile, OfTheBunnyIsTheBunny) {
  BURNISH_DATA_OR_SKIP(path, "stanford/bunny_3485v.off");
  auto mesh = read_mesh(path);
  ASSERT_TRUE(mesh);
  const Sample sample = sample_of("bunny", *std::move(mesh));
  EXPECT_GT(sample.removals.size(), sample.mesh.positions.size() / 2);
  const auto level = parsed(written(sample));
  ASSERT_TRUE(level) << level.error().text();
  EXPECT_TRUE(level->mesh == sample.mesh);
}

}  // namespace
}  // namespace burnish
