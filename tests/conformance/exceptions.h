#pragma once

#include <span>
#include <string_view>

#include "burnish/base/schema.h"

namespace burnish::test {

/// Why an operation need not have a property; empty where it must. The table is the one place where
/// the conformance suite lets something pass, and an exception that is not needed fails it.
std::string_view exception(std::string_view operation, std::string_view property);

/// Every (operation, property) in the table.
struct Exception {
  std::string_view operation, property, reason;
};
std::span<const Exception> exceptions();

/// What must be set beside a field so that it matters, for example the mode that reads it.
Settings companions(std::string_view operation, std::string_view field);

}  // namespace burnish::test
