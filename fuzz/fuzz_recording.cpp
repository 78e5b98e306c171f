// Feeds whatever libFuzzer makes up to the reader of one kind of recording.
#include "support/recording_promises.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  burnish::test::BURNISH_FUZZ_PROMISES({reinterpret_cast<const char*>(data), size});
  return 0;
}
