#include "burnish/measure/noise_certificate.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace burnish {
namespace {

constexpr double kNearly = 0.99;  // of c: at the bound

/// Whether a measurement's deviations can be; a direction in which it is exact needs no axis.
bool is_sound(const PointNoise& noise) {
  const bool has_axis = is_finite(noise.axis) && noise.axis != Vec3f{};
  return std::isfinite(noise.along) && std::isfinite(noise.across) && noise.along >= 0 &&
         noise.across >= 0 && (has_axis || noise.along == noise.across);
}

/// The radius in the direction of `d` of the spheroid of one standard deviation. A measurement that
/// is exact along or across its axis allows no way at all: none that is stored in floats is
/// exactly in the plane or on the line that is left.
double deviation_towards(const Vec3d& d, const PointNoise& noise) {
  const double a = noise.along, b = noise.across;
  if (a == b) return a;
  if (a == 0 || b == 0) return 0;
  const Vec3d axis(noise.axis);
  const double scale = squared_norm(d) * squared_norm(axis);
  const double squared_cosine = dot(d, axis) * dot(d, axis) / scale;
  const double squared_sine = squared_norm(cross(d, axis)) / scale;
  return a * b / std::sqrt(squared_cosine * b * b + squared_sine * a * a);
}

/// Adds what vertex v, `displacement` from its measurement, says.
void account(NoiseCertificate& certificate, std::size_t v, const Vec3d& displacement,
             const PointNoise& noise) {
  const double length = norm(displacement);
  const double deviation = length > 0 ? deviation_towards(displacement, noise) : 0;
  const double ratio = length > 0 ? length / deviation : 0;
  certificate.outside += ratio > certificate.c;
  certificate.at_bound += ratio <= certificate.c && ratio > kNearly * certificate.c;
  if (ratio <= certificate.largest_ratio) return;
  certificate.largest_ratio = ratio;
  certificate.worst = v;
  certificate.worst_displacement = length;
  certificate.worst_sigma = deviation;
}

}  // namespace

Facts NoiseCertificate::facts() const {
  return {{"c", c, ""},
          {"vertices", static_cast<double>(vertices), ""},
          {"invented", static_cast<double>(invented), ""},
          {"outside", static_cast<double>(outside), ""},
          {"at_bound", static_cast<double>(at_bound), ""},
          {"largest_ratio", largest_ratio, ""},
          {"worst_vertex", static_cast<double>(worst), ""},
          {"worst_displacement", worst_displacement, "m"},
          {"worst_sigma", worst_sigma, "m"}};
}

std::vector<std::string> sentences(const NoiseCertificate& certificate) {
  const NoiseCertificate& it = certificate;
  std::vector<std::string> lines;
  if (it.holds()) {
    lines.push_back(
        fmt::format("no vertex is farther than c = {} standard deviations from its "
                    "measurement",
                    it.c));
  } else {
    lines.push_back(fmt::format(
        "{} of {} vertices are farther than c = {} standard deviations from their measurements, "
        "vertex {} the farthest: {:.9g} m where one deviation is {:.9g} m, ratio {:.9g}",
        it.outside, it.vertices, it.c, it.worst, it.worst_displacement, it.worst_sigma,
        it.largest_ratio));
  }
  lines.push_back(
      fmt::format("largest ratio {:.6g}; {} of {} vertices within 1 % of the bound; {} "
                  "invented ones, of which there is no measurement, are free",
                  it.largest_ratio, it.at_bound, it.vertices, it.invented));
  lines.push_back(it.round_regions ? "deviations: one a vertex, the same in every direction"
                                   : "deviations: along the ray of each measurement and across it");
  lines.push_back(fmt::format("not covered: {}", kNotCovered));
  return lines;
}

Result<NoiseCertificate> certify_noise_bound(const TriangleMesh& before, const TriangleMesh& after,
                                             double c) {
  if (!(c >= 0 && std::isfinite(c))) {
    return Error{ErrorCode::invalid_argument, fmt::format("0 or more was expected, not {}", c),
                 "c"};
  }
  if (before.positions.size() != after.positions.size()) {
    return Error{ErrorCode::bad_geometry,
                 fmt::format("{} vertices before and {} after: only vertices that correspond one "
                             "by one can be compared",
                             before.positions.size(), after.positions.size()),
                 {}};
  }
  if (auto sound = check(before); !sound) return sound.error();
  if (auto sound = check(after); !sound) return sound.error();
  const Attributes& known = before.attributes;
  NoiseCertificate certificate{.c = c, .vertices = before.positions.size()};
  certificate.round_regions = known.noise.empty();
  if (known.noise.empty() && known.sigma.empty() && certificate.vertices > 0) {
    return Error{ErrorCode::bad_geometry,
                 "the mesh before has neither noise nor sigma to compare displacements with",
                 {}};
  }
  const Vec3d shift = after.frame.origin - before.frame.origin;
  for (std::size_t v = 0; v < certificate.vertices; ++v) {
    if (!known.origin.empty() && known.origin[v] == Origin::invented) {
      ++certificate.invented;
      continue;
    }
    const PointNoise noise =
        known.noise.empty() ? PointNoise{{}, known.sigma[v], known.sigma[v]} : known.noise[v];
    if (!is_sound(noise)) {
      return Error{ErrorCode::bad_geometry,
                   fmt::format("deviations of {} and {} m about the axis ({}, {}, {}) cannot be",
                               noise.along, noise.across, noise.axis.x, noise.axis.y, noise.axis.z),
                   fmt::format("vertex {}", v)};
    }
    account(certificate, v, shift + (Vec3d(after.positions[v]) - Vec3d(before.positions[v])),
            noise);
  }
  return certificate;
}

}  // namespace burnish
