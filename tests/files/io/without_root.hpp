// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#ifndef _WIN32
#include <unistd.h>
#endif

namespace flagstone::io {

/// RAII guard that drops root privileges, so that file permissions apply to tests run as root. Has
/// no effect on Windows.
#ifdef _WIN32
struct [[maybe_unused]] WithoutRoot {};
#else
class WithoutRoot {
 public:
  WithoutRoot() : was_root_(::geteuid() == 0 && ::seteuid(nobody) == 0) {}
  WithoutRoot(const WithoutRoot&) = delete;
  WithoutRoot& operator=(const WithoutRoot&) = delete;
  WithoutRoot(WithoutRoot&&) = delete;
  WithoutRoot& operator=(WithoutRoot&&) = delete;
  ~WithoutRoot() {
    if (was_root_ && ::seteuid(0) != 0) ::_exit(1);
  }

 private:
  static constexpr uid_t nobody = 65534;
  bool was_root_;
};
#endif

}  // namespace flagstone::io
