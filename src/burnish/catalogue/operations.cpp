#include "burnish/catalogue/operations.h"

#include "burnish/repair/small_components.h"
#include "burnish/smoothing/one_ring_mean.h"

// The list of everything that burnish can do. A new method is one line here.
namespace burnish {

std::span<const CleanOperation> clean_operations() {
  static const std::vector<CleanOperation> list{};
  return list;
}

std::span<const MergeOperation> merge_operations() {
  static const std::vector<MergeOperation> list{};
  return list;
}

std::span<const TriangulateOperation> triangulate_operations() {
  static const std::vector<TriangulateOperation> list{};
  return list;
}

std::span<const RepairOperation> repair_operations() {
  static const std::vector<RepairOperation> list{
      edit_operation("small_components", remove_small_components,
                     "Components too small to be anything but specks of noise go.", ""),
  };
  return list;
}

std::span<const SmoothOperation> smooth_operations() {
  static const std::vector<SmoothOperation> list{
      edit_operation("one_ring_mean", smooth_one_ring_mean,
                     "Each vertex moves to the mean of its one-ring and itself.", "ozbay_cinar"),
  };
  return list;
}

}  // namespace burnish
