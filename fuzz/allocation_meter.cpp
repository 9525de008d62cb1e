// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "allocation_meter.hpp"

#include <sanitizer/allocator_interface.h>

#include <atomic>
#include <cstdio>

#include "cloud_properties.hpp"

namespace flagstone::fuzz {
namespace {

std::atomic<std::size_t> allocated{0};

// Memory for the words, fields and names of a header, which max_fields limits.
constexpr std::size_t any_file = std::size_t{512} * 1024;

void count_allocation(const volatile void* /*pointer*/, std::size_t size) { allocated += size; }
void count_release(const volatile void* /*pointer*/) {}

}  // namespace

AllocationMeter::AllocationMeter() noexcept {
  static const int installed =
      __sanitizer_install_malloc_and_free_hooks(count_allocation, count_release);
  require(installed != 0, "allocations can be counted");
  allocated = 0;
}

void AllocationMeter::require_at_most(std::size_t factor, std::size_t file_size) const {
  if (allocated > factor * file_size + any_file) {
    std::fprintf(stderr, "%zu bytes allocated for a file of %zu\n", allocated.load(), file_size);
    require(false, "a reader allocates in proportion to the size of the file");
  }
}

}  // namespace flagstone::fuzz
