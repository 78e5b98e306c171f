#include "burnish/registration/pair.h"

namespace burnish {

std::string_view to_string(Refusal refusal) {
  switch (refusal) {
    case Refusal::not_converged:
      return "not_converged";
    case Refusal::too_little_overlap:
      return "too_little_overlap";
    case Refusal::residual_above_noise:
      return "residual_above_noise";
    case Refusal::contradiction:
      return "contradiction";
    case Refusal::not_held:
      return "not_held";
    case Refusal::ambiguous:
      return "ambiguous";
  }
  return "";
}

const Schema<AcceptanceParams>& AcceptanceParams::schema() {
  using P = AcceptanceParams;
  static const auto schema =
      Schema<P>()
          .real("min_overlap", &P::min_overlap, between(0, 1),
                "share of the source that must have a counterpart")
          .real("max_rmse", &P::max_rmse, more_than(0),
                "largest inlier_rmse, in units of the expected noise")
          .real("max_contradiction", &P::max_contradiction, between(0, 1),
                "largest share of what both could see that one saw through")
          .real("min_significance", &P::min_significance, at_least(0),
                "by how much the weakest direction must be held more than chance explains")
          .real("max_deviation", &P::max_deviation, more_than(0),
                "largest deviation of the pose in its weakest direction", Quantity::length);
  return schema;
}

Facts PairRegistration::facts() const {
  return {{"points", static_cast<double>(points), ""},
          {"matched", static_cast<double>(matched), ""},
          {"overlap", overlap, ""},
          {"agreement", agreement, ""},
          {"contradiction", contradiction, ""},
          {"inlier_rmse", inlier_rmse, ""},
          {"weakest_deviation", weakest.deviation, "m"},
          {"weakest_significance", weakest.significance, ""},
          {"weakest_eigenvalue", weakest.eigenvalue, "1/m2"},
          {"iterations", static_cast<double>(iterations), ""},
          {"converged", converged ? 1.0 : 0.0, ""},
          {"accepted", accepted() ? 1.0 : 0.0, ""}};
}

}  // namespace burnish
