// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

namespace flagstone::bench {

/// RAII guard that pins the calling thread, and the processes that it starts, to the first core it
/// may use, so that times are measured on one core. Only Linux supports this.
class PinnedCore {
 public:
  PinnedCore();
  ~PinnedCore();
  PinnedCore(const PinnedCore&) = delete;
  PinnedCore& operator=(const PinnedCore&) = delete;
  PinnedCore(PinnedCore&&) = delete;
  PinnedCore& operator=(PinnedCore&&) = delete;

  /// Number of the core; nullopt if the thread is not pinned.
  [[nodiscard]] std::optional<int> core() const noexcept { return core_; }

 private:
  std::optional<int> core_;
  std::vector<int> allowed_before_;
};

}  // namespace flagstone::bench
