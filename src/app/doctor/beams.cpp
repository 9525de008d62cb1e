// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/beams.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <numbers>
#include <utility>

#include "library/core/statistics.hpp"

namespace flagstone::doctor {
namespace {

constexpr double half_turn = 180;
constexpr double degrees = half_turn / std::numbers::pi;

double azimuth_of(const Vector3f& p) { return std::atan2(double{p[1]}, double{p[0]}) * degrees; }

/// Difference of two azimuths, -180 to 180 degrees.
double turned(double from, double to) {
  const double step = to - from;
  return step > half_turn ? step - 360 : step < -half_turn ? step + 360 : step;
}

BeamRings rings_of_field(std::span<const int> field) {
  BeamRings rings{.source = RingSource::field, .of_points = {field.begin(), field.end()}};
  std::map<int, int> numbers;
  for (const int ring : field) numbers.emplace(ring, 0);
  for (auto& [ring, number] : numbers) number = rings.count++;
  for (int& ring : rings.of_points) ring = numbers[ring];
  return rings;
}

constexpr double steady_step = 5;  // degrees between consecutive points, including gaps

/// Direction of rotation if the points are listed ring by ring: 1 counter-clockwise, -1 clockwise;
/// 0 if they are listed in another order.
double rotation_of(const std::vector<double>& azimuths) {
  constexpr double steady_share = 0.9;
  std::size_t left = 0;
  std::size_t right = 0;
  for (std::size_t i = 1; i < azimuths.size(); ++i) {
    const double step = turned(azimuths[i - 1], azimuths[i]);
    if (std::abs(step) <= steady_step) ++(step > 0 ? left : right);
  }
  const auto steady = static_cast<double>(std::max(left, right));
  if (steady < steady_share * static_cast<double>(azimuths.size())) return 0;
  return left > right ? 1 : -1;
}

/// Numbers the rings. Each starts near azimuth `start`; `way` is its direction of rotation.
BeamRings cut_at(double start, double way, const std::vector<double>& azimuths) {
  constexpr double slack = 2;  // degrees
  std::vector<double> since(azimuths.size());
  for (std::size_t i = 0; i < azimuths.size(); ++i) {
    const double angle = way * (azimuths[i] - start) + slack;
    since[i] = angle - 360 * std::floor(angle / 360);
  }
  const double far_back = std::ranges::max(since) / 2;
  BeamRings rings{.source = RingSource::order, .of_points = std::vector<int>(azimuths.size())};
  int ring = 0;
  std::size_t begin = 0;  // of the last ring
  for (std::size_t i = 1; i < since.size(); ++i) {
    const double step = since[i] - since[i - 1];
    const bool is_close = std::abs(turned(azimuths[i - 1], azimuths[i])) <= steady_step;
    if (step < -far_back) ++ring;
    if (step > far_back && is_close) --ring;  // a point out of order at the boundary of two rings
    ring = std::max(ring, 0);
    rings.of_points[i] = ring;
    if (ring >= rings.count) begin = i;
    rings.count = std::max(rings.count, ring + 1);
  }
  // The end of the last ring may extend past the azimuth at which the next one would start.
  const bool is_stub = *std::max_element(since.begin() + static_cast<std::ptrdiff_t>(begin),
                                         since.end()) < 2 * slack;
  if (is_stub && rings.count > 1) {
    --rings.count;
    for (int& number : rings.of_points) number = std::min(number, rings.count - 1);
  }
  return rings;
}

/// Mean deviation of the elevations from the mean elevation of their ring, radians.
double raggedness(std::span<const Vector3f> places, const BeamRings& rings) {
  std::vector<double> sums(static_cast<std::size_t>(rings.count));
  std::vector<double> counts(sums.size());
  std::vector<double> elevations(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [x, y, z] = places[i];
    elevations[i] = std::atan2(double{z}, std::hypot(double{x}, double{y}));
    const auto ring = static_cast<std::size_t>(rings.of_points[i]);
    sums[ring] += elevations[i];
    ++counts[ring];
  }
  double sum = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto ring = static_cast<std::size_t>(rings.of_points[i]);
    sum += std::abs(elevations[i] - sums[ring] / counts[ring]);
  }
  return sum / static_cast<double>(places.size());
}

/// Azimuth at which the view starts, after the widest gap; empty if the gap is below 45 degrees.
std::vector<double> begin_of_view(std::vector<double> azimuths, double way) {
  constexpr double narrow = 45;
  std::ranges::sort(azimuths);
  double widest = 360 - (azimuths.back() - azimuths.front());
  double begin = way > 0 ? azimuths.front() : azimuths.back();
  for (std::size_t i = 1; i < azimuths.size(); ++i) {
    if (azimuths[i] - azimuths[i - 1] <= widest) continue;
    widest = azimuths[i] - azimuths[i - 1];
    begin = way > 0 ? azimuths[i] : azimuths[i - 1];
  }
  if (widest < narrow) return {};
  return {begin};
}

/// Rings from the order of the points. The azimuth at which rings start is unknown, so several are
/// tried; the one with the most uniform elevations per ring is used.
BeamRings rings_of_order(std::span<const Vector3f> places) {
  constexpr int fewest_rings = 4;
  constexpr int most_rings = 512;
  if (places.empty()) return {};
  std::vector<double> azimuths(places.size());
  std::ranges::transform(places, azimuths.begin(), azimuth_of);
  const double way = rotation_of(azimuths);
  if (way == 0) return {};
  std::vector<double> starts = begin_of_view(azimuths, way);
  starts.insert(starts.end(), {azimuths.front(), 0, half_turn});
  BeamRings best;
  double least = 0;
  for (const double start : starts) {
    BeamRings rings = cut_at(start, way, azimuths);
    if (rings.count < fewest_rings || rings.count > most_rings) continue;
    const double ragged = raggedness(places, rings);
    if (best.count > 0 && ragged >= least) continue;
    best = std::move(rings);
    least = ragged;
  }
  return best;
}

using Place = std::array<double, 3>;

/// Indices of the points that are useful to find the origin of the beams: not on the ego vehicle;
/// so close that their elevation changes when the origin moves; and above the ground, because
/// ground points fit many heights.
std::vector<std::size_t> useful_points(std::span<const Vector3f> places, double ground) {
  constexpr double nearest = 2.7;
  constexpr double farthest = 40;
  constexpr double off_ground = 0.3;
  constexpr std::size_t enough = 20000;
  std::vector<std::size_t> useful;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double range = std::hypot(double{places[i][0]}, double{places[i][1]});
    const bool is_on_ground = double{places[i][2]} < ground + off_ground;
    if (range > nearest && range < farthest && !is_on_ground) useful.push_back(i);
  }
  const std::size_t stride = useful.size() / enough + 1;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < useful.size(); i += stride) useful[kept++] = useful[i];
  useful.resize(kept);
  return useful;
}

constexpr std::size_t fewest_useful_points = 1000;

double elevation_from(const Place& place, const Vector3f& point) {
  const double x = double{point[0]} - place[0];
  const double y = double{point[1]} - place[1];
  return std::atan2(double{point[2]} - place[2], std::sqrt(x * x + y * y)) * degrees;
}

/// Sharpness of the comb that the elevations form: variation of the counts per 0.1 degrees about
/// their running mean, squared differences over squared means, minus the expected value for random
/// counts.
double comb_sharpness(const std::vector<Vector3f>& points, const Place& place) {
  constexpr double step = 0.1;  // degrees
  constexpr std::size_t steps = 1800;
  constexpr std::size_t reach = 5;  // of the running mean, on both sides
  std::array<double, steps> counts{};
  for (const Vector3f& point : points) {
    const double elevation = elevation_from(place, point);
    ++counts[std::min(static_cast<std::size_t>((elevation + 90) / step), steps - 1)];
  }
  double differences = -static_cast<double>(points.size());
  double means = 0;
  for (std::size_t i = reach; i + reach < steps; ++i) {
    double around = 0;
    for (std::size_t k = i - reach; k <= i + reach; ++k) around += counts[k] / (2 * reach + 1);
    differences += (counts[i] - around) * (counts[i] - around);
    means += around * around;
  }
  return means > 0 ? differences / means : 0;
}

double median_deviation(std::vector<double>& values) {
  const double middle = median(values);
  for (double& value : values) value = std::abs(value - middle);
  return median(values);
}

/// Inverse of the mean of the rings' median deviations of elevation, 1/degrees.
double ring_sharpness(const std::vector<std::vector<Vector3f>>& rings, const Place& place) {
  constexpr std::size_t fewest = 20;
  double sum = 0;
  double count = 0;
  std::vector<double> elevations;
  for (const std::vector<Vector3f>& ring : rings) {
    if (ring.size() < fewest) continue;
    elevations.clear();
    for (const Vector3f& point : ring) elevations.push_back(elevation_from(place, point));
    const auto size = static_cast<double>(ring.size());
    sum += size * median_deviation(elevations);
    count += size;
  }
  return sum > 0 ? count / sum : 0;
}

/// Searches the position from which the beams are sharpest, along one axis after the other.
class SharpestPlace {
 public:
  /// Sensors are mounted from 0.1 to 6 m above the ground.
  SharpestPlace(std::function<double(const Place&)> sharpness_from, double ground)
      : sharpness_from_(std::move(sharpness_from)) {
    sharpness_elsewhere_ = search(2, ground + 0.1, ground + 6, 0.1);
  }

  void search_across() {
    search(0, -3, 3, 0.25);
    search(1, -3, 3, 0.25);
  }
  void refine(std::size_t axis, double reach, double step) {
    search(axis, place_[axis] - reach, place_[axis] + reach, step);
  }

  [[nodiscard]] double sharpness() const noexcept { return sharpness_; }
  /// The best value at other heights.
  [[nodiscard]] double sharpness_elsewhere() const noexcept { return sharpness_elsewhere_; }

  [[nodiscard]] BeamOrigin origin() const {
    return {.place = {static_cast<float>(place_[0]), static_cast<float>(place_[1]),
                      static_cast<float>(place_[2])},
            .sharpness = sharpness_,
            .sharpness_at_origin = sharpness_from_({0, 0, 0})};
  }

 private:
  /// Moves to the best position along an axis, metres. Returns the best sharpness that is
  /// not near this position.
  double search(std::size_t axis, double from, double to, double step) {
    constexpr double near = 0.35;
    const long steps = std::lround((to - from) / step);
    std::vector<double> seen;
    Place place = place_;
    for (long i = 0; i <= steps; ++i) {
      place[axis] = from + static_cast<double>(i) * step;
      seen.push_back(sharpness_from_(place));
    }
    const auto best = std::ranges::max_element(seen);
    place_[axis] = from + static_cast<double>(best - seen.begin()) * step;
    sharpness_ = *best;
    double elsewhere = 0;
    for (auto other = seen.begin(); other != seen.end(); ++other) {
      const double distance = step * std::abs(static_cast<double>(other - best));
      if (distance > near) elsewhere = std::max(elsewhere, *other);
    }
    return elsewhere;
  }

  std::function<double(const Place&)> sharpness_from_;
  Place place_{};
  double sharpness_ = 0;
  double sharpness_elsewhere_ = 0;
};

/// An azimuth with a smaller fraction of the mean count is outside the view; ignores stray points.
constexpr double least_share = 0.02;

void find_azimuths(const std::array<std::size_t, 360>& counts, std::size_t points,
                   FieldOfView& view) {
  constexpr int widest_shadow = 45;  // of a close object, degrees
  const double least = least_share * static_cast<double>(points) / 360;
  int longest = 0;
  int run = 0;
  int end = 0;  // of the longest gap
  for (int i = 0; i < 720; ++i) {
    const bool is_empty = static_cast<double>(counts[static_cast<std::size_t>(i % 360)]) <= least;
    run = is_empty ? run + 1 : 0;
    if (run > longest && run <= 360) {
      longest = run;
      end = i + 1;
    }
  }
  const bool all_around = longest <= widest_shadow;
  view.azimuth_begin = all_around ? -180 : end % 360 - 180;
  view.azimuth_width = all_around ? 360 : 360 - longest;
}

/// Uses the median elevation of each beam, which is more robust than single points.
void find_edges_by_ring(std::vector<std::vector<double>>& elevations, FieldOfView& view) {
  constexpr std::size_t fewest = 10;
  view.top = -90;
  view.bottom = 90;
  for (std::vector<double>& ring : elevations) {
    if (ring.size() < fewest) continue;
    const double middle = percentile(ring, 50);
    view.top = std::max(view.top, middle);
    view.bottom = std::min(view.bottom, middle);
  }
}

/// Number of beams: the teeth of the comb that the elevations form; 0 if there is no comb.
int count_beams(const std::vector<double>& elevations) {
  constexpr double step = 0.1;  // degrees
  constexpr std::size_t steps = 1800;
  constexpr std::size_t reach = 5;  // on both sides
  constexpr double share_in_teeth = 0.8;
  std::vector<double> counts(steps);
  for (const double elevation : elevations) {
    ++counts[std::min(static_cast<std::size_t>((elevation + 90) / step), steps - 1)];
  }
  const double least = static_cast<double>(elevations.size()) * 1e-4;
  double in_teeth = 0;
  std::size_t wide = 0;   // teeth, in steps
  std::size_t first = 0;  // step of the lowest tooth
  std::size_t last = 0;
  int teeth = 0;
  for (std::size_t i = reach; i + reach < steps; ++i) {
    double around = 0;
    for (std::size_t k = i - reach; k <= i + reach; ++k) around += counts[k] / (2 * reach + 1);
    const auto is_tooth = [&](std::size_t k) { return counts[k] > least && counts[k] > around; };
    if (!is_tooth(i)) continue;
    in_teeth += counts[i];
    if (wide++ == 0) first = i;
    last = i;
    if (counts[i] >= counts[i - 1] && counts[i] > counts[i + 1]) ++teeth;
  }
  const bool is_comb = in_teeth > share_in_teeth * static_cast<double>(elevations.size()) &&
                       2 * wide < last - first + 1;
  constexpr int fewest = 4;
  return is_comb && teeth >= fewest ? teeth : 0;
}

}  // namespace

BeamRings find_rings(std::span<const Vector3f> places, std::span<const int> field) {
  return field.empty() ? rings_of_order(places) : rings_of_field(field);
}

bool BeamOrigin::is_elsewhere() const noexcept {
  // The beams of an HDL-64E meet 0.2 m above the origin of its frame; driving blurs x and y.
  constexpr double farther_along = 0.5;
  constexpr double farther_across = 1;
  const bool is_away = std::abs(double{place[2]}) > farther_along ||
                       std::hypot(double{place[0]}, double{place[1]}) > farther_across;
  return is_away && sharpness > 2 * sharpness_at_origin;
}

std::optional<BeamOrigin> find_beam_origin(std::span<const Vector3f> places, double ground) {
  constexpr double least_sharpness = 0.1;
  std::vector<Vector3f> points;
  for (const std::size_t i : useful_points(places, ground)) points.push_back(places[i]);
  if (points.size() < fewest_useful_points) return {};
  // The height first: moving the origin sideways hardly changes the elevation of flat beams.
  SharpestPlace sharpest([&](const Place& from) { return comb_sharpness(points, from); }, ground);
  if (sharpest.sharpness() < std::max(least_sharpness, 2 * sharpest.sharpness_elsewhere())) {
    return {};
  }
  sharpest.search_across();
  for (const double finer : {1.0, 0.4}) {
    sharpest.refine(2, 0.4 * finer, 0.05 * finer);
    sharpest.refine(0, 0.5 * finer, 0.1 * finer);
    sharpest.refine(1, 0.5 * finer, 0.1 * finer);
  }
  return sharpest.origin();
}

std::optional<BeamOrigin> find_beam_origin(std::span<const Vector3f> places, const BeamRings& rings,
                                           double ground) {
  const std::vector<std::size_t> useful = useful_points(places, ground);
  if (rings.count == 0 || useful.size() < fewest_useful_points) return {};
  std::vector<std::vector<Vector3f>> by_ring(static_cast<std::size_t>(rings.count));
  for (const std::size_t i : useful) {
    by_ring[static_cast<std::size_t>(rings.of_points[i])].push_back(places[i]);
  }
  SharpestPlace sharpest([&](const Place& from) { return ring_sharpness(by_ring, from); }, ground);
  sharpest.refine(2, 0.08, 0.02);
  return sharpest.origin();
}

FieldOfView find_field_of_view(std::span<const Vector3f> places, const BeamRings& rings,
                               double nearest) {
  FieldOfView view{.beams = rings.count};
  std::array<std::size_t, 360> azimuths{};
  std::vector<double> elevations;
  std::vector<std::vector<double>> by_ring(static_cast<std::size_t>(rings.count));
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::array<double, 3> p{places[i][0], places[i][1], places[i][2]};
    if (std::hypot(p[0], p[1], p[2]) < nearest) continue;
    const double elevation = std::atan2(p[2], std::hypot(p[0], p[1])) * degrees;
    const double azimuth = std::atan2(p[1], p[0]) * degrees + 180;
    ++azimuths[std::min(static_cast<std::size_t>(azimuth), azimuths.size() - 1)];
    elevations.push_back(elevation);
    if (rings.count > 0) by_ring[static_cast<std::size_t>(rings.of_points[i])].push_back(elevation);
  }
  if (elevations.empty()) return view;
  find_azimuths(azimuths, elevations.size(), view);
  if (rings.count > 0) {
    find_edges_by_ring(by_ring, view);
  } else {
    view.beams = count_beams(elevations);
    view.top = percentile(elevations, 99.8);
    view.bottom = percentile(elevations, 0.2);
  }
  return view;
}

}  // namespace flagstone::doctor
