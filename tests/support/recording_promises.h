#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "burnish/sensor/recording_azure.h"
#include "burnish/sensor/recording_klg.h"
#include "burnish/sensor/recording_oni.h"
#include "burnish/sensor/recording_pclzf.h"

namespace burnish::test {

/// Ends the process where a promise is broken, as fuzzers want it.
inline void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

inline void expect_error_with_place(const Error& error) {
  require(!error.message.empty(), "an error has a message");
  require(error.where.starts_with("input, "), "an error names the file and the place");
}

/// What all readers promise, whatever the bytes are: sound images, or an error with its place.
inline void expect_sound_frames(const Result<std::unique_ptr<Recording>>& recording) {
  if (!recording) return expect_error_with_place(recording.error());
  require((*recording)->size() > 0, "a recording has frames");
  for (std::size_t i = 0; i < std::min<std::size_t>((*recording)->size(), 4); ++i) {
    const auto frame = (*recording)->read(i);
    if (!frame) return expect_error_with_place(frame.error());
    require(frame->depth.size() == std::size_t{frame->width} * frame->height && frame->width > 0,
            "a frame has all its pixels");
  }
}

inline void expect_klg_promises_kept(std::string_view bytes) {
  expect_sound_frames(open_klg(bytes, "input"));
}

inline void expect_azure_promises_kept(std::string_view bytes) {
  expect_sound_frames(open_azure(bytes, "input", {}));
}

inline void expect_oni_promises_kept(std::string_view bytes) {
  expect_sound_frames(open_oni(bytes, "input", {}));
}

inline void expect_pclzf_promises_kept(std::string_view bytes) {
  const auto image = decode_pclzf(bytes, "input");
  if (!image) return expect_error_with_place(image.error());
  const std::size_t pixels = std::size_t{image->width} * image->height;
  require(pixels > 0 && image->values.size() >= pixels && image->values.size() <= 3 * pixels,
          "an image has all its pixels");
}

}  // namespace burnish::test
