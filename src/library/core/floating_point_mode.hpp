// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#if defined(__x86_64__) || defined(__i386__)
#include <immintrin.h>
#endif

namespace flagstone {

/// RAII guard that sets the floating-point mode of the current thread and restores it on
/// destruction, so that results do not depend on the host program: round to nearest, exceptions
/// masked, denormals (below 1.2e-38, or 2.2e-308 in double) flushed to zero. Denormals can be up to
/// a hundred times slower and never occur as real lengths. Has no effect on CPUs other than x86 and
/// 64-bit Arm.
class ScopedFloatingPointMode {
 public:
  ScopedFloatingPointMode() noexcept : before_(read()) { write(ours); }
  ~ScopedFloatingPointMode() { write(before_); }
  ScopedFloatingPointMode(const ScopedFloatingPointMode&) = delete;
  ScopedFloatingPointMode& operator=(const ScopedFloatingPointMode&) = delete;

 private:
#if defined(__x86_64__) || defined(__i386__)
  using Control = std::uint32_t;
  static constexpr Control ours = 0x9FC0;  // all traps masked, flush to zero, denormals are zero
  static Control read() noexcept { return _mm_getcsr(); }
  static void write(Control control) noexcept { _mm_setcsr(control); }
#elif defined(__aarch64__)
  using Control = std::uint64_t;
  static constexpr Control ours = 1U << 24U;  // FZ
  static Control read() noexcept {
    Control control = 0;
    asm volatile("mrs %0, fpcr" : "=r"(control) : : "memory");
    return control;
  }
  static void write(Control control) noexcept {
    asm volatile("msr fpcr, %0" : : "r"(control) : "memory");
  }
#else
  using Control = std::uint32_t;
  static constexpr Control ours = 0;
  static Control read() noexcept { return 0; }
  static void write(Control) noexcept {}
#endif

  Control before_;
};

}  // namespace flagstone
