// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// In a file of its own, where the compiler does not see through it into the tests.
#include "io/counted_allocation.hpp"

#include <cstdlib>
#include <new>

void* operator new(std::size_t size) {
  using namespace flagstone::io;
  if (size > allowed || allocated > allowed - size) throw std::bad_alloc();
  allocated += size;
  void* const memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }
