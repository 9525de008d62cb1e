// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// In a separate file, so that the compiler cannot inline it into the tests.
#include "counted_allocation.hpp"

#include <cstdlib>
#include <new>

namespace {

/// Counts `size` bytes; throws if they are not allowed.
void take(std::size_t size) {
  using namespace flagstone::io;
  if (size > allowed || allocated > allowed - size) throw std::bad_alloc();
  allocated += size;
  ++blocks;
}

void give_back(void* memory) noexcept {
  if (memory != nullptr) --flagstone::io::blocks;
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) {
  take(size);
  void* const memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void* operator new(std::size_t size, std::align_val_t alignment) {
  take(size);
  const auto step = static_cast<std::size_t>(alignment);
  void* const memory = std::aligned_alloc(step, (size + step) / step * step);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void operator delete(void* memory) noexcept { give_back(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { give_back(memory); }
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept { give_back(memory); }
