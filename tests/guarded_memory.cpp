// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "guarded_memory.hpp"

#ifdef _WIN32
#include <windows.h>
#else
#include <sys/mman.h>
#include <unistd.h>
#endif

#include <new>

namespace flagstone::tests {

#ifdef _WIN32

GuardedMemory::GuardedMemory(std::size_t size) : page_(4096) {
  size_ = (size + page_ - 1) / page_ * page_;
  void* const all = VirtualAlloc(nullptr, size_ + 2 * page_, MEM_RESERVE, PAGE_NOACCESS);
  if (all == nullptr) throw std::bad_alloc();
  bytes_ = static_cast<std::byte*>(all) + page_;
  if (VirtualAlloc(bytes_, size_, MEM_COMMIT, PAGE_READWRITE) == nullptr) throw std::bad_alloc();
}

GuardedMemory::~GuardedMemory() { VirtualFree(bytes_ - page_, 0, MEM_RELEASE); }

#else

GuardedMemory::GuardedMemory(std::size_t size)
    : page_(static_cast<std::size_t>(sysconf(_SC_PAGESIZE))) {
  size_ = (size + page_ - 1) / page_ * page_;
  void* const all = mmap(nullptr, size_ + 2 * page_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (all == MAP_FAILED) throw std::bad_alloc();  // NOLINT: the system's macro
  bytes_ = static_cast<std::byte*>(all) + page_;
  if (mprotect(bytes_, size_, PROT_READ | PROT_WRITE) != 0) throw std::bad_alloc();
}

GuardedMemory::~GuardedMemory() { munmap(bytes_ - page_, size_ + 2 * page_); }

#endif

}  // namespace flagstone::tests
