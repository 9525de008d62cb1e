// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

namespace flagstone::io {

/// RAII guard that drops root privileges, so that file permissions apply to tests run as root.
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

}  // namespace flagstone::io
