// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

namespace flagstone::io {

/// While it lives a test that runs as root, who may do anything, is somebody who may not.
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
