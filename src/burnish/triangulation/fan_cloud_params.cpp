#include "burnish/triangulation/fan_cloud_params.h"

namespace burnish {

const Schema<FanCloudParams>& FanCloudParams::schema() {
  using P = FanCloudParams;
  constexpr double kPi = std::numbers::pi;
  static const auto schema =
      Schema<P>()
          .choice("variant", &P::variant,
                  {{"ring", FanVariant::ring}, {"delaunay", FanVariant::delaunay}},
                  "the nearest neighbours sorted by angle, or their local Delaunay star")
          .integer("k", &P::k, between(3, 100), "nearest neighbours of a fan")
          .integer("cap", &P::cap, between(1, 20),
                   "neighbours are looked at, where there are gaps, up to so many times k")
          .real("gap_angle", &P::gap_angle,
                {.low = 0, .high = kPi, .open_low = true, .open_high = true},
                "a wider angle between neighbours is a gap", Quantity::angle)
          .real("sheet_angle", &P::sheet_angle, {.low = 0, .high = kPi, .open_low = true},
                "neighbours whose normals are further apart are on another sheet", Quantity::angle)
          .real("steep_angle", &P::steep_angle, {.low = 0, .high = kPi / 2, .open_low = true},
                "where normals are unknown, neighbours seen more steeply lie above or below",
                Quantity::angle)
          .choice("drawn", &P::drawn, {{"cover", FanDrawing::cover}, {"all", FanDrawing::all}},
                  "so many of the fans' triangles as cover the surface, or all");
  return schema;
}

}  // namespace burnish
