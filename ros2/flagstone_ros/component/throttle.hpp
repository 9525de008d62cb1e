// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace flagstone_ros {

/// Lets one line per problem and period pass, with the number of lines that it withheld before. Not
/// thread-safe.
class Throttle {
 public:
  /// `period`: minimum time between two lines about the same problem, seconds.
  explicit Throttle(double period) : period_(period) {}

  /// The line to log, if any. `problem` identifies the problem; lines about other problems have no
  /// effect on it. `now`: seconds on a steady clock.
  [[nodiscard]] std::optional<std::string> line(std::string_view problem, std::string_view text,
                                                double now);

 private:
  struct Logged {
    double time = 0;
    std::size_t withheld = 0;
  };
  double period_;
  std::map<std::string, Logged, std::less<>> logged_;
};

}  // namespace flagstone_ros
