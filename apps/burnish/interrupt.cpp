#include "interrupt.h"

#include <pthread.h>
#include <signal.h>

namespace burnish::app {
namespace {

constexpr int kEnd = SIGUSR1;  ///< the watcher's own "no more"

sigset_t watched_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, kEnd);
  return signals;
}

}  // namespace

Interrupt::Interrupt() {
  const sigset_t signals = watched_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  watcher_ = std::thread([this, signals] {
    int signal = 0;
    while (sigwait(&signals, &signal) == 0 && signal != kEnd) source_.request_stop();
  });
}

Interrupt::~Interrupt() {
  pthread_kill(watcher_.native_handle(), kEnd);
  watcher_.join();
}

}  // namespace burnish::app
