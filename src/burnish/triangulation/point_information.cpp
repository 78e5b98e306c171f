#include "burnish/triangulation/point_information.h"

#include <algorithm>
#include <cmath>

namespace burnish {
namespace {

/// Calls `visit(q)` for the neighbours in a rim, and counts them.
template <class Visit>
double for_each_neighbour(std::span<const std::uint32_t> rim, Visit visit) {
  int count = 0;
  for (const std::uint32_t q : rim) {
    if (q == Fan::kGap) continue;
    visit(q);
    ++count;
  }
  return count;
}

double distance_from_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d along = b - a;
  const double length = squared_norm(along);
  const double t = length > 0 ? std::clamp(dot(p - a, along) / length, 0.0, 1.0) : 0;
  return norm(a + along * t - p);
}

/// How far an outline would move that goes through `p` and would go past it.
double outline_change(const FanCloud& fans, std::uint32_t p) {
  const auto rim = fans.rim(p);
  const auto place = [&fans](std::uint32_t q) { return Vec3d(fans.positions()[q]); };
  double change = 0;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    if (rim[i] != Fan::kGap) continue;
    const std::uint32_t before = rim[i > 0 ? i - 1 : rim.size() - 1];
    const std::uint32_t after = rim[i + 1 < rim.size() ? i + 1 : 0];
    change = std::max(change, distance_from_segment(place(p), place(before), place(after)));
  }
  return change;
}

}  // namespace

const Schema<InformationWeights>& InformationWeights::schema() {
  using W = InformationWeights;
  static const auto schema =
      Schema<W>()
          .real("distance_weight", &W::distance_weight, at_least(0),
                "of the distance from the neighbours' plane, in mean fan edges")
          .real("normal_weight", &W::normal_weight, at_least(0),
                "of the change of normal, 1 - cosine")
          .real("crowding_weight", &W::crowding_weight, at_least(0),
                "of the mean fan edge, in medians of it over the whole cloud")
          .real("color_weight", &W::color_weight, at_least(0),
                "of the change of color, where there are colors")
          .real("outline_weight", &W::outline_weight, at_least(0),
                "of how far the outline would move, in the same medians")
          .real("noise_sigmas", &W::noise_sigmas, at_least(0),
                "a distance of up to so many of the point's own sigma is noise");
  return schema;
}

double mean_fan_edge(const FanCloud& fans, std::uint32_t p) {
  const Vec3d centre(fans.positions()[p]);
  double sum = 0;
  const double count = for_each_neighbour(
      fans.rim(p), [&](std::uint32_t q) { sum += norm(Vec3d(fans.positions()[q]) - centre); });
  return count > 0 ? sum / count : 0;
}

double PointInformation::color_change(std::span<const std::uint32_t> rim, std::uint32_t p) const {
  Vec3d sum;
  const auto rgb = [this](std::uint32_t q) {
    return Vec3d{double(colors_[q][0]), double(colors_[q][1]), double(colors_[q][2])};
  };
  const double count = for_each_neighbour(rim, [&](std::uint32_t q) { sum += rgb(q); });
  constexpr double kBlackToWhite = 255 * 1.7320508075688772;
  return norm(rgb(p) - sum / count) / kBlackToWhite;
}

double PointInformation::operator()(const FanCloud& fans, std::uint32_t p) const {
  if (fans.state(p) == FanState::duplicate) return 0;
  const auto rim = fans.rim(p);
  if (rim.empty()) return weights_.distance_weight + weights_.normal_weight;
  const Vec3d place(fans.positions()[p]), normal(normals_[p]);
  Vec3d sum;
  double edges = 0, bend = 0;
  const double count = for_each_neighbour(rim, [&](std::uint32_t q) {
    const Vec3d to = Vec3d(fans.positions()[q]) - place;
    sum += to;
    edges += norm(to);
    bend += 1 - std::min(1.0, std::abs(dot(normal, Vec3d(normals_[q]))));
  });
  const double edge = edges / count;
  double distance = std::abs(dot(Vec3d(fans.fan_normal(p)), sum / count));
  if (!sigma_.empty()) distance = std::max(0.0, distance - weights_.noise_sigmas * sigma_[p]);
  double information = weights_.distance_weight * distance / edge +
                       weights_.normal_weight * bend / count +
                       weights_.crowding_weight * edge / usual_edge_;
  if (!colors_.empty()) information += weights_.color_weight * color_change(rim, p);
  if (fans.state(p) == FanState::open) {
    information += weights_.outline_weight * outline_change(fans, p) / usual_edge_;
  }
  return information;
}

}  // namespace burnish
