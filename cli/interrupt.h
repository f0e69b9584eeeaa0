// Ctrl-C and termination: the first asks politely, the second kills.
#pragma once

namespace pintle::cli {

/// From now on the first SIGINT or SIGTERM only sets a flag; the next one does what it always does. Those that follow
/// within 0.3 s belong to the first: `timeout` and job runners signal a process and then its whole group. A signal that
/// the caller had switched off (nohup, background jobs) stays off.
void catch_interrupts();

/// Whether one has arrived.
bool interrupted();

}  // namespace pintle::cli
