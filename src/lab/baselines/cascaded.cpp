// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/baselines/cascaded.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "lab/baselines/cascaded_beams.hpp"
#include "lab/baselines/cascaded_planes.hpp"
#include "lab/baselines/cascaded_range_image.hpp"
#include "lab/baselines/cascaded_regions.hpp"
#include "lab/baselines/polar_grid.hpp"
#include "lab/baselines/settings.hpp"
#include "lab/baselines/usable_points.hpp"
#include "library/core/segment_scan.hpp"

namespace flagstone {
namespace {

constexpr std::string_view method = "cascaded";

constexpr ValidRange elevation_range = {.low = -89, .high = 89, .unit = "degrees"};

void check_beams(const std::vector<float>& elevations) {
  check_number(method, "length of beam_elevations", static_cast<double>(elevations.size()),
               {.low = 2, .high = 1000, .unit = "beams"});
  for (std::size_t i = 1; i < elevations.size(); ++i) {
    check_number(method, "beam_elevations[" + std::to_string(i) + "]", elevations[i],
                 {.low = elevations[i - 1],
                  .high = elevation_range.high,
                  .unit = elevation_range.unit,
                  .exclusive_min = true,
                  .remark = "ascending, the lowest beam first"});
  }
}

}  // namespace

// Velodyne, "HDL-64E S2 and S2.1 User's Manual and Programming Guide": 32 lasers 1/2 degree apart
// up to -8.83 degrees, and above them 32 lasers 1/3 degree apart up to 2 degrees.
std::vector<float> CascadedConfig::hdl_64e_elevations() {
  std::vector<float> elevations;
  for (int i = 31; i >= 0; --i) elevations.push_back(static_cast<float>(-53.0 / 6 - i / 2.0));
  for (int i = 31; i >= 0; --i) elevations.push_back(static_cast<float>(2 - i / 3.0));
  return elevations;
}

std::vector<Setting> settings_of(CascadedConfig& c) {
  return {
      {"sensor_height",
       &c.sensor_height,
       "height of the sensor above the ground",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
      {"max_range",
       &c.max_range,
       "points at this horizontal range or beyond are out of range",
       {.low = 0, .high = 1000, .unit = "m", .exclusive_min = true}},
      {"beam_elevations", &c.beam_elevations, "elevation of each beam, lowest beam first",
       elevation_range},
      {"columns",
       &c.columns,
       "number of columns of the range image, about the number of firings per turn",
       {.low = 1, .high = 3600}},
      {"max_slope",
       &c.max_slope,
       "maximum slope of the ground: rings that are closer together than on such a slope "
       "have hit an object",
       {.low = 0, .high = 45, .unit = "degrees"}},
      {"min_object_height",
       &c.min_object_height,
       "minimum height of an object that brings rings closer together (see max_slope)",
       {.low = 0, .high = 100, .unit = "m"}},
      {"sections",
       &c.sections,
       "number of regions from the sensor outward, in each of four directions",
       {.low = 1, .high = 100}},
      {"max_distance",
       &c.max_distance,
       "points at most this far from the plane of their region are ground",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
      {"max_trials",
       &c.max_trials,
       "maximum number of samples drawn per plane",
       {.low = 1, .high = 1000000}},
      {"max_angle_change",
       &c.max_angle_change,
       "maximum angle between the planes of consecutive regions",
       {.low = 0, .high = 90, .unit = "degrees"}},
      {"max_height_change",
       &c.max_height_change,
       "maximum height difference between the planes of consecutive regions, at their "
       "common boundary",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
      {"seed", &c.seed, "seed of the random number generator", {.low = 0, .high = 1e9}},
  };
}

void CascadedConfig::check() const {
  CascadedConfig copy = *this;  // settings refer to members that are not const
  check_settings(method, settings_of(copy));
  check_beams(beam_elevations);
}

using baselines::Beams;
using baselines::ContinuousPlanes;
using baselines::Coordinates;
using baselines::PolarGrid;
using baselines::RangeImage;
using baselines::Regions;
using baselines::set_ground_plane;
using baselines::single_precision;
using baselines::SinglePrecisionPlane;
using baselines::UsablePoints;

namespace {

CascadedConfig checked(CascadedConfig config) {
  config.check();
  return config;
}

}  // namespace

struct Cascaded::Pipeline {
  explicit Pipeline(CascadedConfig settings)
      : config(checked(std::move(settings))),
        beams(config),
        columns(0, config.max_range, 1, config.columns),
        image(beams, config),
        regions(beams, config),
        planes(config),
        patches(regions.count()) {}

  void reserve(std::size_t point_count, Segmentation& result) {
    points.reserve(point_count);
    columns.reserve(point_count);
    cells.reserve(point_count);
    region_of_point.reserve(point_count);
    regions.reserve(point_count);
    result.mutable_patches().reserve(regions.count());
  }

  /// `ring_of(k, range)` returns the ring of usable point k at this range, metres.
  template <class RingOf>
  void segment(CloudView cloud, Segmentation& result, std::span<Label> labels,
               const RingOf& ring_of) noexcept {
    points.gather(cloud, labels);
    fill_image(labels, ring_of);
    image.find_upright(beams);
    regions.sort(points, find_regions());
    for (std::size_t direction = 0; direction < Regions::directions; ++direction) {
      fit_outward(direction, labels);
    }
    for (const Patch& patch : patches) {  // within the reserved capacity
      if (patch.point_count > 0) result.mutable_patches().push_back(patch);
    }
  }

  [[nodiscard]] float range(std::size_t k) const noexcept {
    const float x = points.x()[k];
    const float y = points.y()[k];
    return std::sqrt(x * x + y * y);
  }

  template <class RingOf>
  void fill_image(std::span<Label> labels, const RingOf& ring_of) noexcept {
    image.clear();
    const std::span<const std::uint32_t> column = columns.locate(points);
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (column[k] >= columns.bin_count()) {
        labels[points.index()[k]] = Label::out_of_range;
        cells.data()[k] = no_cell;
        continue;
      }
      const float range_k = range(k);
      cells.data()[k] = image.cell(column[k], ring_of(k, range_k));
      image.add(cells.data()[k], range_k, points.z()[k]);
    }
  }

  /// Initialises the patches. Returns the region of each point, or no_region for points out of
  /// range or on upright objects.
  [[nodiscard]] std::span<const std::uint32_t> find_regions() noexcept {
    start_patches();
    for (std::size_t k = 0; k < points.size(); ++k) {
      std::uint32_t& region = region_of_point.data()[k];
      region = Regions::no_region;
      if (cells.data()[k] == no_cell) continue;
      const std::uint32_t place = regions.region_of(points.x()[k], points.y()[k], range(k));
      ++patches[place].point_count;
      if (!image.is_upright(cells.data()[k])) region = place;
    }
    return {region_of_point.data(), points.size()};
  }

  void start_patches() noexcept {
    for (std::size_t section = 0; section < regions.sections(); ++section) {
      for (std::size_t direction = 0; direction < Regions::directions; ++direction) {
        patches[regions.region(section, direction)] = {
            .ring = static_cast<std::uint16_t>(section),
            .sector = static_cast<std::uint16_t>(direction),
            .verdict = Verdict::no_plane};
      }
    }
  }

  /// Fits the regions of one direction, from the sensor outward.
  void fit_outward(std::size_t direction, std::span<Label> labels) noexcept {
    // Unit vectors along the centre of each direction.
    constexpr std::array<std::array<double, 2>, Regions::directions> middle = {
        {{-1, 0}, {0, -1}, {1, 0}, {0, 1}}};
    Plane plane = planes.below_sensor();
    for (std::size_t section = 0; section < regions.sections(); ++section) {
      const std::uint32_t region = regions.region(section, direction);
      const Coordinates in_region = regions.points(region);
      if (in_region.size() == 0) continue;
      const double radius = regions.inner_radius(section);
      plane = planes.fit(in_region, plane, radius * middle[direction][0],
                         radius * middle[direction][1], region);
      label_region(in_region, regions.index(region), plane, patches[region], labels);
    }
  }

  void label_region(const Coordinates& in_region, std::span<const std::uint32_t> index,
                    const Plane& fit, Patch& patch, std::span<Label> labels) const noexcept {
    const SinglePrecisionPlane plane = single_precision(fit);
    for (std::size_t i = 0; i < in_region.size(); ++i) {
      if (!planes.is_ground(plane, in_region.x[i], in_region.y[i], in_region.z[i])) continue;
      labels[index[i]] = Label::ground;
      ++patch.ground_count;
    }
    if (patch.ground_count > 0) set_ground_plane(fit, patch);
  }

  static constexpr std::size_t no_cell = ~std::size_t{0};

  CascadedConfig config;
  Beams beams;
  UsablePoints points;
  PolarGrid columns;
  RangeImage image;
  Regions regions;
  ContinuousPlanes planes;
  Buffer<std::size_t> cells;              // cell of the range image of each usable point
  Buffer<std::uint32_t> region_of_point;  // region of each usable point
  std::vector<Patch> patches;             // one per region
};

Cascaded::Cascaded(CascadedConfig config)
    : pipeline_(std::make_unique<Pipeline>(std::move(config))) {}
Cascaded::~Cascaded() = default;
Cascaded::Cascaded(Cascaded&&) noexcept = default;
Cascaded& Cascaded::operator=(Cascaded&&) noexcept = default;

const CascadedConfig& Cascaded::config() const noexcept { return pipeline_->config; }

Status Cascaded::segment(CloudView cloud, Segmentation& result) noexcept {
  return segment_scan(cloud, result, [&](std::span<Label> labels) {
    Pipeline& p = *pipeline_;
    p.reserve(cloud.size(), result);
    p.segment(cloud, result, labels,
              [&p](std::size_t k, float range) { return p.beams.nearest(range, p.points.z()[k]); });
  });
}

Status Cascaded::segment(CloudView cloud, std::span<const std::uint16_t> rings,
                         Segmentation& result) noexcept {
  const auto has_beam = [this](std::uint16_t ring) { return ring < pipeline_->beams.count(); };
  if (rings.size() != cloud.size() || !std::ranges::all_of(rings, has_beam)) {
    result.clear();
    return Status(StatusCode::invalid_argument);
  }
  return segment_scan(cloud, result, [&](std::span<Label> labels) {
    Pipeline& p = *pipeline_;
    p.reserve(cloud.size(), result);
    p.segment(cloud, result, labels,
              [&](std::size_t k, float /*range*/) { return rings[p.points.index()[k]]; });
  });
}

namespace {

/// Returns whether the mean elevation increases from ring to ring. Some sensors number their rings
/// from the top.
bool lowest_come_first(CloudView cloud, std::span<const std::uint16_t> rings, std::size_t count) {
  std::vector<double> sums(count);
  std::vector<double> points(count);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point p = cloud[i];
    const double squared = static_cast<double>(p.x) * p.x + static_cast<double>(p.y) * p.y;
    if (!(squared > 0) || !(squared < 1e12)) continue;  // false for NaN too
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

/// Cascaded on scans that can have a `ring` field. It uses the rings if they are integers and
/// number all beams from the lowest up. Otherwise it infers the rings.
class CascadedOnRings final : public Segmenter, public UsesField {
 public:
  explicit CascadedOnRings(const CascadedConfig& config) : cascaded_(config) {}

  [[nodiscard]] std::string_view field() const noexcept override { return "ring"; }

  void set_field(CloudView cloud, std::span<const double> values) override {
    if (!read_rings(cloud, values)) rings_.clear();
  }

  Status segment(CloudView cloud, Segmentation& result) noexcept override {
    const bool are_of_this_cloud = !rings_.empty() && rings_.size() == cloud.size();
    return are_of_this_cloud ? cascaded_.segment(cloud, rings_, result)
                             : cascaded_.segment(cloud, result);
  }

 private:
  bool read_rings(CloudView cloud, std::span<const double> values) {
    const std::size_t beams = cascaded_.config().beam_elevations.size();
    rings_.clear();
    std::size_t count = 0;
    for (const double ring : values) {
      const bool is_one = ring >= 0 && ring < static_cast<double>(beams);  // false for NaN
      if (!is_one || std::floor(ring) != ring) return false;
      rings_.push_back(static_cast<std::uint16_t>(ring));
      count = std::max<std::size_t>(count, rings_.back() + std::size_t{1});
    }
    return count == beams && lowest_come_first(cloud, rings_, count);
  }

  Cascaded cascaded_;
  std::vector<std::uint16_t> rings_;  // of the points to segment next; empty if unknown
};

/// Uses the beams of the sensor. A sensor with a rosette pattern has no beams and keeps the
/// defaults.
MethodConfig with_beams_of(const Sensor& sensor) {
  CascadedConfig config;
  if (sensor.draws_rosette()) return config;
  config.beam_elevations.assign(sensor.elevations.rbegin(), sensor.elevations.rend());
  config.max_range = static_cast<float>(sensor.max_range);
  const double firings_a_turn = sensor.firings * 360 / (sensor.azimuth_end - sensor.azimuth_begin);
  config.columns = static_cast<int>(std::clamp(firings_a_turn, 1.0, 3600.0));
  return config;
}

}  // namespace

Method baselines::cascaded_method() {
  Method method = baseline<CascadedConfig, CascadedOnRings>("cascaded", "CascadedSeg");
  method.for_sensor = [](const Sensor& sensor) {
    sensor.check();
    return at_height_of(sensor, with_beams_of(sensor));
  };
  return method;
}

}  // namespace flagstone
