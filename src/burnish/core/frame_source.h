#pragma once

#include <cstddef>
#include <span>

#include "burnish/base/context.h"
#include "burnish/base/result.h"
#include "burnish/core/depth_frame.h"

namespace burnish {

/// Depth frames that are handed out one at a time, as often as they are asked for, so that nobody
/// has to hold them all.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual std::size_t size() const = 0;
  /// Frame `i` < size(), the same every time.
  virtual Result<DepthFrame> read(std::size_t i, const Context& context) const = 0;
};

/// Frames in memory, which must outlive this.
class FramesInMemory : public FrameSource {
 public:
  explicit FramesInMemory(std::span<const DepthFrame> frames) : frames_(frames) {}

  std::size_t size() const override { return frames_.size(); }
  Result<DepthFrame> read(std::size_t i, const Context&) const override { return frames_[i]; }

 private:
  std::span<const DepthFrame> frames_;
};

}  // namespace burnish
