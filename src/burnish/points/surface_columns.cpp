#include "burnish/points/surface_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

#include "burnish/base/parallel.h"

namespace burnish {
namespace {

constexpr double kOffsetUnits = 1 << 18;  // to a cell's width
constexpr double kWeightUnits = 1 << 10;  // to a typical weight; limits 1 and 2^20
constexpr double kNormalUnits = 1 << 15;

std::int64_t in_units(double value, double units) {
  return static_cast<std::int64_t>(std::lround(value * units));
}

std::int64_t weight_units(double weight, double typical) {
  return std::clamp<std::int64_t>(in_units(weight / typical, kWeightUnits), 1, 1 << 20);
}

/// 2 * axis, one more for its negative direction.
std::size_t field_of(const Vec3f& n) {
  const Vec3f size{std::abs(n.x), std::abs(n.y), std::abs(n.z)};
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  return 2 * axis + (n[axis] < 0 ? 1 : 0);
}

}  // namespace

/// A measurement and the cell that it falls into.
struct SurfaceColumns::Entry {
  std::uint64_t key;
  std::uint32_t list, index;

  friend bool operator<(const Entry& a, const Entry& b) { return a.key < b.key; }
};

Result<std::vector<SurfaceColumns::Entry>> SurfaceColumns::sorted_entries(
    const MeasurementSource& source, const Context& context) {
  const std::size_t lists = source.lists();
  std::vector<std::vector<Entry>> parts(lists);
  std::atomic<bool> fits{true};
  bool complete = parallel_for(
      context.part(0, 0.6), lists,
      [&](IndexRange range) {
        for (std::size_t list = range.begin; list < range.end; ++list) {
          for (std::size_t i = 0; i < source.size(list); ++i) {
            if (!source.counts(list, i)) continue;
            const Measurement m = source.read(list, i);
            const std::size_t field = field_of(m.normal), axis = field / 2;
            const double row = m.position[(axis + 1) % 3] / across_;
            const double column = m.position[(axis + 2) % 3] / across_;
            const double layer = m.position[axis] / along_;
            if (!(std::max({std::abs(row), std::abs(column), std::abs(layer)}) < kHalf - 2)) {
              fits = false;
              return;
            }
            parts[list].push_back({key(field, floor_of(row), floor_of(column), floor_of(layer)),
                                   static_cast<std::uint32_t>(list),
                                   static_cast<std::uint32_t>(i)});
          }
          std::sort(parts[list].begin(), parts[list].end());
        }
      },
      1);
  if (!complete) return cancelled();
  if (!fits) {
    return Error{
        ErrorCode::invalid_argument,
        fmt::format("cells of {} m are too small for the extent of the clouds, which may be "
                    "{} cells from the origin",
                    std::min(across_, along_), kHalf),
        {}};
  }
  // Neighbouring lists are merged, two by two, until one is left.
  while (parts.size() > 1) {
    std::vector<std::vector<Entry>> merged((parts.size() + 1) / 2);
    complete = parallel_for(
        Context(context).part(0.6, 0.6), merged.size(),
        [&](IndexRange range) {
          for (std::size_t i = range.begin; i < range.end; ++i) {
            if (2 * i + 1 == parts.size()) {
              merged[i] = std::move(parts[2 * i]);
              continue;
            }
            std::vector<Entry>&a = parts[2 * i], &b = parts[2 * i + 1];
            merged[i].resize(a.size() + b.size());
            std::merge(a.begin(), a.end(), b.begin(), b.end(), merged[i].begin());
            a = {}, b = {};
          }
        },
        1);
    if (!complete) return cancelled();
    parts = std::move(merged);
  }
  return parts.empty() ? std::vector<Entry>{} : std::move(parts.front());
}

SurfaceColumns::Cell SurfaceColumns::mean_of(const MeasurementSource& source,
                                             std::span<const Entry> entries,
                                             const Measurement& typical) const {
  std::array<std::int64_t, 3> offset{}, normal{};
  std::int64_t weight = 0, information = 0;
  Vec3d corner;
  Cell cell;
  const std::size_t axis = static_cast<std::size_t>(entries[0].key >> (3 * kBits + 1));
  for (const Entry& entry : entries) {
    const Measurement m = source.read(entry.list, entry.index);
    const std::int64_t w = weight_units(m.weight, typical.weight);
    for (std::size_t d = 0; d < 3; ++d) {
      const double size = d == axis ? along_ : across_;
      corner[d] = std::floor(m.position[d] / size);  // the same for all
      offset[d] += w * in_units(m.position[d] / size - corner[d], kOffsetUnits);
      normal[d] += w * in_units(m.normal[d], kNormalUnits);
    }
    weight += w;
    information += weight_units(m.information, typical.information);
    cell.count += m.count;
  }
  Vec3d position, direction;
  for (std::size_t d = 0; d < 3; ++d) {
    const double size = d == axis ? along_ : across_;
    const double mean = static_cast<double>(offset[d]) / static_cast<double>(weight);
    position[d] = (corner[d] + mean / kOffsetUnits) * size;
    direction[d] = static_cast<double>(normal[d]);
  }
  cell.position = Vec3f(position);
  cell.normal = Vec3f(normalized(direction));
  cell.weight = static_cast<float>(static_cast<double>(weight) / kWeightUnits * typical.weight);
  cell.information =
      static_cast<float>(static_cast<double>(information) / kWeightUnits * typical.information);
  cell.measured = static_cast<std::uint32_t>(entries.size());
  return cell;
}

void SurfaceColumns::index_rows() {
  const auto row_of = [&](std::size_t i) { return keys_[i] >> (2 * kBits); };  // with its field
  for (std::size_t i = 0; i < keys_.size();) {
    const std::size_t field = static_cast<std::size_t>(keys_[i] >> (3 * kBits));
    Field& rows = fields_[field];
    const std::uint64_t first = row_of(i);
    rows.first_row = static_cast<std::int64_t>(first & ((1u << kBits) - 1)) - kHalf;
    for (; i < keys_.size() && (keys_[i] >> (3 * kBits)) == field; ++i) {
      while (rows.starts.size() <= row_of(i) - first) {
        rows.starts.push_back(static_cast<std::uint32_t>(i));
      }
    }
    rows.starts.push_back(static_cast<std::uint32_t>(i));
  }
}

Result<SurfaceColumns> SurfaceColumns::build(const MeasurementSource& source, double across,
                                             double along, const Measurement& typical,
                                             const Context& context) {
  SurfaceColumns columns;
  columns.across_ = across;
  columns.along_ = along;
  const auto entries = columns.sorted_entries(source, context.part(0, 0.7));
  if (!entries) return entries.error();
  std::vector<std::uint32_t> starts;
  for (std::size_t i = 0; i < entries->size(); ++i) {
    if (i > 0 && (*entries)[i].key == (*entries)[i - 1].key) continue;
    starts.push_back(static_cast<std::uint32_t>(i));
    columns.keys_.push_back((*entries)[i].key);
  }
  starts.push_back(static_cast<std::uint32_t>(entries->size()));
  columns.cells_.resize(columns.keys_.size());
  const std::span<const Entry> all(*entries);
  const bool complete =
      parallel_for(context.part(0.7, 1), columns.cells_.size(), [&](IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i) {
          const auto run = all.subspan(starts[i], starts[i + 1] - starts[i]);
          columns.cells_[i] = columns.mean_of(source, run, typical);
        }
      });
  if (!complete) return cancelled();
  columns.index_rows();
  return columns;
}

}  // namespace burnish
