// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <tuple>

#include "declaration.hpp"

namespace flagstone_ros {
namespace {

/// The values in the declared order. Values that are not set are omitted.
class Values {
 public:
  void set(std::string_view key, std::string value) { found_.emplace_back(key, std::move(value)); }

  void set(std::string_view key, double value) {
    for (const DiagnosticValue& declared : diagnostics) {
      if (declared.key == key) set(key, fmt::format("{:.{}f}", value, declared.decimals));
    }
  }

  [[nodiscard]] std::vector<std::pair<std::string, std::string>> in_order() const {
    std::vector<std::pair<std::string, std::string>> values;
    for (const DiagnosticValue& declared : diagnostics) {
      for (const auto& value : found_) {
        if (value.first == declared.key) values.push_back(value);
      }
    }
    return values;
  }

 private:
  std::vector<std::pair<std::string, std::string>> found_;
};

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

}  // namespace

Monitor::Monitor(double now, std::string method) : method_(std::move(method)), last_received_(now) {
  period_.start = now;
}

void Monitor::received(double now) {
  const std::scoped_lock lock(mutex_);
  ++period_.received;
  last_received_ = now;
  has_received_ = true;
}

void Monitor::dropped(std::uint64_t count) {
  const std::scoped_lock lock(mutex_);
  dropped_ += count;
  period_.dropped += count;
}

void Monitor::skipped(std::string reason) {
  const std::scoped_lock lock(mutex_);
  ++skipped_;
  ++period_.skipped;
  reason_ = std::move(reason);
}

void Monitor::unheard() {
  const std::scoped_lock lock(mutex_);
  ++period_.unheard;
}

void Monitor::segmented(CloudSummary cloud) {
  const std::scoped_lock lock(mutex_);
  ++clouds_;
  period_.latencies.push_back(cloud.latency);
  last_ = std::move(cloud);
}

std::pair<Diagnosis::Level, std::string> Monitor::state(double now) const {
  using enum Diagnosis::Level;
  const double silence = now - last_received_;
  if (silence > silence_seconds) {
    return {warn, has_received_ ? fmt::format("no cloud for {:.1f} s", silence)
                                : "no cloud has arrived yet"};
  }
  if (!has_received_) return {ok, "waiting for the first cloud"};
  const bool has_segmented = !period_.latencies.empty();
  if (period_.skipped > 0 && !has_segmented) {
    return {error, "no cloud could be segmented: " + reason_};
  }
  if (period_.skipped > 0) {
    return {warn,
            fmt::format("{} of {} clouds skipped: {}", period_.skipped, period_.received, reason_)};
  }
  if (period_.dropped > 0) {
    return {warn, fmt::format("{} of {} clouds dropped: the node falls behind", period_.dropped,
                              period_.received)};
  }
  if (last_ && last_->out_of_range > mostly_out_of_range) {
    return {warn, "most points are out of range (expected metres, origin at the sensor)"};
  }
  if (period_.unheard > 0 && !has_segmented) return {ok, "no output has a subscriber"};
  return {ok, "clouds are segmented"};
}

Diagnosis Monitor::diagnose(double now) {
  const std::scoped_lock lock(mutex_);
  Diagnosis diagnosis;
  std::tie(diagnosis.level, diagnosis.message) = state(now);
  std::vector<double>& latencies = period_.latencies;

  Values values;
  values.set("method", method_);
  values.set("clouds", fmt::format("{}", clouds_));
  const double elapsed = now - period_.start;
  if (elapsed > 0) values.set("rate (Hz)", static_cast<double>(latencies.size()) / elapsed);
  if (!latencies.empty()) {
    values.set("latency, worst (ms)", 1e3 * *std::ranges::max_element(latencies));
    values.set("latency, median (ms)", 1e3 * median(latencies));
  }
  values.set("dropped", fmt::format("{}", dropped_));
  values.set("skipped", fmt::format("{}", skipped_));
  if (last_) {
    values.set("out of range (%)", 100 * last_->out_of_range);
    values.set("sensor height (m)", last_->sensor_height);
    values.set("tilt (degrees)", last_->tilt);
    values.set("mount", last_->mount);
  }
  diagnosis.values = values.in_order();

  period_ = {};
  period_.start = now;
  return diagnosis;
}

}  // namespace flagstone_ros
