// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/bench/pinned_core.hpp"

#ifdef __linux__
#include <sched.h>
#endif

namespace flagstone::bench {

#ifdef __linux__

namespace {

bool allow(const std::vector<int>& cores) {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int core : cores) CPU_SET(static_cast<unsigned>(core), &set);
  return ::sched_setaffinity(0, sizeof set, &set) == 0;
}

}  // namespace

PinnedCore::PinnedCore() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof set, &set) != 0)
    return;  // for example on more than 1,024 cores
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (CPU_ISSET(static_cast<unsigned>(core), &set)) allowed_before_.push_back(core);
  }
  if (!allowed_before_.empty() && allow({allowed_before_.front()})) core_ = allowed_before_.front();
}

PinnedCore::~PinnedCore() {
  if (core_) allow(allowed_before_);
}

#else

PinnedCore::PinnedCore() = default;
PinnedCore::~PinnedCore() = default;

#endif

}  // namespace flagstone::bench
