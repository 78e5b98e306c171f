// Damaged files, and files that claim more than they hold: a sound result or an error that names
// the file and the place.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "burnish/core/triangle_mesh.h"
#include "samples.h"
#include "support/peak_memory.h"

namespace burnish {
namespace {

/// Everything that a file that was read must be.
void expect_sound(const GeometryFile& file) {
  if (file.grid) {
    EXPECT_TRUE(check(PointCloud{file.mesh.positions, file.mesh.attributes, file.grid,
                                 file.viewpoint, file.mesh.frame}));
  } else {
    EXPECT_TRUE(check(file.mesh));
  }
  EXPECT_TRUE(is_finite(file.mesh.frame.origin));
}

void expect_clear(const Error& error, const std::string& name) {
  EXPECT_FALSE(error.message.empty());
  EXPECT_NE(error.where.find(name), std::string::npos) << error.text();
}

struct Sample {
  std::string format, label, bytes;
};

std::string written(const std::string& extension, bool ascii) {
  const test::TemporaryFolder folder;
  const auto path = folder / ("sample" + extension);
  TriangleMesh mesh = test::any_mesh(1, 9, 12);
  mesh.attributes = test::any_attributes(1, 9);
  mesh.triangle_attributes = test::any_triangle_attributes(1, 12, 9);
  if (extension == ".pcd") {
    PointCloud cloud{mesh.positions, mesh.attributes, GridSize{3, 3}, Vec3d{0, 0, 1}, {}};
    EXPECT_TRUE(write_cloud(path, cloud, {ascii, {}}));
  } else {
    EXPECT_TRUE(write_mesh(path, mesh, {ascii, {}}));
  }
  return test::slurp(path);
}

std::string compressed_pcd() {
  std::string bytes =
      "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 2\nPOINTS 4\n"
      "DATA binary_compressed\n";
  // Four literal zeros, then a run of 44 that repeats them.
  const std::string packed("\x03\0\0\0\0\xe0\x23\x03", 8);
  for (const char c : {8, 0, 0, 0, 48, 0, 0, 0}) bytes += c;
  return bytes + packed;
}

std::vector<Sample> samples() {
  return {{"ply", "binary", written(".ply", false)},
          {"ply", "ascii", written(".ply", true)},
          {"obj", "", written(".obj", true)},
          {"stl", "binary", written(".stl", false)},
          {"stl", "ascii", written(".stl", true)},
          {"off", "", written(".off", true)},
          {"pcd", "binary", written(".pcd", false)},
          {"pcd", "ascii", written(".pcd", true)},
          {"pcd", "compressed", compressed_pcd()},
          {"xyz", "", "# points\n0 0 0 1 0 0\n1 0 0 1 0 0\n0,5;0 0 1 0\n"},
          {"ply", "strips",
           "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double "
           "y\nproperty double z\n"
           "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 "
           "1 0\n1 1 0\n"
           "5 0 1 2 3 -1\n"},
          {"ply", "polygons with values",
           "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
           "float z\nelement face 3\nproperty uchar origin\nproperty list uchar uint vertex_index\n"
           "property uint owner\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 4 0 1 2 3 3\n"
           "0 2 0 1 1\n1 3 0 1 2 0\n"}};
}

TEST(Truncation, AtEveryByteGivesASoundResultOrAClearError) {
  for (const Sample& sample : samples()) {
    const auto whole = test::parse(sample.format, sample.bytes);
    ASSERT_TRUE(whole) << sample.format << sample.label << ": " << whole.error().text();
    for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
      SCOPED_TRACE(sample.format + " " + sample.label + ", " + std::to_string(size) + " bytes");
      // A buffer of exactly this size, so that a sanitizer sees a read beyond it.
      const std::vector<char> part(sample.bytes.begin(),
                                   sample.bytes.begin() + static_cast<std::ptrdiff_t>(size));
      const auto file = test::parse(sample.format, {part.data(), part.size()});
      if (file) {
        expect_sound(*file);
      } else {
        expect_clear(file.error(), "sample");
      }
    }
  }
}

TEST(Damage, OfOneByteGivesASoundResultOrAClearError) {
  Random random(1);
  for (const Sample& sample : samples()) {
    for (int i = 0; i < 2000; ++i) {
      std::string bytes = sample.bytes;
      const std::size_t at = random.below(bytes.size());
      bytes[at] = static_cast<char>(random.next());
      const auto file = test::parse(sample.format, bytes);
      if (file) {
        expect_sound(*file);
      } else {
        expect_clear(file.error(), "sample");
      }
    }
  }
}

TEST(Claim, OfFourBillionElementsIsRefusedAtOnce) {
  const std::string ply =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n"
      "property float y\nproperty float z\nend_header\n";
  const std::string faces =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
      "z\n"
      "element face 4000000000\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n";
  std::string stl(80, ' ');
  stl += "\xff\xff\xff\xee";
  const std::string pcd =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 4000000000\nHEIGHT 1\n"
      "POINTS 4000000000\nDATA ";
  const std::vector<Sample> claims{{"ply", "vertices", ply},
                                   {"ply", "faces", faces},
                                   {"stl", "", stl},
                                   {"off", "", "OFF\n4000000000 4000000000 0\n0 0 0\n"},
                                   {"pcd", "ascii", pcd + "ascii\n0 0 0\n"},
                                   {"pcd", "binary", pcd + "binary\n"},
                                   {"pcd", "compressed", pcd + "binary_compressed\n12345678"}};
  for (const Sample& claim : claims) {
    const auto start = std::chrono::steady_clock::now();
    const auto file = test::parse(claim.format, claim.bytes);
    const auto spent = std::chrono::steady_clock::now() - start;
    ASSERT_FALSE(file) << claim.format << " " << claim.label;
    expect_clear(file.error(), "sample");
    EXPECT_LT(spent, std::chrono::milliseconds(100)) << claim.format << " " << claim.label;
  }
}

TEST(Claim, OfAListLongerThanTheFileIsRefused) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
      "z\n"
      "element face 1\nproperty list uint int vertex_indices\nend_header\n0 0 0\n";
  EXPECT_FALSE(test::parse("ply", head + "4000000000 0 0 0\n"));
  EXPECT_FALSE(test::parse("ply", head + "-3 0 0 0\n"));
  EXPECT_FALSE(test::parse("off", "OFF\n1 1 0\n0 0 0\n4000000000 0 0\n"));
}

TEST(OddFiles, GiveASoundResultOrAClearError) {
  BURNISH_DATA_OR_SKIP(odd, "odd");
  std::size_t read = 0;
  std::size_t refused = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(odd)) {
    if (!entry.is_regular_file()) continue;
    SCOPED_TRACE(entry.path().string());
    const auto file = read_geometry(entry.path());
    if (file) {
      expect_sound(*file);
      ++read;
    } else {
      expect_clear(file.error(), entry.path().filename().string());
      ++refused;
    }
  }
  EXPECT_GT(read, 100u);
  EXPECT_GT(refused, 10u);
}

std::size_t peak_memory_of_reading(const std::filesystem::path& path) {
  SCOPED_TRACE(path.string());
  return test::peak_memory_of([&] { return read_geometry(path).has_value(); });
}

/// Facets none of whose corners are shared.
std::string binary_stl(std::uint32_t facets) {
  std::string bytes(80, ' ');
  bytes.append(reinterpret_cast<const char*>(&facets), sizeof(facets));
  for (std::uint32_t f = 0; f < facets; ++f) {
    std::array<float, 12> numbers{};
    for (std::size_t k = 3; k < numbers.size(); ++k) numbers[k] = static_cast<float>(f * 9 + k);
    bytes.append(reinterpret_cast<const char*>(numbers.data()), sizeof(numbers));
    bytes.append(2, '\0');
  }
  return bytes;
}

/// The two sizes of binary_compressed and `size` zeros: one literal, then runs of 264 at most.
std::string compressed_zeros(std::uint32_t size) {
  std::string packed("\0\0", 2);
  for (std::uint32_t done = 1; done < size;) {
    const std::uint32_t run = std::min<std::uint32_t>(264, size - done);
    if (run < 9) {
      packed += static_cast<char>(run - 1);
      packed.append(run, '\0');
    } else {
      packed += static_cast<char>(0xe0);
      packed += static_cast<char>(run - 9);
      packed += '\0';
    }
    done += run;
  }
  const std::array<std::uint32_t, 2> sizes{static_cast<std::uint32_t>(packed.size()), size};
  return std::string(reinterpret_cast<const char*>(sizes.data()), sizeof(sizes)) + packed;
}

TEST(Memory, StaysWithinItsBound) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers have memory of their own";
#endif
  const test::TemporaryFolder folder;
  const auto repeated = [](const std::string& text, std::size_t count) {
    std::string all;
    all.reserve(text.size() * count);
    for (std::size_t i = 0; i < count; ++i) all += text;
    return all;
  };
  // The files that ask for the most memory per byte. They are small, to be quick, and so is the
  // allowance, so that it does not hide what grows with the file.
  constexpr std::size_t kRows = 250000;
  constexpr std::size_t kAllowance = std::size_t{16} << 20;
  const std::string vertices = "ply\nformat ascii 1.0\nelement vertex ";
  const std::string pcd = "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";
  const std::string fields = "\nproperty double x\nproperty double y\nproperty double z\n";
  const std::vector<std::pair<std::string, std::string>> files{
      {"short.xyz", repeated("0 0 0\n", 4 * kRows)},
      {"columns.xyz", repeated("0 0 0 5 5 5 5 5\n", 3 * kRows / 2)},
      {"short.obj", repeated("v 0 0 0\n", 2 * kRows) + repeated("f 1 2 3\n", kRows)},
      {"colors.obj", repeated("v 0 0 0 1 1 1\n", 2 * kRows)},
      {"polygons.obj", repeated("v 0 0 0\n", 10) + repeated("f 1 2 3 4 5 6 7 8 9\n", 300000)},
      {"short.off",
       "OFF\n500000 250000 0\n" + repeated("0 0 0\n", 2 * kRows) + repeated("3 0 1 2\n", kRows)},
      {"short.ply",
       vertices + "1000000" + fields + "end_header\n" + repeated("0 0 0\n", 4 * kRows)},
      {"far.ply", vertices + "750000" + fields + "end_header\n" + repeated("9e9 0 0\n", 3 * kRows)},
      {"polygons.ply",
       "ply\nformat binary_little_endian 1.0\nelement vertex 10\nproperty char x\nproperty char y\n"
       "property char z\nelement face 600000\nproperty list uchar uchar "
       "vertex_indices\nend_header\n" +
           std::string(30, '\0') + repeated("\x09\x01\x02\x03\x04\x05\x06\x07\x08\x09", 600000)},
      {"owned.ply",
       "ply\nformat binary_little_endian 1.0\nelement vertex 10\nproperty char x\nproperty char y\n"
       "property char z\nelement face 500000\nproperty list uchar uchar vertex_indices\nproperty "
       "uchar origin\nproperty uint owner\nend_header\n" +
           std::string(30, '\0') +
           repeated(std::string("\x06\x01\x02\x03\x04\x05\x06\x02\x09\0\0\0", 12), 500000)},
      {"short.stl", "solid\n" +
                        repeated("facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\n"
                                 "vertex 0 1 0\nendloop\nendfacet\n",
                                 kRows / 2) +
                        "endsolid\n"},
      {"binary.stl", binary_stl(kRows / 2)},
      {"short.pcd", pcd + "WIDTH 1000000\nHEIGHT 1\nPOINTS 1000000\nDATA ascii\n" +
                        repeated("0 0 0\n", 4 * kRows)},
      {"binary.pcd", pcd + "WIDTH 750000\nHEIGHT 1\nPOINTS 750000\nDATA binary\n" +
                         std::string(12 * 3 * kRows, '\0')},
      {"strips.ply", vertices + "4" + fields +
                         "element tristrips 300000\nproperty list int int vertex_indices\n"
                         "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" +
                         repeated("6 0 1 2 3 0 1\n", 300000)}};
  for (const auto& [name, bytes] : files) {
    const auto path = folder / name;
    std::ofstream(path, std::ios::binary) << bytes;
    EXPECT_LE(peak_memory_of_reading(path), kAllowance + 8 * bytes.size()) << name;
    std::filesystem::remove(path);
  }
  // What a compressed file unpacks to does not depend on its size: the whole allowance is its.
  constexpr std::size_t kWholeAllowance = std::size_t{64} << 20;
  const std::string compressed =
      pcd + "WIDTH 2000000\nHEIGHT 1\nPOINTS 2000000\nDATA binary_compressed\n" +
      compressed_zeros(12 * 8 * kRows);
  std::ofstream(folder / "compressed.pcd", std::ios::binary) << compressed;
  EXPECT_LE(peak_memory_of_reading(folder / "compressed.pcd"),
            kWholeAllowance + 8 * compressed.size());
}

}  // namespace
}  // namespace burnish
