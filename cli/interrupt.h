// Ctrl-C and termination: the first signal requests a stop, the second kills.
#pragma once

namespace pintle::cli {

/// From now on the first SIGINT or SIGTERM only sets a flag; the next one has its default effect. Signals within 0.3 s
/// of the first count as part of it: `timeout` and job runners signal a process and then its whole group. A signal that
/// the caller had disabled (nohup, background jobs) stays disabled.
void catch_interrupts();

/// Whether a signal has arrived.
bool interrupted();

}  // namespace pintle::cli
