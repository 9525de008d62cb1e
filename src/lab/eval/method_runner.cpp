// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/method_runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "lab/baselines/settings.hpp"

namespace flagstone::eval {
namespace {

/// Do mean heights above the horizon, as seen from the sensor, rise from ring to ring? Some sensors
/// number their rings from the top.
bool lowest_come_first(CloudView cloud, const std::vector<std::uint16_t>& rings,
                       std::size_t count) {
  std::vector<double> sums(count);
  std::vector<double> points(count);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point p = cloud[i];
    const double squared = static_cast<double>(p.x) * p.x + static_cast<double>(p.y) * p.y;
    if (!(squared > 0) || !(squared < 1e12)) continue;  // nor NaN
    sums[rings[i]] += p.z / std::sqrt(squared);
    points[rings[i]] += 1;
  }
  double below = -std::numeric_limits<double>::infinity();
  for (std::size_t ring = 0; ring < count; ++ring) {
    if (points[ring] == 0) continue;
    const double mean = sums[ring] / points[ring];
    if (!(mean > below)) return false;
    below = mean;
  }
  return true;
}

}  // namespace

/// CascadedSeg, told the rings of the next scan.
class MethodRunner::OnRings final : public Segmenter {
 public:
  explicit OnRings(const CascadedConfig& config) : cascaded_(config) {}

  Status segment(CloudView cloud, Segmentation& result) noexcept override {
    return has_rings ? cascaded_.segment(cloud, rings, result) : cascaded_.segment(cloud, result);
  }
  [[nodiscard]] std::size_t beams() const { return cascaded_.config().beam_elevations.size(); }

  std::vector<std::uint16_t> rings;
  bool has_rings = false;

 private:
  Cascaded cascaded_;
};

MethodRunner::MethodRunner(std::string_view name, const MethodConfig& config,
                           const MountSettings& mount) {
  std::unique_ptr<Segmenter> method;
  if (const auto* settings = std::get_if<CascadedConfig>(&config)) {
    auto on_rings = std::make_unique<OnRings>(*settings);
    on_rings_ = on_rings.get();
    method = std::move(on_rings);
  } else {
    method = make_segmenter(name, config);
  }
  const float method_height = sensor_height_of(config, mount.mount.sensor_height);
  levelled_ = std::make_unique<GravityAlignedSegmenter>(std::move(method), method_height, mount);
}

bool MethodRunner::find_rings(const io::Cloud& cloud) {
  const io::Field* field = cloud.find("ring");
  if (field == nullptr || cloud.empty()) return false;
  const std::size_t beams = on_rings_->beams();
  std::vector<std::uint16_t>& rings = on_rings_->rings;
  rings.resize(cloud.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double ring = cloud.value(i, *field);
    const bool is_one = ring >= 0 && ring < static_cast<double>(beams);  // not if NaN
    if (!is_one) return false;
    rings[i] = static_cast<std::uint16_t>(ring);
    if (static_cast<double>(rings[i]) != ring) return false;
    count = std::max<std::size_t>(count, rings[i] + std::size_t{1});
  }
  return count == beams && lowest_come_first(cloud.view(), rings, count);
}

void MethodRunner::prepare(const io::Cloud& cloud) {
  if (on_rings_ != nullptr) on_rings_->has_rings = find_rings(cloud);
}

Status MethodRunner::segment(const io::Cloud& cloud, Segmentation& result) {
  Status status = levelled_->segment(cloud.view(), result);
  if (status.ok() || !status.message().empty()) return status;
  return Status(status.code(),
                status.code() == StatusCode::out_of_memory
                    ? fmt::format("{} points are more than the memory holds", cloud.size())
                    : fmt::format("{} points cannot be segmented", cloud.size()));
}

}  // namespace flagstone::eval
