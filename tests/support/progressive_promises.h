#pragma once

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "burnish/pipeline/progressive_file.h"

namespace burnish::test {

/// What the reader of progressive files promises, whatever the bytes are: a sound mesh, or an error
/// with a message that names the file. Ends the process where it is broken, as fuzzers want it.
inline void expect_progressive_promises_kept(std::string_view bytes) {
  const auto require = [](bool condition, const char* what) {
    if (condition) return;
    std::fprintf(stderr, "progressive file: broken promise: %s\n", what);
    std::abort();
  };
  const auto require_sound = [&](const Result<ProgressiveLevel>& level) {
    if (level) {
      require(check(level->mesh).has_value(), "the mesh is sound");
      require(level->bytes_read <= bytes.size(), "no byte is read that is not there");
      return;
    }
    require(!level.error().message.empty(), "an error has a message");
    require(level.error().where.find("input") != std::string::npos, "an error names the file");
  };
  const auto all = parse_progressive(bytes, "input");
  require_sound(all);
  const auto some = parse_progressive(bytes, "input", {.triangles = 20, .error = {}});
  require_sound(some);
  require(some || !all, "a level can be had where all can");
  if (some && some->records > 0) {
    const auto again = parse_progressive(bytes.substr(0, some->bytes_read), "input");
    require(again && again->mesh.positions.size() == some->mesh.positions.size(),
            "a beginning is a file");
  }
}

}  // namespace burnish::test
