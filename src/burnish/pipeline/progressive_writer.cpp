#include <fmt/format.h>

#include <bit>

#include "burnish/io/atomic_writer.h"
#include "burnish/io/crc32.h"
#include "burnish/io/output.h"
#include "burnish/pipeline/collapsed_mesh.h"
#include "burnish/pipeline/progressive_bytes.h"
#include "burnish/pipeline/progressive_file.h"
#include "burnish/pipeline/progressive_format.h"
#include "burnish/pipeline/progressive_records.h"

namespace burnish {
namespace {

/// The order of the corners of `triangle` between `into`, `vertex` and a third one.
std::uint8_t order_of(const Triangle& triangle, std::uint32_t into, std::uint32_t vertex) {
  std::uint8_t order = 0;
  for (; order < kCornerOrders.size(); ++order) {
    bool fits = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint8_t role = triangle[k] == into ? 0 : triangle[k] == vertex ? 1 : 2;
      fits = fits && kCornerOrders[order][k] == role;
    }
    if (fits) break;
  }
  return order;
}

/// Which of 0, 1, ... are kept, as runs: how many are left out, how many are kept, and so on.
void put_kept(std::string& bytes, const std::vector<std::uint8_t>& gone) {
  for (std::size_t begin = 0; begin < gone.size();) {
    std::size_t kept = begin;
    while (kept < gone.size() && gone[kept] != 0) ++kept;
    std::size_t end = kept;
    while (end < gone.size() && gone[end] == 0) ++end;
    if (end > kept) {
      put_number(bytes, kept - begin);
      put_number(bytes, end - kept);
    }
    begin = end;
  }
}

/// Replays the removals backwards on a mesh as the reader will have it, and writes what it reads.
class ProgressiveWriter {
 public:
  ProgressiveWriter(const TriangleMesh& original, std::span<const Removal> removals,
                    CollapsedMesh collapsed, Output& out)
      : original_(original),
        removals_(removals),
        collapsed_(std::move(collapsed)),
        columns_(original),
        out_(out) {}

  Result<ProgressiveFileReport> write();

 private:
  std::uint64_t bytes_as_ply() const;
  void put_head();
  void put_coarse_vertices();
  void put_coarse_triangles();
  void put_record(std::size_t removal);
  VertexSplit& split_of(std::size_t removal);
  ReturningTriangle returning(const Removal& removal, std::uint32_t t);
  void send() {
    crc_.add(bytes_.data(), bytes_.size());
    report_.bytes += bytes_.size();
    out_.bytes(bytes_.data(), bytes_.size());
    bytes_.clear();
  }
  void count_vertex() {
    constexpr std::size_t kAtOnce = 4096;
    if (mesh_.stars.vertices() % kAtOnce == 0) out_.advance(kAtOnce);
  }
  void send_with_crc() {
    send();
    put_raw(bytes_, crc_.value());
    send();
  }

  const TriangleMesh& original_;
  std::span<const Removal> removals_;
  CollapsedMesh collapsed_;
  ProgressiveColumns columns_;
  Output& out_;
  std::string bytes_;  ///< on their way out
  Crc32 crc_;
  GrowingMesh mesh_;                                              ///< as the reader has it
  std::vector<std::uint32_t> vertex_numbers_, triangle_numbers_;  ///< in `mesh_`, of the original's
  std::vector<bool> moves_;  ///< per corner of `mesh_`, of the split at hand
  VertexSplit split_;
  float error_ = 0;  ///< of `mesh_`
  ProgressiveFileReport report_;
};

void ProgressiveWriter::put_head() {
  bytes_ += kProgressiveMagic;
  bytes_ += static_cast<char>(kProgressiveVersion);
  put_number(bytes_, report_.vertices);
  put_number(bytes_, report_.triangles);
  put_number(bytes_, removals_.size());
  put_number(bytes_, report_.coarse_triangles);
  put_raw(bytes_, error_);
  for (std::size_t axis = 0; axis < 3; ++axis) put_raw(bytes_, original_.frame.origin[axis]);
  columns_.put_list(bytes_);
  send();
}

void ProgressiveWriter::put_coarse_vertices() {
  put_kept(bytes_, collapsed_.vertex_gone);
  for (std::uint32_t v = 0; v < report_.vertices && out_.ok(); ++v) {
    if (collapsed_.vertex_gone[v] != 0) continue;
    vertex_numbers_[v] = static_cast<std::uint32_t>(mesh_.stars.vertices());
    mesh_.add_vertex(v);
    put_row(bytes_, original_, v);
    send();
    count_vertex();
  }
}

void ProgressiveWriter::put_coarse_triangles() {
  put_kept(bytes_, collapsed_.triangle_gone);
  const TriangleAttributes& known = original_.triangle_attributes;
  std::uint32_t last = 0;
  for (std::uint32_t t = 0; t < report_.triangles && out_.ok(); ++t) {
    if (collapsed_.triangle_gone[t] != 0) continue;
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle[k] = vertex_numbers_[collapsed_.triangles[t][k]];
      put_near(bytes_, triangle[k], last);
      last = triangle[k];
    }
    if (columns_.triangle_origin()) bytes_ += static_cast<char>(known.origin[t]);
    if (columns_.triangle_owner()) put_near(bytes_, known.owner[t], collapsed_.triangles[t][0]);
    triangle_numbers_[t] = static_cast<std::uint32_t>(mesh_.stars.triangles());
    mesh_.add_triangle(triangle, t);
    send();
  }
}

ReturningTriangle ProgressiveWriter::returning(const Removal& removal, std::uint32_t t) {
  const Triangle& triangle = collapsed_.triangles[t];
  const TriangleAttributes& known = original_.triangle_attributes;
  ReturningTriangle back;
  for (const std::uint32_t v : triangle) {
    if (v != removal.vertex && v != removal.into) back.apex = vertex_numbers_[v];
  }
  back.order = order_of(triangle, removal.into, removal.vertex);
  back.index = t;
  if (columns_.triangle_origin()) back.origin = known.origin[t];
  if (columns_.triangle_owner()) back.owner = known.owner[t];
  return back;
}

/// The split that undoes a removal, and takes it back in `collapsed_`.
VertexSplit& ProgressiveWriter::split_of(std::size_t i) {
  const Removal& removal = removals_[i];
  const CollapsedMesh::Step& step = collapsed_.steps[i];
  split_.into = vertex_numbers_[removal.into];
  split_.index = removal.vertex;
  split_.error = i == 0 ? 0 : removals_[i - 1].error + 0.f;  // + 0: no negative zero
  split_.moves.clear();
  const auto for_each_moved = [&](auto use) {
    for (std::size_t m = i == 0 ? 0 : collapsed_.steps[i - 1].moved_end; m < step.moved_end; ++m) {
      const std::uint32_t corner = collapsed_.moved[m];
      use(corner, 3 * triangle_numbers_[corner / 3] + corner % 3);
    }
  };
  for_each_moved([&](std::uint32_t corner, std::uint32_t number) {
    collapsed_.triangles[corner / 3][corner % 3] = removal.vertex;
    moves_[number] = true;
  });
  for (const std::uint32_t corner : mesh_.stars.corners_at(split_.into))
    split_.moves.push_back(moves_[corner] ? 1 : 0);
  for_each_moved([&](std::uint32_t, std::uint32_t number) { moves_[number] = false; });
  split_.returning_count = 0;
  for (const std::uint32_t t : step.gone) {
    if (t == CollapsedMesh::kNone) continue;
    triangle_numbers_[t] =
        static_cast<std::uint32_t>(mesh_.stars.triangles() + split_.returning_count);
    split_.returning[split_.returning_count++] = returning(removal, t);
  }
  return split_;
}

void ProgressiveWriter::put_record(std::size_t removal) {
  const VertexSplit& split = split_of(removal);
  put_split_head(bytes_, mesh_, error_, split);
  put_row(bytes_, original_, split.index);
  put_split_tail(bytes_, mesh_, columns_, split);
  send();
  put_raw(bytes_, static_cast<std::uint16_t>(crc_.value()));
  send();
  vertex_numbers_[split.index] = static_cast<std::uint32_t>(mesh_.stars.vertices());
  mesh_.split(split);
  error_ = split.error;
  count_vertex();
}

/// As write_ply has it: positions in double where there is a frame.
std::uint64_t ProgressiveWriter::bytes_as_ply() const {
  const bool framed = original_.frame.origin != Vec3d{};
  const std::uint64_t vertex = columns_.row_size() + (framed ? sizeof(Vec3d) - sizeof(Vec3f) : 0);
  const std::uint64_t triangle = 1 + sizeof(Triangle) + (columns_.triangle_origin() ? 1 : 0) +
                                 (columns_.triangle_owner() ? sizeof(std::uint32_t) : 0);
  return report_.vertices * vertex + report_.triangles * triangle;
}

Result<ProgressiveFileReport> ProgressiveWriter::write() {
  report_.vertices = original_.positions.size();
  report_.triangles = original_.triangles.size();
  report_.coarse_vertices = report_.vertices - removals_.size();
  for (const std::uint8_t gone : collapsed_.triangle_gone) report_.coarse_triangles += gone == 0;
  report_.ply_bytes = bytes_as_ply();
  error_ = report_.coarse_error = removals_.empty() ? 0 : removals_.back().error + 0.f;
  mesh_.reserve(report_.vertices, report_.triangles);
  vertex_numbers_.resize(report_.vertices);
  triangle_numbers_.resize(report_.triangles);
  moves_.resize(3 * report_.triangles);
  put_head();
  put_coarse_vertices();
  put_coarse_triangles();
  send_with_crc();
  for (std::size_t i = removals_.size(); i-- > 0 && out_.ok();) put_record(i);
  send_with_crc();
  if (auto ok = out_.finish(); !ok) return ok.error();
  return report_;
}

}  // namespace

Facts ProgressiveFileReport::facts() const {
  return {{"vertices", static_cast<double>(vertices), ""},
          {"triangles", static_cast<double>(triangles), ""},
          {"coarse_vertices", static_cast<double>(coarse_vertices), ""},
          {"coarse_triangles", static_cast<double>(coarse_triangles), ""},
          {"coarse_error", coarse_error, "m"},
          {"bytes", static_cast<double>(bytes), ""},
          {"ply_bytes", static_cast<double>(ply_bytes), ""}};
}

Result<ProgressiveFileReport> write_progressive(const std::filesystem::path& path,
                                                const TriangleMesh& mesh,
                                                std::span<const Removal> removals,
                                                const Context& context) {
  if (auto sound = check(mesh); !sound) return sound.error();
  if (mesh.triangles.size() > kMostProgressiveTriangles ||
      mesh.positions.size() > kMostProgressiveVertices) {
    return Error{ErrorCode::unsupported,
                 fmt::format("a progressive file holds at most {} vertices and {} triangles",
                             kMostProgressiveVertices, kMostProgressiveTriangles),
                 path.string()};
  }
  if (!is_finite(mesh.frame.origin))
    return Error{ErrorCode::bad_geometry, "the origin of the frame is not finite", {}};
  auto collapsed = collapse(mesh, removals, context.part(0, 0.3));
  if (!collapsed) return collapsed.error();
  auto file = AtomicWriter::create(path);
  if (!file) return file.error();
  const Context writing = context.part(0.3, 1);
  Output out(*file, mesh.positions.size(), writing);
  auto report = ProgressiveWriter(mesh, removals, *std::move(collapsed), out).write();
  if (!report) return report;
  if (auto done = file->commit(); !done) return done.error();
  context.progress(1);
  return report;
}

}  // namespace burnish
