// Registers of 256 and of 512 bits, if the processor at run time has them. The arithmetic is the same, without fused products, so
// that results agree bit for bit.
#pragma once

#include <memory>
#include <stdexcept>
#include <utility>

// The width in bits that code is compiled for, 128, 256 or 512; 0: all of them, and the processor decides at run time.
#ifndef PINTLE_REGISTERS
#define PINTLE_REGISTERS 0
#endif

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(PINTLE_NARROW)
/// Placed before a function: compiles it for wide registers, with everything that it calls inlined.
#define PINTLE_WIDE [[gnu::target("avx2"), gnu::flatten]]
/// The same for registers of 512 bits; data that does not fill one uses those of 256 bits, of which there are then 32 instead of 16.
#define PINTLE_WIDEST [[gnu::target("avx512f,avx512dq,avx512vl,prefer-vector-width=256"), gnu::flatten]]
#define PINTLE_BUILDS_128 (PINTLE_REGISTERS == 0 || PINTLE_REGISTERS == 128)
#define PINTLE_BUILDS_256 (PINTLE_REGISTERS == 0 || PINTLE_REGISTERS == 256)
#define PINTLE_BUILDS_512 (PINTLE_REGISTERS == 0 || PINTLE_REGISTERS == 512)
#else
#define PINTLE_WIDE
#define PINTLE_WIDEST
#define PINTLE_BUILDS_128 1
#define PINTLE_BUILDS_256 0
#define PINTLE_BUILDS_512 0
#endif

namespace pintle {

#if PINTLE_BUILDS_256 || PINTLE_BUILDS_512
inline bool has_wide_registers() { return __builtin_cpu_supports("avx2"); }
/// Registers of 512 bits.
inline bool has_widest_registers() {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}
#else
inline bool has_wide_registers() { return false; }
inline bool has_widest_registers() { return false; }
#endif

/// Ends the choice between the functions for the widths that are built, where the processor has none of these.
[[noreturn]] inline void refuse_processor() {
  throw std::runtime_error("this program was built for the registers of another machine's processor: build it on this machine, or with PINTLE_REGISTERS=ALL");
}

/// That of three implementations of Base that is compiled for the widest registers of this processor. Those that are not built are not
/// instantiated. Throws std::runtime_error if the processor lacks the registers of all that are.
template <class Base, class Narrow, class Wide, class Widest, class... Args>
std::unique_ptr<Base> make_for_processor(Args&&... args) {
  if constexpr (PINTLE_BUILDS_512)
    if (has_widest_registers()) return std::make_unique<Widest>(std::forward<Args>(args)...);
  if constexpr (PINTLE_BUILDS_256)
    if (has_wide_registers()) return std::make_unique<Wide>(std::forward<Args>(args)...);
  if constexpr (PINTLE_BUILDS_128) return std::make_unique<Narrow>(std::forward<Args>(args)...);
  else refuse_processor();
}

}  // namespace pintle
