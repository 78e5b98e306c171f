#pragma once

#include <span>
#include <string_view>

#include "burnish/catalogue/operation.h"

namespace burnish {

/// The operations that burnish offers, family by family, in the order in which they are listed.
std::span<const AverageOperation> average_operations();
std::span<const FilterOperation> filter_operations();
std::span<const CleanOperation> clean_operations();
std::span<const MergeOperation> merge_operations();
std::span<const FuseOperation> fuse_operations();
std::span<const ThinOperation> thin_operations();
std::span<const TriangulateOperation> triangulate_operations();
std::span<const RepairOperation> repair_operations();
std::span<const SmoothOperation> smooth_operations();
std::span<const SimplifyOperation> simplify_operations();
std::span<const RefineOperation> refine_operations();

/// The families' names, and what the operations of one of them are; empty for an unknown family.
std::span<const std::string_view> families();
std::vector<OperationInfo> operations_of(std::string_view family);

/// A method as a user writes it: NAME[:key=value,...].
struct Method {
  std::string name;
  Settings settings;
};

/// Errors: invalid_argument with the text and the form that was expected.
Result<Method> parse_method(std::string_view text);

/// `method` as a user would write it.
std::string to_string(const Method& method);

/// The operation called `name`. Errors: invalid_argument that lists the names there are.
Result<const AverageOperation*> find_average(std::string_view name);
Result<const FilterOperation*> find_filter(std::string_view name);
Result<const CleanOperation*> find_clean(std::string_view name);
Result<const MergeOperation*> find_merge(std::string_view name);
Result<const FuseOperation*> find_fuse(std::string_view name);
Result<const ThinOperation*> find_thin(std::string_view name);
Result<const TriangulateOperation*> find_triangulate(std::string_view name);
Result<const RepairOperation*> find_repair(std::string_view name);
Result<const SmoothOperation*> find_smooth(std::string_view name);
Result<const SimplifyOperation*> find_simplify(std::string_view name);
Result<const RefineOperation*> find_refine(std::string_view name);

}  // namespace burnish
