#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "burnish/base/context.h"
#include "burnish/base/error.h"

namespace burnish::app {

/// Shows how far a run is, on standard error: a bar on a terminal, a line for every finished stage
/// otherwise, and nothing at all for what takes less than a second.
class TerminalProgress : public ProgressSink {
 public:
  explicit TerminalProgress(bool quiet);
  ~TerminalProgress() override;

  void on_progress(double fraction) override;
  void on_stage(std::string_view name) override;

 private:
  using Clock = std::chrono::steady_clock;
  void draw();
  void erase();
  void finish_stage();

  bool quiet_, terminal_, drawn_ = false;
  Clock::time_point start_, stage_start_, last_draw_;
  std::string stage_;
  double fraction_ = 0;
};

/// The program's exit status for an error; docs/exit-status.md has the table.
int exit_status(ErrorCode code);

/// Prints "burnish: <error>" on standard error and returns the exit status.
int fail(const Error& error);

}  // namespace burnish::app
