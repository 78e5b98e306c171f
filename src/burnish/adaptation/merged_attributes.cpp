#include "burnish/adaptation/merged_attributes.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace burnish {
namespace {

/// Calls `merge(stays, goes, share)` for all that moved a vertex.
template <class Merge>
void for_each_move(std::span<const Removal> removals, std::span<const float> shares, Merge merge) {
  for (std::size_t k = 0; k < removals.size(); ++k) {
    if (shares[k] > 0) merge(removals[k].into, removals[k].vertex, shares[k]);
  }
}

}  // namespace

void merge_attributes(Attributes& attributes, std::span<const Removal> removals,
                      std::span<const float> shares) {
  const auto for_moves = [&](const auto& values, auto merge) {
    if (!values.empty()) for_each_move(removals, shares, merge);
  };
  const auto take_nearer = [&](auto& values) {
    for_moves(values, [&](std::uint32_t stays, std::uint32_t goes, float share) {
      if (share > .5f) values[stays] = values[goes];
    });
  };
  auto& [normals, colors, sigma, noise, observations, origin, channels] = attributes;
  for_moves(normals, [&n = normals](std::uint32_t stays, std::uint32_t goes, float share) {
    n[stays] = normalized(n[stays] * (1 - share) + n[goes] * share);
  });
  for_moves(colors, [&c = colors](std::uint32_t stays, std::uint32_t goes, float share) {
    for (std::size_t i = 0; i < c[stays].size(); ++i) {
      const float mixed =
          static_cast<float>(c[stays][i]) * (1 - share) + static_cast<float>(c[goes][i]) * share;
      c[stays][i] = static_cast<std::uint8_t>(std::lround(mixed));
    }
  });
  for_moves(sigma, [&s = sigma](std::uint32_t stays, std::uint32_t goes, float) {
    s[stays] = std::max(s[stays], s[goes]);
  });
  for_moves(origin, [&o = origin](std::uint32_t stays, std::uint32_t goes, float) {
    o[stays] = std::max(o[stays], o[goes]);
  });
  take_nearer(noise);
  take_nearer(observations);
  for (Channel& channel : channels) {
    std::visit(
        [&](auto& values) {
          using Number = typename std::decay_t<decltype(values)>::value_type;
          if constexpr (std::is_integral_v<Number>) {
            take_nearer(values);
          } else {
            for_moves(values, [&](std::uint32_t stays, std::uint32_t goes, float share) {
              values[stays] = values[stays] * static_cast<Number>(1 - share) +
                              values[goes] * static_cast<Number>(share);
            });
          }
        },
        channel.values);
  }
}

}  // namespace burnish
