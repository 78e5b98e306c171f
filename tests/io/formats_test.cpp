// What each format means, on small files written by hand.
#include <gtest/gtest.h>

#include "burnish/io/faces.h"
#include "burnish/io/lzf.h"
#include "samples.h"

namespace burnish {
namespace {

using test::parse;

GeometryFile sound(std::string_view format, std::string_view text) {
  auto file = parse(format, text);
  EXPECT_TRUE(file) << file.error().text();
  return file ? std::move(*file) : GeometryFile{};
}

std::string problem(std::string_view format, std::string_view text) {
  const auto file = parse(format, text);
  EXPECT_FALSE(file);
  return file ? "" : file.error().text();
}

const std::string kPlyVertices =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kPlyFaces =
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kSquare = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST(Ply, TakesEveryLineEnding) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string text =
        "ply\nformat ascii 1.0\n" + kPlyVertices + kPlyFaces + kSquare + "4 0 1 2 3\n";
    std::string changed;
    for (const char c : text) changed += c == '\n' ? end : std::string(1, c);
    EXPECT_EQ(sound("ply", changed).mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  }
}

TEST(Ply, ReadsBigEndianAsLittleEndian) {
  const std::string head =
      "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty float x\nproperty double y\n"
      "property short z\nproperty uint level\nend_header\n";
  const std::string body("\x3f\xc0\0\0\x40\x04\0\0\0\0\0\0\xff\xfe\0\0\x01\x02", 18);
  const GeometryFile file = sound("ply", head + body);
  EXPECT_EQ(file.mesh.frame.origin + Vec3d(file.mesh.positions.at(0)), (Vec3d{1.5, 2.5, -2}));
  EXPECT_EQ(std::get<std::vector<std::uint32_t>>(file.mesh.attributes.channels.at(0).values)[0],
            258u);
}

TEST(Ply, NamesTheLineOfAShortVertexAndOfAFaceOutOfRange) {
  const std::string head = "ply\nformat ascii 1.0\n" + kPlyVertices + kPlyFaces;
  EXPECT_EQ(problem("ply", head + "0 0 0\n1 0\n1 1 0\n0 1 0\n3 0 1 2\n"),
            "sample, line 11: vertex 1 of 4 has too few numbers");
  EXPECT_EQ(problem("ply", head + kSquare + "3 0 1 4\n"),
            "sample, line 14: face 0 names vertex 4 of 4 (counted from 0)");
}

TEST(Ply, ReadsStripsThatTurn) {
  const std::string text =
      "ply\nformat ascii 1.0\n" + kPlyVertices +
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" + kSquare +
      "8 0 1 3 2 -1 3 2 1\n";
  EXPECT_EQ(sound("ply", text).mesh.triangles,
            (std::vector<Triangle>{{0, 1, 3}, {3, 1, 2}, {3, 2, 1}}));
}

/// A header for the square's four vertices and `faces` faces with these properties.
std::string square_with_faces(int faces, const std::string& properties) {
  return "ply\nformat ascii 1.0\n" + kPlyVertices + "element face " + std::to_string(faces) + "\n" +
         properties + "end_header\n" + kSquare;
}
const std::string kIndices = "property list uchar int vertex_indices\n";
const std::string kOrigin = "property uchar origin\n";
const std::string kOwner = "property uint owner\n";

TEST(Ply, HandsTheValuesOfAFaceToEveryTriangleItIsCutInto) {
  const TriangleAttributes expected{
      {Origin::invented, Origin::invented, Origin::interpolated, Origin::seen}, {3, 3, 0, 1}};
  const auto read = [](const std::string& text) {
    const GeometryFile file = sound("ply", text);
    EXPECT_EQ(file.notes.size(), 1u);  // on the face of two corners
    return file.mesh.triangle_attributes;
  };
  // A square, a face of two corners that is left out, and two triangles; the second order of
  // properties is none that is read in a fast way.
  EXPECT_EQ(read(square_with_faces(4, kIndices + kOrigin + kOwner) +
                 "4 0 1 2 3 2 3\n2 0 1 2 2\n3 0 1 2 1 0\n3 0 2 3 0 1\n"),
            expected);
  EXPECT_EQ(read(square_with_faces(4, kOwner + kIndices + kOrigin) +
                 "3 4 0 1 2 3 2\n2 2 0 1 2\n0 3 0 1 2 1\n1 3 0 2 3 0\n"),
            expected);
}

TEST(Ply, ReadsTheValuesOfBigEndianFaces) {
  const std::string head =
      "ply\nformat binary_big_endian 1.0\nelement vertex 300\nproperty char x\nproperty char y\n"
      "property char z\nelement face 2\n" +
      kOwner + kIndices + kOrigin + "end_header\n" + std::string(900, '\1');
  const std::string rows(
      "\0\0\1\2\3\0\0\0\0\0\0\0\1\0\0\0\2\2"
      "\0\0\0\5\3\0\0\0\2\0\0\0\1\0\0\0\0\1",
      36);
  const TriangleMesh mesh = sound("ply", head + rows).mesh;
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 0}}));
  EXPECT_EQ(mesh.triangle_attributes,
            (TriangleAttributes{{Origin::invented, Origin::interpolated}, {258, 5}}));
}

TEST(Ply, LeavesOutValuesOfFacesThatAreNone) {
  const auto expect_note = [](const std::string& text, const std::string& note) {
    const GeometryFile file = sound("ply", text);
    EXPECT_EQ(file.mesh.triangle_attributes, TriangleAttributes{});
    EXPECT_EQ(file.notes, std::vector<std::string>{note});
  };
  const std::string left_out = "the property 'owner' of faces is left out: ";
  expect_note(square_with_faces(2, kIndices + kOwner) + "3 0 1 2 3\n3 0 2 3 4\n",
              left_out + "4 is none");
  expect_note(square_with_faces(1, kIndices + kOrigin) + "3 0 1 2 3\n",
              "the property 'origin' of faces is left out: 3 is none");
  // The second face element says nothing of its faces.
  expect_note("ply\nformat ascii 1.0\n" + kPlyVertices + "element face 1\n" + kIndices + kOwner +
                  kPlyFaces + kSquare + "3 0 1 2 0\n3 0 2 3\n",
              left_out + "not all faces have one");
  // Of another type it is another program's property.
  expect_note(square_with_faces(1, kIndices + "property int owner\n") + "3 0 1 2 0\n",
              "the property 'owner' of 'face' is left out");
  EXPECT_EQ(problem("ply", square_with_faces(1, kIndices + kOrigin) + "3 0 1 2 256\n"),
            "sample, line 15: '256' in face 0 of 1 is one number too many or none of its type");
}

TEST(Ply, RenumbersOwnersWhereVerticesAreLeftOut) {
  const std::string head = "ply\nformat ascii 1.0\n" + kPlyVertices + "element face 1\n" +
                           kIndices + kOwner + "end_header\n0 0 0\nnan 0 0\n1 1 0\n0 1 0\n";
  const GeometryFile file = sound("ply", head + "3 0 2 3 3\n");
  EXPECT_EQ(file.mesh.triangle_attributes.owner, std::vector<std::uint32_t>{2});
  const GeometryFile missing = sound("ply", head + "3 0 2 3 1\n");
  EXPECT_TRUE(missing.mesh.triangle_attributes.owner.empty());
  EXPECT_EQ(missing.notes.size(), 2u);
}

TEST(Ply, RefusesANonFiniteVertexThatAFaceUsesAndLeavesOutOthers) {
  const std::string head = "ply\nformat ascii 1.0\n" + kPlyVertices + kPlyFaces;
  EXPECT_NE(problem("ply", head + "0 0 0\nnan 0 0\n1 1 0\n0 1 0\n3 0 1 2\n").find("not finite"),
            std::string::npos);
  const GeometryFile file = sound("ply", head + "0 0 0\nnan 0 0\n1 1 0\n0 1 0\n3 0 2 3\n");
  EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(file.notes.size(), 1u);
}

TEST(Ply, KeepsLargeDoublesExactByAnOrigin) {
  const GeometryFile file =
      sound("ply",
            "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
            "property double z\nend_header\n4500000.125 10 0\n4500001.25 11 0\n");
  const Vec3d p = file.mesh.frame.origin + Vec3d(file.mesh.positions[0]);
  EXPECT_EQ(p, (Vec3d{4500000.125, 10, 0}));
}

TEST(Obj, ReadsAllFormsOfFaces) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
  for (const char* face : {"f 1 2 3", "f 1/1 2/1 3/1", "f 1//1 2//1 3//1", "f 1/1/1 2/1/1 3/1/1",
                           "f -4 -3 -2", "f 1 \\\n 2 3 # comment"}) {
    EXPECT_EQ(sound("obj", vertices + face).mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}))
        << face;
  }
  for (const char* bad :
       {"f 0 1 2", "f 1 2 5", "f -5 1 2", "f a b c", "f 1/x 2 3", "f 1//2 2 3", "f 1/1/1/1 2 3"}) {
    EXPECT_NE(problem("obj", vertices + bad).find("line 7"), std::string::npos) << bad;
  }
}

TEST(Obj, LeavesOutNormalsThatDisagree) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//1\n";
  EXPECT_EQ(sound("obj", text).mesh.attributes.normals.size(), 3u);
  const GeometryFile two = sound("obj", text + "f 1//2 2//2 3//2\n");
  EXPECT_TRUE(two.mesh.attributes.normals.empty());
  EXPECT_EQ(two.notes.size(), 1u);
}

TEST(Stl, KnowsBinaryThatBeginsWithSolid) {
  std::string bytes = "solid but binary";
  bytes.resize(84 + 50);
  bytes[80] = 1;
  const float x = 1;
  std::memcpy(bytes.data() + 84 + 12 + 12, &x, 4);
  const GeometryFile file = sound("stl", bytes);
  EXPECT_EQ(file.mesh.positions.size(), 2u);
  EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 0}}));
}

TEST(Stl, RefusesAFileThatStopsBetweenFacets) {
  EXPECT_NE(problem("stl",
                    "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
                    "0\nendloop\nendfacet\n")
                .find("endsolid"),
            std::string::npos);
}

TEST(Off, ReadsColorsOfBothKinds) {
  const auto bytes = sound("off", "COFF 1 0 0\n0 0 0 1 2 3 4\n");
  EXPECT_EQ(bytes.mesh.attributes.colors.at(0), (Color{1, 2, 3, 4}));
  const auto fractions = sound("off", "COFF\n1 0 0\n0 0 0 1.0 0.0 0.2\n");
  EXPECT_EQ(fractions.mesh.attributes.colors.at(0), (Color{255, 0, 51, 255}));
}

TEST(Pcd, ReadsPackedColorsCountsAndPadding) {
  const GeometryFile file =
      sound("pcd",
            "VERSION .7\nFIELDS x y z rgb _ h\nSIZE 4 4 4 4 1 2\nTYPE F F F U U I\n"
            "COUNT 1 1 1 1 2 2\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n"
            "1 2 3 66051 0 0 -5 6\n");
  EXPECT_EQ(file.mesh.attributes.colors.at(0), (Color{1, 2, 3, 255}));
  ASSERT_EQ(file.mesh.attributes.channels.size(), 2u);
  EXPECT_EQ(std::get<std::vector<std::int16_t>>(file.mesh.attributes.channels[0].values)[0], -5);
  EXPECT_FALSE(file.grid);
}

TEST(Xyz, TellsNormalsFromColors) {
  EXPECT_EQ(sound("xyz", "0 0 0 0 0 1\n1 0 0 0.6 0.8 0\n").mesh.attributes.normals.size(), 2u);
  EXPECT_EQ(sound("xyz", "0 0 0 0 0 1\n1 0 0 255 8 0\n").mesh.attributes.colors.at(1),
            (Color{255, 8, 0, 255}));
  EXPECT_EQ(sound("xyz", "x,y,z,w\n0,0,0,7\n").mesh.attributes.channels.at(0).name, "column_4");
  EXPECT_NE(problem("xyz", "0 0 0\n1 1\n").find("line 2"), std::string::npos);
}

TEST(Lzf, RefusesWhatWouldLeaveItsBuffers) {
  const auto unpack = [](std::string_view in, std::size_t size) {
    std::vector<std::byte> out(size);
    return unpack_lzf({reinterpret_cast<const std::byte*>(in.data()), in.size()}, out);
  };
  EXPECT_TRUE(unpack(std::string_view("\x01"
                                      "ab\x20\x01",
                                      5),
                     5));
  EXPECT_FALSE(unpack(std::string_view("\x01"
                                       "ab\x20\x02",
                                       5),
                      5));  // before the beginning
  EXPECT_FALSE(unpack(std::string_view("\x01"
                                       "ab\x20\x01",
                                       5),
                      4));  // beyond the end
  EXPECT_FALSE(unpack(std::string_view("\x01"
                                       "ab\x20\x01",
                                       5),
                      6));  // too little
  EXPECT_FALSE(unpack(std::string_view("\x05"
                                       "ab",
                                       3),
                      6));  // input ends
}

TEST(Polygons, KeepTheirAreaWhateverTheirShape) {
  // A star around the origin with n corners, in a tilted plane; its area is what the shoelace says.
  Random random(3);
  for (std::uint32_t n = 4; n < 60; ++n) {
    std::vector<Vec3f> positions;
    std::vector<std::uint32_t> corners;
    Vec3d area{};
    for (std::uint32_t i = 0; i < n; ++i) {
      const double angle = 2 * 3.14159265358979 * i / n;
      const double radius = random.uniform(0.1, 1);
      positions.push_back(Vec3f(Vec3d{radius * std::cos(angle), radius * std::sin(angle),
                                      0.5 * radius * std::cos(angle)}));
      corners.push_back(i);
    }
    for (std::uint32_t i = 0; i < n; ++i)
      area += cross(Vec3d(positions[i]), Vec3d(positions[(i + 1) % n]));
    TriangleMesh mesh{positions, {}, {}, {}};
    ASSERT_TRUE(triangulate_polygon(positions, corners, mesh.triangles));
    ASSERT_EQ(mesh.triangles.size(), n - 2);
    Vec3d sum{};
    double absolute = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      sum += area_vector(mesh, t);
      absolute += norm(area_vector(mesh, t));
    }
    EXPECT_NEAR(norm(sum - area), 0, 1e-12) << n;
    // Nothing folded over: the areas add up; the plane is met to float rounding only.
    EXPECT_NEAR(absolute, norm(area), 1e-5) << n;
  }
}

TEST(Detection, GoesByTheContentFirst) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "wrong.stl") << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const auto file = read_geometry(folder / "wrong.stl");
  ASSERT_TRUE(file) << file.error().text();
  EXPECT_EQ(file->mesh.triangles.size(), 1u);
  EXPECT_EQ(file->notes.size(), 1u);
  std::ofstream(folder / "plain.off") << "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_TRUE(read_mesh(folder / "plain.off"));
  std::ofstream(folder / "other.doc") << "text";
  EXPECT_EQ(read_geometry(folder / "other.doc").error().code, ErrorCode::unsupported);
}

}  // namespace
}  // namespace burnish
