// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

namespace flagstone::bench {

/// Keeps the calling thread, and the processes it starts, on the first core it may use, so that
/// times are those of one core; lets it go again at the end of its life. Only Linux can do that.
class PinnedCore {
 public:
  PinnedCore();
  ~PinnedCore();
  PinnedCore(const PinnedCore&) = delete;
  PinnedCore& operator=(const PinnedCore&) = delete;
  PinnedCore(PinnedCore&&) = delete;
  PinnedCore& operator=(PinnedCore&&) = delete;

  /// Number of the core; none where the system does not pin.
  [[nodiscard]] std::optional<int> core() const noexcept { return core_; }

 private:
  std::optional<int> core_;
  std::vector<int> allowed_before_;
};

}  // namespace flagstone::bench
