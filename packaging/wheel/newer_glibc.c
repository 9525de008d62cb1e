// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// scripts/wheel links with the glibc of Debian 11. The static libraries of Debian 12 use three
// names that this glibc does not have; they are defined here, for the wheel alone.
#include <stdint.h>
#include <stdlib.h>
#include <sys/random.h>

#define HIDDEN __attribute__((visibility("hidden")))

// libstdc++: whether the process never had a second thread. With false, reference counts are always
// atomic.
HIDDEN char __libc_single_threaded = 0;

// Expat: random numbers for its hash tables.
HIDDEN void arc4random_buf(void* bytes, size_t size) {
  for (size_t done = 0; done < size;) {
    const ssize_t count = getrandom((char*)bytes + done, size - done, 0);
    if (count > 0) done += (size_t)count;
  }
}

// libstdc++: std::random_device.
HIDDEN uint32_t arc4random(void) {
  uint32_t number;
  arc4random_buf(&number, sizeof number);
  return number;
}
