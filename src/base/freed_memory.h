// Retains freed memory for reuse.
#pragma once

namespace pintle {

/// Makes the process keep freed memory from now on, for reuse by the next model, start or run. Otherwise the C library returns
/// large blocks at once, and the system hands them out again page by page, cleared: in a virtual machine this takes a third of the
/// time of a start. To be called by a program as its first action; a library leaves this choice to its program. Only glibc supports
/// it; elsewhere this does nothing.
void keep_freed_memory();

}  // namespace pintle
