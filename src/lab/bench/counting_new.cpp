// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Counting operator new and delete, for programs only, never for a library. All forms are defined,
// because a sanitizer runtime supplies its own version of any missing form. Block sizes come from
// the allocator, so blocks need no extra header.
#include <cstdlib>
#include <new>

#include "lab/bench/allocation_count.hpp"

#ifdef __APPLE__
#include <malloc/malloc.h>
#else
#include <malloc.h>
#endif

namespace {

std::size_t size_of(void* memory) noexcept {
#ifdef __APPLE__
  return malloc_size(memory);
#else
  return malloc_usable_size(memory);
#endif
}

/// Tries until the new-handler gives up, as the C++ standard requires.
template <class Allocate>
void* allocate(Allocate try_once) {
  for (;;) {
    void* const memory = try_once();
    if (memory != nullptr) {
      flagstone::bench::count_new(size_of(memory));
      return memory;
    }
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

void* allocate_plain(std::size_t size) {
  return allocate([size] { return std::malloc(size == 0 ? 1 : size); });
}

void* allocate_aligned(std::size_t size, std::align_val_t alignment) {
  const auto align = static_cast<std::size_t>(alignment);
  const std::size_t whole =
      (size + align - 1) / align * align;  // aligned_alloc requires a multiple of the alignment
  if (whole < size) throw std::bad_alloc();
  return allocate([=] { return std::aligned_alloc(align, whole == 0 ? align : whole); });
}

/// Returns the result of `allocate`, or null if it throws.
template <class Allocate>
void* or_null(Allocate allocate) noexcept {
  try {
    return allocate();
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

void release(void* memory) noexcept {
  if (memory == nullptr) return;
  flagstone::bench::count_delete(size_of(memory));
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return allocate_plain(size); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate_aligned(size, alignment);
}
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  return or_null([=] { return allocate_plain(size); });
}
void* operator new(std::size_t size, std::align_val_t alignment,
                   const std::nothrow_t& /*tag*/) noexcept {
  return or_null([=] { return allocate_aligned(size, alignment); });
}

void* operator new[](std::size_t size) { return allocate_plain(size); }
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return allocate_aligned(size, alignment);
}
void* operator new[](std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  return or_null([=] { return allocate_plain(size); });
}
void* operator new[](std::size_t size, std::align_val_t alignment,
                     const std::nothrow_t& /*tag*/) noexcept {
  return or_null([=] { return allocate_aligned(size, alignment); });
}

void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept { release(memory); }
void operator delete(void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
  release(memory);
}
void operator delete(void* memory, const std::nothrow_t& /*tag*/) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t /*alignment*/,
                     const std::nothrow_t& /*tag*/) noexcept {
  release(memory);
}

void operator delete[](void* memory) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t /*size*/) noexcept { release(memory); }
void operator delete[](void* memory, std::align_val_t /*alignment*/) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t /*size*/,
                       std::align_val_t /*alignment*/) noexcept {
  release(memory);
}
void operator delete[](void* memory, const std::nothrow_t& /*tag*/) noexcept { release(memory); }
void operator delete[](void* memory, std::align_val_t /*alignment*/,
                       const std::nothrow_t& /*tag*/) noexcept {
  release(memory);
}
