// Feeds whatever libFuzzer makes up to the reader of one format.
#include "support/reader_promises.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const burnish::FileFormat& format : burnish::geometry_formats()) {
    if (format.name != BURNISH_FUZZ_FORMAT) continue;
    burnish::test::expect_promises_kept(format, {reinterpret_cast<const char*>(data), size});
  }
  return 0;
}
