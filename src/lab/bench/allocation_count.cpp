// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/bench/allocation_count.hpp"

#include <atomic>
#include <new>

namespace flagstone::bench {
namespace {

std::atomic<std::size_t> calls = 0;
std::atomic<std::size_t> bytes_held = 0;

}  // namespace

AllocationCount allocation_count() noexcept {
  return {.calls = calls.load(std::memory_order_relaxed),
          .bytes = bytes_held.load(std::memory_order_relaxed)};
}

bool allocations_are_counted() {
  const std::size_t before = allocation_count().calls;
  ::operator delete(::operator new(1));
  return allocation_count().calls > before;
}

void count_new(std::size_t bytes) noexcept {
  calls.fetch_add(1, std::memory_order_relaxed);
  bytes_held.fetch_add(bytes, std::memory_order_relaxed);
}

void count_delete(std::size_t bytes) noexcept {
  bytes_held.fetch_sub(bytes, std::memory_order_relaxed);
}

}  // namespace flagstone::bench
