// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "throttle.hpp"

#include <fmt/format.h>

namespace flagstone_ros {

std::optional<std::string> Throttle::line(std::string_view problem, std::string_view text,
                                          double now) {
  const auto [entry, is_new] = logged_.try_emplace(std::string(problem), Logged{.time = now});
  Logged& last = entry->second;
  if (!is_new && now - last.time < period_) {
    ++last.withheld;
    return std::nullopt;
  }
  const std::size_t withheld = last.withheld;
  last = {.time = now};
  if (withheld == 0) return std::string(text);
  return fmt::format("{} [{} more since the last line]", text, withheld);
}

}  // namespace flagstone_ros
