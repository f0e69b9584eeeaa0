// Registers of 256 and of 512 bits, if the processor at run time has them. The arithmetic is the same, without fused products, so
// that results agree bit for bit.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(PINTLE_NARROW)
/// Placed before a function: compiles it for wide registers, with everything that it calls inlined.
#define PINTLE_WIDE [[gnu::target("avx2"), gnu::flatten]]
/// The same for registers of 512 bits; data that does not fill one uses those of 256 bits, of which there are then 32 instead of 16.
#define PINTLE_WIDEST [[gnu::target("avx512f,avx512dq,avx512vl,prefer-vector-width=256"), gnu::flatten]]

namespace pintle {
inline bool has_wide_registers() { return __builtin_cpu_supports("avx2"); }
/// Registers of 512 bits.
inline bool has_widest_registers() {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}
}  // namespace pintle
#endif
