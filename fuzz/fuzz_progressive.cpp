// Feeds whatever libFuzzer makes up to the reader of progressive files, which here takes every
// check for right.
#include "support/progressive_promises.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  burnish::test::expect_progressive_promises_kept({reinterpret_cast<const char*>(data), size});
  return 0;
}
