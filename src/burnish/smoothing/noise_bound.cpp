#include "burnish/smoothing/noise_bound.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "burnish/base/parallel.h"

namespace burnish {
namespace {

/// Where measurements say that a vertex may be, around where they put it.
class Region {
 public:
  explicit Region(const PointNoise& noise)
      : axis_(normalized(Vec3d(noise.axis))), along_(noise.along), across_(noise.across) {}
  explicit Region(float sigma) : along_(sigma), across_(sigma) {}

  /// How many standard deviations `d` is. A measurement that is exact in one direction allows none:
  /// floats cannot keep to the plane or the line that is left.
  double ratio(const Vec3d& d) const {
    if (along_ == across_ || shortest() == 0) return in(norm(d), shortest());
    return std::hypot(in(dot(d, axis_), along_), in(norm(cross(d, axis_)), across_));
  }
  double shortest() const { return std::min(along_, across_); }

 private:
  static double in(double length, double deviation) { return length == 0 ? 0 : length / deviation; }

  Vec3d axis_;
  double along_, across_;
};

Region region_of(const Attributes& attributes, std::size_t v) {
  return attributes.noise.empty() ? Region(attributes.sigma[v]) : Region(attributes.noise[v]);
}

bool is_deviation(float value) {
  return std::isfinite(value) && value >= 0;
}

bool is_noise(const PointNoise& noise) {
  const bool has_axis = std::abs(norm(Vec3d(noise.axis)) - 1) < 1e-3;
  return is_deviation(noise.along) && is_deviation(noise.across) &&
         (has_axis || noise.along == noise.across);
}

/// How far a point between `p` and `q` may be from the float that is nearest to it, and what the
/// arithmetic of a ratio adds to that, m.
double rounding(const Vec3f& p, const Vec3f& q) {
  double largest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    largest = std::max<double>({largest, std::abs(p[axis]), std::abs(q[axis])});
  }
  return std::sqrt(3.0) * std::max(0x1p-24 * largest, 0x1p-150) + 0x1p-48 * norm(Vec3d(q - p));
}

/// The share of its way that a vertex with this ratio may keep.
double share_within(const Region& region, double c, double ratio, double rounding) {
  const double room = c * (1 - 0x1p-40) - rounding / region.shortest();
  return room > 0 ? room / ratio : 0;
}

Result<void> check_pair(const TriangleMesh& before, const TriangleMesh& after) {
  if (before.positions.size() != after.positions.size()) {
    return Error{ErrorCode::bad_geometry,
                 fmt::format("{} vertices before and {} after: the bound is on vertices that "
                             "correspond one by one",
                             before.positions.size(), after.positions.size()),
                 {}};
  }
  if (before.frame != after.frame) {
    return Error{
        ErrorCode::bad_geometry, "the meshes before and after are in different frames", {}};
  }
  if (auto sound = check(before); !sound) return sound;
  if (auto sound = check(after); !sound) return sound;
  return check_noise(before);
}

NoiseBoundReport joined(NoiseBoundReport a, const NoiseBoundReport& b) {
  a.largest_ratio = std::max(a.largest_ratio, b.largest_ratio);
  a.put_back += b.put_back;
  a.free += b.free;
  return a;
}

}  // namespace

const Schema<NoiseBoundParams>& NoiseBoundParams::schema() {
  using P = NoiseBoundParams;
  static const auto schema =
      Schema<P>().real("c", &P::c, at_least(0),
                       "standard deviations that a vertex may be away from its measurement");
  return schema;
}

Facts NoiseBoundReport::facts() const {
  return {{"largest_ratio", largest_ratio, ""},
          {"put_back", static_cast<double>(put_back), ""},
          {"free", static_cast<double>(free), ""}};
}

Result<void> check_noise(const TriangleMesh& mesh) {
  const std::vector<PointNoise>& noise = mesh.attributes.noise;
  const std::vector<float>& sigma = mesh.attributes.sigma;
  if (mesh.positions.empty()) return {};
  if (noise.empty() && sigma.empty()) {
    return Error{ErrorCode::bad_geometry,
                 "the mesh does not say how far its vertices may be off, so nothing can be bound "
                 "to it: reconstruct from depth frames, or give every vertex a 'sigma' (m)",
                 {}};
  }
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (noise.empty() ? is_deviation(sigma[v]) : is_noise(noise[v])) continue;
    return Error{ErrorCode::bad_geometry,
                 noise.empty()
                     ? fmt::format("a sigma of 0 or more was expected, not {}", sigma[v])
                     : fmt::format("noise of 0 or more along and across an axis of length "
                                   "1 was expected, not {} and {} with ({}, {}, {})",
                                   noise[v].along, noise[v].across, noise[v].axis.x,
                                   noise[v].axis.y, noise[v].axis.z),
                 fmt::format("vertex {}", v)};
  }
  return {};
}

Result<NoiseBoundReport> bound_to_noise(const TriangleMesh& before, TriangleMesh& after,
                                        const NoiseBoundParams& params, const Context& context) {
  if (auto valid = NoiseBoundParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check_pair(before, after); !sound) return sound.error();

  const Attributes& known = before.attributes;
  std::vector<Vec3f> positions = after.positions;
  std::vector<float> sigma = after.attributes.sigma;
  const bool mix_sigma = !sigma.empty() && !known.sigma.empty();
  const auto bound = [&](IndexRange range) {
    NoiseBoundReport part;
    for (std::size_t v = range.begin; v < range.end; ++v) {
      if (!known.origin.empty() && known.origin[v] == Origin::invented) {
        ++part.free;
        continue;
      }
      const Region region = region_of(known, v);
      const Vec3d place(before.positions[v]), way = Vec3d(positions[v]) - place;
      double ratio = region.ratio(way);
      if (ratio > params.c) {
        const double share =
            share_within(region, params.c, ratio, rounding(before.positions[v], positions[v]));
        positions[v] = share > 0 ? Vec3f(place + share * way) : before.positions[v];
        if (mix_sigma) {
          sigma[v] = static_cast<float>((1 - share) * known.sigma[v] + share * sigma[v]);
        }
        ratio = region.ratio(Vec3d(positions[v]) - place);
        ++part.put_back;
      }
      part.largest_ratio = std::max(part.largest_ratio, ratio);
    }
    return part;
  };
  NoiseBoundReport report;
  const bool complete = parallel_reduce(
      context, positions.size(), report, bound,
      [](NoiseBoundReport& total, const NoiseBoundReport& part) { total = joined(total, part); });
  if (!complete) return cancelled();
  after.positions = std::move(positions);
  after.attributes.sigma = std::move(sigma);
  if (report.put_back > 0 && !after.attributes.normals.empty()) {
    after.attributes.normals = vertex_normals(after);
  }
  context.progress(1);
  return report;
}

}  // namespace burnish
