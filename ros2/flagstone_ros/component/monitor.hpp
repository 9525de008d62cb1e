// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace flagstone_ros {

/// Facts about a segmented cloud for the diagnostics.
struct CloudSummary {
  double latency = 0;        ///< seconds from receipt to the end of publishing
  double out_of_range = 0;   ///< fraction of the finite points, 0 to 1
  double sensor_height = 0;  ///< metres, in use
  double tilt = 0;           ///< degrees, in use
  std::string mount;         ///< the result of the estimate, in words
};

/// The state of the node: levels as in diagnostic_msgs/DiagnosticStatus.
struct Diagnosis {
  enum class Level : std::uint8_t { ok = 0, warn = 1, error = 2 };
  Level level = Level::ok;
  std::string message;
  std::vector<std::pair<std::string, std::string>> values;  ///< keys as declared
};

/// Counts clouds and times for the diagnostics. Times are seconds on a steady clock. Thread-safe.
class Monitor {
 public:
  /// `now`: when the node started. `method`: the parameter.
  Monitor(double now, std::string method);

  /// A message has arrived.
  void received(double now);
  /// Clouds were dropped, because the node fell behind.
  void dropped(std::uint64_t count);
  /// A cloud could not be segmented. `reason` is one line.
  void skipped(std::string reason);
  /// A cloud was not segmented, because no output has a subscriber.
  void unheard();
  /// The outputs of a cloud have been published.
  void segmented(CloudSummary cloud);

  /// The state since the previous diagnosis; starts a new period.
  Diagnosis diagnose(double now);

 private:
  struct Period {
    double start = 0;
    std::uint64_t received = 0;
    std::uint64_t dropped = 0;
    std::uint64_t skipped = 0;
    std::uint64_t unheard = 0;
    std::vector<double> latencies;
  };

  [[nodiscard]] std::pair<Diagnosis::Level, std::string> state(double now) const;

  std::mutex mutex_;
  std::string method_;
  Period period_;
  double last_received_;
  bool has_received_ = false;
  std::uint64_t clouds_ = 0;
  std::uint64_t dropped_ = 0;
  std::uint64_t skipped_ = 0;
  std::string reason_;
  std::optional<CloudSummary> last_;
};

}  // namespace flagstone_ros
