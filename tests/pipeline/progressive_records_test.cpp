// Single vertex splits as bytes, and the order of what they made.
#include "burnish/pipeline/progressive_records.h"

#include <gtest/gtest.h>

#include "burnish/pipeline/grown_mesh.h"

namespace burnish {
namespace {

constexpr OriginalSize kOriginal{20, 20};

/// A square of two triangles and one that names a vertex twice, all at vertex 0.
GrowingMesh three_triangles() {
  GrowingMesh mesh;
  for (const std::uint32_t index : {4, 7, 2, 9}) mesh.add_vertex(index);
  mesh.add_triangle({0, 1, 2}, 3);
  mesh.add_triangle({0, 2, 3}, 5);
  mesh.add_triangle({3, 0, 0}, 1);
  return mesh;
}

/// The corners at vertex 0 are 8, 7, 3, 0; their triangles are number 2, 2, 1, 0.
VertexSplit split_between_them() {
  VertexSplit split;
  split.into = 0;
  split.index = 6;
  split.error = 0.25f;
  split.moves = {0, 0, 1, 0};
  split.returning[0] = {.apex = 2, .order = 4, .index = 8, .origin = Origin::seen, .owner = 0};
  split.returning[1] = {.apex = 3, .order = 1, .index = 0, .origin = Origin::seen, .owner = 0};
  split.returning_count = 2;
  return split;
}

const ProgressiveColumns kPositions{TriangleMesh{}};

std::string bytes_of(const VertexSplit& split) {
  std::string bytes;
  put_split_head(bytes, three_triangles(), 0.5f, split);
  bytes.append(kPositions.row_size(), '\0');
  put_split_tail(bytes, three_triangles(), kPositions, split);
  return bytes;
}

const char* read(const std::string& bytes, VertexSplit& split) {
  Cursor cursor(bytes, "split");
  const std::byte* row = nullptr;
  const char* wrong =
      read_split(cursor, three_triangles(), 0.5f, kPositions, kOriginal, split, row);
  return wrong || cursor.at_end() ? wrong : "bytes are left";
}

TEST(ProgressiveRecord, ComesBack) {
  const VertexSplit written = split_between_them();
  VertexSplit split;
  ASSERT_EQ(read(bytes_of(written), split), nullptr);
  EXPECT_EQ(split.into, written.into);
  EXPECT_EQ(split.index, written.index);
  EXPECT_EQ(split.error, written.error);
  EXPECT_EQ(split.moves, written.moves);
  ASSERT_EQ(split.returning_count, 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(split.returning[i].apex, written.returning[i].apex);
    EXPECT_EQ(split.returning[i].order, written.returning[i].order);
    EXPECT_EQ(split.returning[i].index, written.returning[i].index);
  }
}

TEST(ProgressiveRecord, SplitsAVertex) {
  GrowingMesh mesh = three_triangles();
  mesh.split(split_between_them());
  const std::vector<Triangle> expected{{0, 1, 2}, {4, 2, 3}, {3, 0, 0}, {2, 4, 0}, {4, 3, 0}};
  ASSERT_EQ(mesh.stars.triangles(), expected.size());
  for (std::uint32_t t = 0; t < expected.size(); ++t)
    EXPECT_EQ(mesh.stars.triangle(t), expected[t]) << t;
  const auto star = [&](std::uint32_t vertex) {
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t corner : mesh.stars.corners_at(vertex)) corners.push_back(corner);
    return corners;
  };
  EXPECT_EQ(star(0), (std::vector<std::uint32_t>{14, 11, 8, 7, 0}));
  EXPECT_EQ(star(4), (std::vector<std::uint32_t>{12, 10, 3}));
}

TEST(ProgressiveRecord, IsRefusedWhereItSaysWhatCannotBe) {
  const std::string bytes = bytes_of(split_between_them());
  // into, fall (4 bytes), number, row, orders, moves, apex, number, apex, number
  ASSERT_EQ(bytes.size(), 1 + 4 + 1 + 12 + 1 + 1 + 4u);
  const auto refused = [&](std::size_t at, char value) {
    std::string changed = bytes;
    changed[at] = value;
    VertexSplit split;
    return read(changed, split) != nullptr;
  };
  EXPECT_TRUE(refused(0, 4)) << "a vertex that is not there";
  EXPECT_TRUE(refused(5, 32)) << "a number of a vertex beyond the original";
  EXPECT_TRUE(refused(18, 6)) << "an order of corners that is none";
  EXPECT_TRUE(refused(18, 64)) << "a bit of no meaning";
  EXPECT_TRUE(refused(19, 0x14)) << "a corner that is not there";
  EXPECT_TRUE(refused(20, 8)) << "an apex that is not there";
  EXPECT_TRUE(refused(20, 1)) << "an apex that is the vertex itself";
  EXPECT_TRUE(refused(21, 34)) << "a number of a triangle beyond the original";
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    VertexSplit split;
    EXPECT_NE(read(bytes.substr(0, size), split), nullptr);
  }
}

TEST(GrownMesh, IsPutIntoTheOrderOfTheOriginal) {
  GrownMesh grown;
  grown.mesh = three_triangles();
  grown.columns = kPositions;
  TriangleMesh rows;
  for (std::size_t v = 0; v < 4; ++v) {
    rows.positions.push_back({static_cast<float>(v), 0, 0});
    std::string row;
    put_row(row, rows, v);
    EXPECT_TRUE(grown.columns.append(reinterpret_cast<const std::byte*>(row.data())));
  }
  const auto ordered = in_original_order(grown, false);
  ASSERT_TRUE(ordered);
  EXPECT_EQ(ordered->mesh.positions,
            (std::vector<Vec3f>{{2, 0, 0}, {0, 0, 0}, {1, 0, 0}, {3, 0, 0}}));
  EXPECT_EQ(ordered->mesh.triangles, (std::vector<Triangle>{{3, 1, 1}, {1, 2, 0}, {1, 0, 3}}));
  EXPECT_EQ(ordered->places, (std::vector<std::uint32_t>{1, 2, 0, 3}));

  GrownMesh twice = grown;
  twice.mesh.vertex_indices[3] = 2;
  EXPECT_FALSE(in_original_order(twice, false)) << "two vertices with one number";
  twice = grown;
  twice.mesh.triangle_indices[2] = 3;
  EXPECT_FALSE(in_original_order(twice, false)) << "two triangles with one number";
}

}  // namespace
}  // namespace burnish
