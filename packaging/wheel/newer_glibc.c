// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// scripts/wheel links with the glibc of Debian 11. The static libraries of Debian 12 use two names that this glibc does not
// have; they are defined here, for the wheel alone.
#include <stdlib.h>
#include <sys/random.h>

// libstdc++: whether the process never had a second thread. With false, reference counts are always atomic.
__attribute__((visibility("hidden"))) char __libc_single_threaded = 0;

// Expat: random numbers for its hash tables.
__attribute__((visibility("hidden"))) void arc4random_buf(void* bytes, size_t size) {
  for (size_t done = 0; done < size;) {
    const ssize_t count = getrandom((char*)bytes + done, size - done, 0);
    if (count > 0) done += (size_t)count;
  }
}
