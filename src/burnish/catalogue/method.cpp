#include <fmt/format.h>

#include "burnish/catalogue/operations.h"

namespace burnish {
namespace {

template <class Op>
Result<const Op*> find_in(std::span<const Op> list, std::string_view family,
                          std::string_view name) {
  std::string known;
  for (const Op& operation : list) {
    if (operation.info.name == name) return &operation;
    known += (known.empty() ? "" : ", ") + operation.info.name;
  }
  return Error{ErrorCode::invalid_argument,
               fmt::format("'{}' is no method to {}, known: {}", name, family, known),
               {}};
}

template <class Op>
std::vector<OperationInfo> infos(std::span<const Op> list) {
  std::vector<OperationInfo> result;
  for (const Op& operation : list) result.push_back(operation.info);
  return result;
}

}  // namespace

std::span<const std::string_view> families() {
  static constexpr std::string_view kFamilies[] = {"average", "filter",   "clean",       "merge",
                                                   "fuse",    "thin",     "triangulate", "repair",
                                                   "smooth",  "simplify", "refine"};
  return kFamilies;
}

std::vector<OperationInfo> operations_of(std::string_view family) {
  if (family == "average") return infos(average_operations());
  if (family == "filter") return infos(filter_operations());
  if (family == "clean") return infos(clean_operations());
  if (family == "merge") return infos(merge_operations());
  if (family == "fuse") return infos(fuse_operations());
  if (family == "thin") return infos(thin_operations());
  if (family == "triangulate") return infos(triangulate_operations());
  if (family == "repair") return infos(repair_operations());
  if (family == "smooth") return infos(smooth_operations());
  if (family == "simplify") return infos(simplify_operations());
  if (family == "refine") return infos(refine_operations());
  return {};
}

Result<const AverageOperation*> find_average(std::string_view name) {
  return find_in(average_operations(), "average", name);
}
Result<const FilterOperation*> find_filter(std::string_view name) {
  return find_in(filter_operations(), "filter", name);
}
Result<const CleanOperation*> find_clean(std::string_view name) {
  return find_in(clean_operations(), "clean", name);
}
Result<const MergeOperation*> find_merge(std::string_view name) {
  return find_in(merge_operations(), "merge", name);
}
Result<const FuseOperation*> find_fuse(std::string_view name) {
  return find_in(fuse_operations(), "fuse", name);
}
Result<const ThinOperation*> find_thin(std::string_view name) {
  return find_in(thin_operations(), "thin", name);
}
Result<const TriangulateOperation*> find_triangulate(std::string_view name) {
  return find_in(triangulate_operations(), "triangulate", name);
}
Result<const RepairOperation*> find_repair(std::string_view name) {
  return find_in(repair_operations(), "repair", name);
}
Result<const SmoothOperation*> find_smooth(std::string_view name) {
  return find_in(smooth_operations(), "smooth", name);
}
Result<const SimplifyOperation*> find_simplify(std::string_view name) {
  return find_in(simplify_operations(), "simplify", name);
}
Result<const RefineOperation*> find_refine(std::string_view name) {
  return find_in(refine_operations(), "refine", name);
}

Result<Method> parse_method(std::string_view text) {
  const auto malformed = [&] {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("'{}' is not of the form NAME[:key=value,...]", text),
                 {}};
  };
  const std::size_t colon = text.find(':');
  Method method{std::string(text.substr(0, colon)), {}};
  if (method.name.empty()) return malformed();
  std::string_view rest =
      colon == std::string_view::npos ? std::string_view{} : text.substr(colon + 1);
  if (colon != std::string_view::npos && rest.empty()) return malformed();
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    const std::string_view pair = rest.substr(0, comma);
    const std::size_t equals = pair.find('=');
    if (equals == 0 || equals == std::string_view::npos || equals + 1 == pair.size())
      return malformed();
    method.settings.emplace_back(pair.substr(0, equals), pair.substr(equals + 1));
    if (comma == std::string_view::npos) break;
    rest = rest.substr(comma + 1);
    if (rest.empty()) return malformed();
  }
  return method;
}

std::string to_string(const Method& method) {
  std::string text = method.name;
  char separator = ':';
  for (const auto& [key, value] : method.settings) {
    text += fmt::format("{}{}={}", separator, key, value);
    separator = ',';
  }
  return text;
}

}  // namespace burnish
