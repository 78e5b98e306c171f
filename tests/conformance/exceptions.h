#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "burnish/base/schema.h"
#include "conformance/workpiece.h"

namespace burnish::test {

/// Why an operation need not have a property; empty where it must. The table is the one place where
/// the conformance suite lets something pass, and an exception that is not needed fails it.
std::string_view exception(std::string_view operation, std::string_view property);

/// Every (operation, property) in the table.
struct Exception {
  std::string_view operation, property, reason;
};
std::span<const Exception> exceptions();

/// What a field needs to matter: other settings, for example the mode that reads it, and another
/// input, for example one that lacks what the field stands in for.
struct Companion {
  std::string_view operation, field;
  Settings settings;
  std::function<void(Workpiece&)> alter;
};
/// Empty where the field needs nothing.
Companion companion(std::string_view operation, std::string_view field);

}  // namespace burnish::test
