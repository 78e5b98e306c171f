#include "terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace burnish::app {
namespace {

constexpr auto kPatience = std::chrono::seconds(1);
constexpr auto kRedraw = std::chrono::milliseconds(100);
constexpr int kBarWidth = 30;

double seconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double>(d).count();
}

}  // namespace

TerminalProgress::TerminalProgress(bool quiet)
    : quiet_(quiet),
      terminal_(::isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      stage_start_(start_),
      last_draw_(start_) {}

TerminalProgress::~TerminalProgress() {
  finish_stage();
}

void TerminalProgress::on_stage(std::string_view name) {
  finish_stage();
  stage_ = name;
  stage_start_ = Clock::now();
}

void TerminalProgress::on_progress(double fraction) {
  fraction_ = std::max(fraction_, fraction);
  const auto now = Clock::now();
  if (quiet_ || !terminal_ || now - start_ < kPatience || now - last_draw_ < kRedraw) return;
  last_draw_ = now;
  draw();
}

void TerminalProgress::draw() {
  const int filled = static_cast<int>(fraction_ * kBarWidth);
  fmt::print(stderr, "\r\x1b[K[{:=<{}}{: <{}}] {:3.0f} %  {}", "", filled, "", kBarWidth - filled,
             fraction_ * 100, stage_);
  std::fflush(stderr);
  drawn_ = true;
}

void TerminalProgress::erase() {
  if (drawn_) fmt::print(stderr, "\r\x1b[K");
  drawn_ = false;
}

void TerminalProgress::finish_stage() {
  const auto taken = Clock::now() - stage_start_;
  erase();
  if (!quiet_ && !terminal_ && !stage_.empty() && taken >= kPatience) {
    fmt::print(stderr, "{} ({:.1f} s)\n", stage_, seconds(taken));
  }
  stage_.clear();
}

int exit_status(ErrorCode code) {
  switch (code) {
    case ErrorCode::invalid_argument:
      return 2;
    case ErrorCode::not_found:
      return 3;
    case ErrorCode::bad_file:
      return 4;
    case ErrorCode::unsupported:
      return 5;
    case ErrorCode::bad_geometry:
      return 6;
    case ErrorCode::io_failure:
      return 7;
    case ErrorCode::out_of_memory:
      return 8;
    case ErrorCode::refuted:
      return 9;
    case ErrorCode::cancelled:
      return 130;
  }
  return 1;
}

int fail(const Error& error) {
  fmt::print(stderr, "burnish: {}\n", error.text());
  return exit_status(error.code);
}

}  // namespace burnish::app
