#pragma once

#include <stop_token>
#include <thread>

namespace burnish::app {

/// Turns Ctrl-C (SIGINT) and SIGTERM into a stop request for as long as it lives: a thread of its
/// own waits for the signal, so that nothing runs inside a signal handler. Create it before any
/// other thread, or their share of the signals would go to the default handler.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::thread watcher_;
};

}  // namespace burnish::app
