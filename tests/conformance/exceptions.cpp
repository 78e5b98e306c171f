#include "conformance/exceptions.h"

namespace burnish::test {

std::span<const Exception> exceptions() {
  static const std::vector<Exception> table{};
  return table;
}

std::string_view exception(std::string_view operation, std::string_view property) {
  for (const Exception& entry : exceptions()) {
    if (entry.operation == operation && entry.property == property) return entry.reason;
  }
  return {};
}

Settings companions(std::string_view operation, std::string_view field) {
  struct Companion {
    std::string_view operation, field;
    Settings settings;
  };
  static const std::vector<Companion> table{};
  for (const Companion& entry : table) {
    if (entry.operation == operation && entry.field == field) return entry.settings;
  }
  return {};
}

}  // namespace burnish::test
