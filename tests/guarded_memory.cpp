// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "guarded_memory.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <new>

namespace flagstone::tests {

GuardedMemory::GuardedMemory(std::size_t size)
    : page_(static_cast<std::size_t>(sysconf(_SC_PAGESIZE))) {
  size_ = (size + page_ - 1) / page_ * page_;
  void* const all = mmap(nullptr, size_ + 2 * page_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (all == MAP_FAILED) throw std::bad_alloc();  // NOLINT: the system's macro
  bytes_ = static_cast<std::byte*>(all) + page_;
  if (mprotect(bytes_, size_, PROT_READ | PROT_WRITE) != 0) throw std::bad_alloc();
}

GuardedMemory::~GuardedMemory() { munmap(bytes_ - page_, size_ + 2 * page_); }

}  // namespace flagstone::tests
