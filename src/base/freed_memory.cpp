#include "base/freed_memory.h"

#include <cstdlib>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace pintle {

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kMega = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * kMega);  // the largest value that glibc accepts; larger blocks still get mappings of their own
  mallopt(M_TRIM_THRESHOLD, 1024 * kMega);
  mallopt(M_TOP_PAD, kMega);
#endif
}

}  // namespace pintle
