#include "burnish/points/surface_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <span>

#include "burnish/base/parallel.h"

namespace burnish {
namespace {

constexpr double kOffsetUnits = 1 << 18;  // to a cell's width
constexpr double kWeightUnits = 1 << 10;  // to a typical weight; limits 1 and 2^20
constexpr double kNormalUnits = 1 << 15;
constexpr double kPrecisionUnits = 1 << 20;  // to a typical information; limit 2^40

/// A measurement and the cell that it falls into.
struct Entry {
  std::uint64_t key;
  std::uint32_t list, index;

  friend bool operator<(const Entry& a, const Entry& b) { return a.key < b.key; }
};

/// Width of a cell along `axis`, where its column runs along `height_axis`.
struct CellSize {
  double across, along;
  double operator()(std::size_t axis, std::size_t height_axis) const {
    return axis == height_axis ? along : across;
  }
};

std::int64_t in_units(double value, double units) {
  return static_cast<std::int64_t>(std::floor(value * units + 0.5));
}

std::int64_t weight_units(double weight, double typical) {
  const double units = std::clamp(weight / typical * kWeightUnits, 1.0, double{1 << 20});
  return static_cast<std::int64_t>(std::floor(units + 0.5));
}

/// The sum of precisions, whatever their order.
class PrecisionSum {
 public:
  explicit PrecisionSum(double typical) : units_(kPrecisionUnits / typical) {}

  void add(const Precision& precision) {
    const double trace = (precision[0] + precision[1] + precision[2]) * units_;
    const double share = std::min(1.0, double{std::int64_t{1} << 40} / trace);
    for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += in_units(precision[i], share * units_);
  }
  std::array<float, 6> total() const {
    std::array<float, 6> result{};
    for (std::size_t i = 0; i < sum_.size(); ++i) {
      result[i] = static_cast<float>(static_cast<double>(sum_[i]) / units_);
    }
    return result;
  }

 private:
  double units_;
  std::array<std::int64_t, 6> sum_{};
};

/// The measurements of a list by cell; false where one lies beyond the cells that can be numbered.
bool sort_list(const MeasurementSource& source, std::size_t list, CellSize size,
               std::vector<Entry>& entries) {
  for (std::size_t i = 0; i < source.size(list); ++i) {
    if (!source.counts(list, i)) continue;
    const Measurement m = source.read(list, i);
    const std::size_t field = ColumnIndex::field_of(m.normal), axis = field / 2;
    const double row = m.position[(axis + 1) % 3] / size.across;
    const double column = m.position[(axis + 2) % 3] / size.across;
    const double layer = m.position[axis] / size.along;
    const double farthest = std::max({std::abs(row), std::abs(column), std::abs(layer)});
    if (!(farthest < static_cast<double>(ColumnIndex::kHalf - 1))) return false;
    const auto floor_of = ColumnIndex::floor_of;
    entries.push_back({ColumnIndex::key(field, floor_of(row), floor_of(column), floor_of(layer)),
                       static_cast<std::uint32_t>(list), static_cast<std::uint32_t>(i)});
  }
  std::sort(entries.begin(), entries.end());
  return true;
}

/// One sorted list from several: neighbours are merged, two by two, until one is left.
bool merge_sorted(std::vector<std::vector<Entry>>& lists, const Context& context) {
  while (lists.size() > 1) {
    std::vector<std::vector<Entry>> merged((lists.size() + 1) / 2);
    const bool complete = parallel_for(
        context, merged.size(),
        [&](IndexRange range) {
          for (std::size_t i = range.begin; i < range.end; ++i) {
            if (2 * i + 1 == lists.size()) {
              merged[i] = std::move(lists[2 * i]);
              continue;
            }
            std::vector<Entry>&a = lists[2 * i], &b = lists[2 * i + 1];
            merged[i].resize(a.size() + b.size());
            std::merge(a.begin(), a.end(), b.begin(), b.end(), merged[i].begin());
            a = {}, b = {};
          }
        },
        1);
    if (!complete) return false;
    lists = std::move(merged);
  }
  return true;
}

Result<std::vector<Entry>> sorted_entries(const MeasurementSource& source, CellSize size,
                                          const Context& context) {
  std::vector<std::vector<Entry>> lists(source.lists());
  std::atomic<bool> fits{true};
  const bool complete = parallel_for(
      context.part(0, 0.7), lists.size(),
      [&](IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i) {
          if (!sort_list(source, i, size, lists[i])) fits = false;
        }
      },
      1);
  if (!complete) return cancelled();
  if (!fits) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("the clouds reach farther than {} cells of {} m from their origin",
                             ColumnIndex::kHalf - 1, std::min(size.across, size.along)),
                 "spacing"};
  }
  Context silent = context;
  silent.sink = nullptr;  // rounds of merging have no common bar
  if (!merge_sorted(lists, silent)) return cancelled();
  return lists.empty() ? std::vector<Entry>{} : std::move(lists.front());
}

/// The mean of the measurements of one cell, by integer sums; and the sum of their precisions,
/// where there is a place for it.
SurfaceCell mean_of(const MeasurementSource& source, std::span<const Entry> entries, CellSize size,
                    const Measurement& typical, std::array<float, 6>* precision) {
  const std::size_t height_axis = entries[0].key >> (3 * ColumnIndex::kBits + 1);
  std::array<std::int64_t, 3> offset{}, normal{};
  std::int64_t weight = 0, information = 0;
  PrecisionSum precisions(typical.information);
  Vec3d corner;  // of the cell, in cells
  SurfaceCell cell;
  for (const Entry& entry : entries) {
    const Measurement m = source.read(entry.list, entry.index);
    const std::int64_t w = weight_units(m.weight, typical.weight);
    for (std::size_t d = 0; d < 3; ++d) {
      const double place = m.position[d] / size(d, height_axis);
      corner[d] = std::floor(place);
      offset[d] += w * in_units(place - corner[d], kOffsetUnits);
      normal[d] += w * in_units(m.normal[d], kNormalUnits);
    }
    weight += w;
    information += weight_units(m.information, typical.information);
    if (precision) precisions.add(m.precision);
    cell.count += m.count;
  }
  Vec3d position, direction;
  for (std::size_t d = 0; d < 3; ++d) {
    const double mean = static_cast<double>(offset[d]) / static_cast<double>(weight);
    position[d] = (corner[d] + mean / kOffsetUnits) * size(d, height_axis);
    direction[d] = static_cast<double>(normal[d]);
  }
  cell.position = Vec3f(position);
  cell.normal = Vec3f(normalized(direction));
  cell.weight = static_cast<float>(static_cast<double>(weight) / kWeightUnits * typical.weight);
  cell.information =
      static_cast<float>(static_cast<double>(information) / kWeightUnits * typical.information);
  if (precision) *precision = precisions.total();
  cell.measured = static_cast<std::uint32_t>(entries.size());
  return cell;
}

}  // namespace

Result<SurfaceCells> average_in_cells(const MeasurementSource& source, double across, double along,
                                      const Measurement& typical, const Context& context) {
  const CellSize size{across, along};
  const auto entries = sorted_entries(source, size, context.part(0, 0.8));
  if (!entries) return entries.error();
  std::vector<std::uint32_t> starts;
  std::vector<std::uint64_t> keys;
  for (std::size_t i = 0; i < entries->size(); ++i) {
    if (!keys.empty() && (*entries)[i].key == keys.back()) continue;
    starts.push_back(static_cast<std::uint32_t>(i));
    keys.push_back((*entries)[i].key);
  }
  starts.push_back(static_cast<std::uint32_t>(entries->size()));

  SurfaceCells result;
  result.cells.resize(keys.size());
  if (source.has_precision()) result.precisions.resize(keys.size());
  const std::span<const Entry> all(*entries);
  const bool complete =
      parallel_for(context.part(0.8, 1), result.cells.size(), [&](IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i) {
          const auto run = all.subspan(starts[i], starts[i + 1] - starts[i]);
          result.cells[i] = mean_of(source, run, size, typical,
                                    result.precisions.empty() ? nullptr : &result.precisions[i]);
        }
      });
  if (!complete) return cancelled();
  result.index = ColumnIndex(std::move(keys), across);
  return result;
}

}  // namespace burnish
