#include "burnish/core/attributes.h"

#include <fmt/format.h>

#include "burnish/core/gather.h"

namespace burnish {

std::size_t Channel::size() const {
  return std::visit([](const auto& v) { return v.size(); }, values);
}

Result<void> check_lengths(const Attributes& attributes, std::size_t count) {
  const auto check = [&](std::string_view name, std::size_t size) -> Result<void> {
    if (size == 0 || size == count) return {};
    return Error{ErrorCode::bad_geometry,
                 fmt::format("attribute '{}' has {} values for {} vertices", name, size, count),
                 {}};
  };
  if (auto ok = check("normals", attributes.normals.size()); !ok) return ok;
  if (auto ok = check("colors", attributes.colors.size()); !ok) return ok;
  if (auto ok = check("sigma", attributes.sigma.size()); !ok) return ok;
  if (auto ok = check("noise", attributes.noise.size()); !ok) return ok;
  if (auto ok = check("observations", attributes.observations.size()); !ok) return ok;
  if (auto ok = check("origin", attributes.origin.size()); !ok) return ok;
  for (const Channel& channel : attributes.channels) {
    if (auto ok = check(channel.name, channel.size()); !ok) return ok;
  }
  return {};
}

Attributes gather(const Attributes& attributes, const Selection& kept) {
  Attributes result{gather(attributes.normals, kept),
                    gather(attributes.colors, kept),
                    gather(attributes.sigma, kept),
                    gather(attributes.noise, kept),
                    gather(attributes.observations, kept),
                    gather(attributes.origin, kept),
                    {}};
  for (const Channel& channel : attributes.channels) {
    result.channels.push_back(
        {channel.name, std::visit([&](const auto& v) -> Channel::Values { return gather(v, kept); },
                                  channel.values)});
  }
  return result;
}

}  // namespace burnish
