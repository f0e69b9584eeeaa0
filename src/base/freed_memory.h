// Retains freed memory for reuse.
#pragma once

namespace pintle {

/// Freed memory stays with the process from now on, for the next model, start or run to take. Otherwise the C library hands large
/// pieces back at once, and the system hands them out again page by page, cleared: where it is a virtual machine that takes a third
/// of the time of a start. For programs, as their first act; a library leaves this choice to its program. Nothing but glibc has it;
/// elsewhere this does nothing.
void keep_freed_memory();

}  // namespace pintle
