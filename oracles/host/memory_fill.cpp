#include "oracles/host/diagnosis.h"

#include <cstring>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace touchstone::host {

// More stack than a query uses down to an engine's leaf functions; fits into a first-level cache.
static constexpr std::size_t stack_fill_bytes = 16384;

void fill_new_memory([[maybe_unused]] std::uint8_t byte) {
#if defined(M_PERTURB)
  static int now = -1;
  if (now == byte) return;
  now = byte;
  mallopt(M_PERTURB, byte ^ 0xff);  // malloc fills with the complement
#endif
}

[[gnu::noinline]] void fill_free_stack(std::uint8_t byte) {
  unsigned char area[stack_fill_bytes];
  std::memset(area, byte, sizeof area);
  asm volatile("" : : "r"(area) : "memory");  // otherwise the compiler would drop the memset
}

}  // namespace touchstone::host
