#pragma once

#include <cstddef>

namespace burnish::test {

/// How often this program has allocated memory by operator new, which counted_allocations.cpp
/// replaces for all of it.
std::size_t allocations();

}  // namespace burnish::test
