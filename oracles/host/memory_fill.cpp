#include "oracles/host/memory_fill.h"

#include <cstring>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace touchstone::host {

void fill_new_memory([[maybe_unused]] std::uint8_t byte) {
#if defined(M_PERTURB)
  static int now = -1;
  if (now == byte) return;
  now = byte;
  mallopt(M_PERTURB, byte ^ 0xff);  // malloc fills with the complement
#endif
}

[[gnu::noinline]] void fill_free_stack(std::uint8_t byte) {
  // More than the frames of a query that reach an engine's leaf functions; within a first-level cache.
  unsigned char area[16384];
  std::memset(area, byte, sizeof area);
  asm volatile("" : : "r"(area) : "memory");  // or nothing of it would be written
}

}  // namespace touchstone::host
