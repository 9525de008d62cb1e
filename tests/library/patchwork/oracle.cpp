// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/patchwork/oracle.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace flagstone::oracle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Indices = std::vector<std::size_t>;

Vector3d at(CloudView cloud, std::size_t k) { return {cloud[k].x, cloud[k].y, cloud[k].z}; }

// III-B, Concentric Zone Model
// ---------------------------------------------------------------------

/// S_i,j,m of eq. (3) as (m - 1, i - 1, j - 1), for a rho_k within [L_min, L_max).
struct Place {
  int zone = 0;
  int ring = 0;
  int sector = 0;
  double inner = 0;  ///< inner radius of the ring, metres
  double outer = 0;
};

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Angle from the start of the field of view to theta, counter-clockwise, 0 to 2 pi.
double into_view(double theta, const PatchworkConfig& config) {
  const double turn = 2 * std::numbers::pi;
  const double from_begin = theta - radians(config.field_of_view.begin);
  return from_begin - turn * std::floor(from_begin / turn);
}

bool is_in_view(double theta, const PatchworkConfig& config) {
  return config.field_of_view.width == 360 ||
         into_view(theta, config) < radians(config.field_of_view.width);
}

Place place_of(double rho, double theta, const PatchworkConfig& config) {
  double inner = config.min_range;
  for (std::size_t m = 0; m < config.zones.size(); ++m) {
    const Zone& zone = config.zones[m];
    for (std::size_t i = 0; i < zone.ring_radii.size(); ++i) {
      const double outer = zone.ring_radii[i];
      if (inner <= rho && rho < outer) {
        const double width = radians(config.field_of_view.width) / zone.sectors;
        int sector = static_cast<int>(std::floor(into_view(theta, config) / width));
        if (sector == zone.sectors) sector = 0;  // a full turn is sector 0
        return {static_cast<int>(m), static_cast<int>(i), sector, inner, outer};
      }
      inner = outer;
    }
  }
  return {};
}

// III-C, Region-wise Ground Plane Fitting
// ----------------------------------------------------------

struct Plane {
  bool exists = false;
  Vector3d mean = Vector3d::Zero();
  Vector3d normal = Vector3d::Zero();
  Vector3d eigenvalues = Vector3d::Zero();
  double d = 0;
};

/// Eq. (4): C v_alpha = lambda_alpha v_alpha; n = v_3 and d = -n . p-bar.
Plane plane_of(CloudView cloud, const Indices& set) {
  if (set.size() < 3) return {};
  Plane plane;
  plane.exists = true;
  plane.mean = Vector3d::Zero();
  for (const std::size_t k : set) plane.mean += at(cloud, k);
  plane.mean /= static_cast<double>(set.size());

  Matrix3d c = Matrix3d::Zero();
  for (const std::size_t k : set) {
    const Vector3d offset = at(cloud, k) - plane.mean;
    c += offset * offset.transpose();
  }
  c /= static_cast<double>(set.size() - 1);

  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(c);  // ascending
  plane.eigenvalues = solver.eigenvalues().reverse().cwiseMax(0);
  plane.normal = solver.eigenvectors().col(0);
  if (std::abs(plane.normal.z()) <= 1e-6) {  // a vertical plane, as documented for principal_axes()
    plane.normal.z() = 0;
    const double larger = std::abs(plane.normal.y()) > std::abs(plane.normal.x())
                              ? plane.normal.y()
                              : plane.normal.x();
    if (larger < 0) plane.normal = -plane.normal;
  } else if (plane.normal.z() < 0) {
    plane.normal = -plane.normal;
  }

  // Points that do not determine a plane: the most upright normal, as documented for
  // principal_axes().
  const double trace = plane.eigenvalues.sum();
  const double equal = 1e-6 * trace;
  if (plane.eigenvalues[0] - plane.eigenvalues[2] <= equal) {
    plane.normal = Vector3d::UnitZ();
  } else if (plane.eigenvalues[1] - plane.eigenvalues[2] <= equal) {
    const Vector3d along = solver.eigenvectors().col(2);
    const Vector3d upright = Vector3d::UnitZ() - along.z() * along;
    plane.normal = upright.norm() < 1e-5 ? Vector3d(Vector3d::UnitX()) : upright.normalized();
  }
  plane.d = -plane.normal.dot(plane.mean);
  return plane;
}

/// z-bar_init: mean height of the N_seed lowest points of S_n that are not below M_h * h_s.
/// If there are none, the height of the sensor, as in the public code.
double initial_height(CloudView cloud, const Indices& s_n, double cut,
                      const PatchworkConfig& config) {
  const int n_seed = config.seed_count;
  std::vector<double> heights;
  for (const std::size_t k : s_n) {
    if (at(cloud, k).z() >= cut) heights.push_back(at(cloud, k).z());
  }
  std::ranges::sort(heights);
  if (heights.size() > static_cast<std::size_t>(n_seed)) {
    heights.resize(static_cast<std::size_t>(n_seed));
  }
  if (heights.empty()) {
    return config.sensor_height > 0 ? 0 : double{1.73f} - config.sensor_height;
  }
  double sum = 0;
  for (const double z : heights) sum += z;
  return sum / static_cast<double>(heights.size());
}

/// Eq. (5): G^0, without the points below the margin if the configuration excludes them.
Indices initial_set(CloudView cloud, const Indices& s_n, double cut,
                    const PatchworkConfig& config) {
  const double z_init = initial_height(cloud, s_n, cut, config);
  Indices set;
  for (const std::size_t k : s_n) {
    const double z = at(cloud, k).z();
    const bool kept = config.keep_below_margin || z >= cut;
    if (kept && z < z_init + config.seed_height) set.push_back(k);
  }
  return set;
}

/// d^l - d-hat_k of eq. (6), with d-hat_k = -n . p_k: the height of point k above the plane.
double height_above(const Plane& plane, CloudView cloud, std::size_t k) {
  const double d_hat = -plane.normal.dot(at(cloud, k));
  return plane.d - d_hat;
}

/// Eqs. (5) and (6), without the points that are so far below the plane that they are noise.
Indices next_set(CloudView cloud, const Indices& s_n, const Plane& plane,
                 const PatchworkConfig& config) {
  Indices set;
  for (const std::size_t k : s_n) {
    const double height = height_above(plane, cloud, k);
    if (height < config.distance_margin && height >= -config.noise_margin) set.push_back(k);
  }
  return set;
}

// III-D, Ground Likelihood Estimation
// --------------------------------------------------------------

Verdict judge(const Plane& plane, double r_n, std::size_t ring, const PatchworkConfig& config) {
  // Eq. (9)
  const double theta_tau = config.uprightness.angle * std::numbers::pi / 180;
  const bool upright =
      !config.uprightness.enabled || plane.normal.z() > std::cos(std::numbers::pi / 2 - theta_tau);

  // Eq. (10)
  const double kappa = -static_cast<double>(config.sensor_height) +
                       config.elevation.base * std::exp(config.elevation.growth * r_n);
  const bool near = config.elevation.enabled && r_n < config.elevation.range;
  const double above = (plane.mean.z() - kappa) / config.elevation.scale;
  const double log_psi = near ? -std::log1p(std::exp(std::min(above, 300.0))) : 0;

  // Eq. (11) as a logarithm, which does not overflow for small scales
  const double spread = plane.eigenvalues.sum();
  const double sigma = spread > 0 ? plane.eigenvalues[2] / spread : 0;
  const std::vector<float>& thresholds = config.flatness.thresholds;
  const double sigma_tau = thresholds[std::min(ring, thresholds.size() - 1)];
  const bool too_high = near && above > 0;
  double log_varphi = 0;
  if (config.flatness.enabled && too_high) {
    const double excess = (sigma - sigma_tau) / config.flatness.scale;
    log_varphi = std::log(config.flatness.gain) - std::clamp(excess, -300.0, 300.0);
  }

  // Eqs. (7) and (11): f > 0.5
  if (!upright) return Verdict::not_upright;
  if (log_psi + log_varphi > std::log(0.5)) {
    return too_high ? Verdict::ground_flat : Verdict::ground;
  }
  return Verdict::too_high;
}

// Ground below a patch, which is not in the paper
// ---------------------------------------------

/// Points below a patch are ground instead of noise if they form a separate plane: enough points,
/// with enough length and width, flat, and with an upright normal.
Indices lower_ground(CloudView cloud, const Indices& deep) {
  const auto near = [&](const Plane& plane, double margin) {
    Indices set;
    for (const std::size_t k : deep) {
      if (std::abs(height_above(plane, cloud, k)) < margin) set.push_back(k);
    }
    return set;
  };
  constexpr std::size_t fewest = 12;
  Indices set = deep;
  if (set.size() < fewest) return {};
  for (const double margin : {0.3, 0.15}) {
    set = near(plane_of(cloud, set), margin);
    if (set.size() < fewest) return {};
  }
  const Plane plane = plane_of(cloud, set);
  const double share = static_cast<double>(set.size()) / static_cast<double>(deep.size());
  const Vector3d deviations = plane.eigenvalues.cwiseSqrt();
  const bool of_two_beams = deviations[0] >= 0.3 && deviations[1] >= 0.1;
  const bool of_one_beam = deviations[0] >= 0.5;
  if (share < 0.6 || plane.normal.z() < 0.64 || deviations[2] >= 0.05) return {};
  if (!of_two_beams && !of_one_beam) return {};
  return near(plane, 0.15);
}

/// Sections III-C and III-D for one bin.
void segment_bin(CloudView cloud, const Place& place, std::size_t ring_overall,
                 const PatchworkConfig& config, Bin& bin, std::vector<Label>& labels) {
  if (bin.points.size() < static_cast<std::size_t>(config.min_points)) {
    if (!config.sparse_bins_are_ground) return;
    for (const std::size_t k : bin.points) labels[k] = Label::ground;
    return;
  }

  const Zone& zone = config.zones[static_cast<std::size_t>(place.zone)];
  const double margin = zone.height_margin;
  // M_h h_s. If the origin is not at the sensor, the depth below the ground is that for a sensor at
  // 1.73 m.
  const double height = config.sensor_height;
  const double cut = std::isinf(margin) ? margin
                     : height > 0       ? margin * height
                                        : -height + (margin + 1) * double{1.73f};
  Indices set = initial_set(cloud, bin.points, cut, config);
  Indices previous;
  Plane last;
  for (int l = 0; l < config.iterations; ++l) {
    last = plane_of(cloud, set);
    if (!last.exists) {
      bin.verdict = Verdict::no_plane;
      return;
    }
    previous = set;
    set = next_set(cloud, bin.points, last, config);
  }

  const Plane judged = plane_of(cloud, config.evaluate_final_set ? set : previous);
  if (!judged.exists) {
    bin.verdict = Verdict::no_plane;
    return;
  }
  bin.normal = judged.normal;
  bin.d = judged.d;
  bin.eigenvalues = judged.eigenvalues;
  bin.verdict = judge(judged, (place.inner + place.outer) / 2, ring_overall, config);
  if (bin.verdict != Verdict::ground && bin.verdict != Verdict::ground_flat) return;
  for (const std::size_t k : set) labels[k] = Label::ground;
  Indices deep;
  for (const std::size_t k : bin.points) {
    const double depth = -height_above(last, cloud, k);
    if (depth > config.noise_margin || depth > config.lower_plane_margin) deep.push_back(k);
  }
  for (const std::size_t k : deep) labels[k] = Label::noise;
  if (std::isinf(config.lower_plane_margin)) return;
  for (const std::size_t k : lower_ground(cloud, deep)) labels[k] = Label::ground;
}

}  // namespace

Answer segment(CloudView cloud, const PatchworkConfig& config) {
  Answer answer;
  answer.labels.assign(cloud.size(), Label::nonground);
  std::map<std::tuple<int, int, int>, std::pair<Place, Bin>> bins;
  const double l_max = config.zones.back().ring_radii.back();

  for (std::size_t k = 0; k < cloud.size(); ++k) {
    const Vector3d p = at(cloud, k);
    const double rho = std::hypot(p.x(), p.y());
    if (!p.allFinite() || p.isZero(0)) {
      answer.labels[k] = Label::invalid;
      continue;
    }
    const double theta = std::atan2(p.y(), p.x());
    if (rho < config.min_range || rho >= l_max || std::abs(p.z()) > 10000 ||
        !is_in_view(theta, config)) {
      answer.labels[k] = Label::out_of_range;
      continue;
    }
    const Place place = place_of(rho, theta, config);
    if (p.z() < -static_cast<double>(config.sensor_height) - config.noise_depth -
                    config.noise_slope * place.outer) {
      answer.labels[k] = Label::noise;
      continue;
    }
    auto& [where, bin] = bins[{place.zone, place.ring, place.sector}];
    where = place;
    bin.zone = place.zone;
    bin.ring = place.ring;
    bin.sector = place.sector;
    bin.points.push_back(k);
  }

  for (auto& [key, entry] : bins) {
    auto& [place, bin] = entry;
    auto ring_overall = static_cast<std::size_t>(place.ring);
    for (int m = 0; m < place.zone; ++m) {
      ring_overall += config.zones[static_cast<std::size_t>(m)].ring_radii.size();
    }
    segment_bin(cloud, place, ring_overall, config, bin, answer.labels);
    answer.bins.push_back(std::move(bin));
  }
  return answer;
}

}  // namespace flagstone::oracle
