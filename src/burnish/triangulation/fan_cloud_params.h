#pragma once

#include <numbers>

#include "burnish/base/schema.h"

namespace burnish {

enum class FanVariant { ring, delaunay };
enum class FanDrawing { cover, all };

/// How fans are built. The sources leave all these numbers open: the defaults are our own.
struct FanCloudParams {
  FanVariant variant = FanVariant::ring;
  int k = 8;
  int cap = 3;
  double gap_angle = std::numbers::pi / 2;
  double sheet_angle = std::numbers::pi / 2;
  double steep_angle = std::numbers::pi / 3;
  FanDrawing drawn = FanDrawing::cover;

  static const Schema<FanCloudParams>& schema();
};

}  // namespace burnish
