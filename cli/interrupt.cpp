#include "cli/interrupt.h"

#include <time.h>

#include <csignal>
#include <initializer_list>

namespace pintle::cli {
namespace {

constexpr double kOneRequest = 0.3;  // s

volatile std::sig_atomic_t stop_asked = 0;
double asked_at = 0;  // s; read and written only by the handler

// Calls only what POSIX allows in a signal handler.
extern "C" void ask_to_stop(int signal) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const double t = static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  if (stop_asked == 0) {
    asked_at = t;
    stop_asked = 1;
  } else if (t - asked_at > kOneRequest) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM})
    if (std::signal(signal, ask_to_stop) == SIG_IGN) std::signal(signal, SIG_IGN);
}

bool interrupted() {
  return stop_asked != 0;
}

}  // namespace pintle::cli
