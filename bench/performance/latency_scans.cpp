// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "latency_scans.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "files/io/read_cloud.hpp"
#include "flagstone/patchwork_config.hpp"

namespace flagstone::performance {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double ground = -1.73;  ///< z, metres

Point point(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

Point polar(double range, double angle, double z) {
  return point(range * std::cos(angle), range * std::sin(angle), z);
}

// Numbers from 0 to `count` in an order that is slow for std::nth_element of this standard library
// when it selects the `nth` number, one of the lowest. If `fixed(i)`, number i is `count`, the
// maximum.
//
// M. D. McIlroy, "A Killer Adversary for Quicksort", Software: Practice and Experience 29(4), 1999:
// the numbers are chosen during the comparisons, so that each pivot is high and each round excludes
// almost no numbers.
std::vector<double> adverse_to_selection(std::size_t count, std::size_t nth,
                                         bool (*fixed)(std::size_t)) {
  const auto maximum = static_cast<double>(count);
  constexpr double undecided = 0;
  std::vector<double> numbers(count, undecided);
  for (std::size_t i = 0; i < count; ++i) {
    if (fixed(i)) numbers[i] = maximum;
  }
  double next = maximum - 1;
  std::size_t candidate = 0;  // an undecided number that is probably the pivot
  const auto less = [&](std::size_t a, std::size_t b) {
    if (numbers[a] == undecided && numbers[b] == undecided) {
      numbers[a == candidate ? a : b] = next--;
    }
    if (numbers[a] == undecided) candidate = a;
    if (numbers[b] == undecided) candidate = b;
    return numbers[a] < numbers[b];
  };
  std::vector<std::size_t> indices(count);
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  std::nth_element(indices.begin(), indices.begin() + static_cast<std::ptrdiff_t>(nth),
                   indices.end(), less);
  return numbers;
}

struct NamedPath {
  std::string set;  ///< subdirectory of FLAGSTONE_DATA
  std::filesystem::path path;
};

/// A random scan of `scans`, resized, rotated, and with noise of up to 2 cm.
Cloud variant(const std::vector<Cloud>& scans, std::size_t count, Random& random) {
  Cloud cloud =
      rotated(resized(scans[random.bits() % scans.size()], count), random.uniform(0, two_pi));
  for (Point& p : cloud) {
    for (float* coordinate : {&p.x, &p.y, &p.z}) {
      *coordinate += static_cast<float>(random.uniform(-0.02, 0.02));
    }
  }
  return cloud;
}

/// A cloud of `count` points returned by `draw`.
template <class Draw>
Cloud drawn(std::size_t count, const Draw& draw) {
  Cloud cloud;
  cloud.reserve(count);
  for (std::size_t i = 0; i < count; ++i) cloud.push_back(draw(i));
  return cloud;
}

/// Groups of `length` points at random positions on the ground: runs of `length` points.
Cloud short_runs(std::size_t count, std::size_t length, Random& random) {
  double range = 0;
  double angle = 0;
  return drawn(count, [&](std::size_t i) {
    if (i % length == 0) {
      range = random.uniform(3, 79);
      angle = random.uniform(0, two_pi);
    }
    return polar(range, angle, ground + random.uniform(-0.05, 0.05));
  });
}

/// Groups of 64 points on the ground, `length` metres long and 5 cm wide. In balls, all eigenvalues
/// are equal. In needles, the two smaller ones are equal, which is the slowest case of the search
/// for the smallest.
Cloud clusters(std::size_t count, double length, Random& random) {
  double x = 0;
  double y = 0;
  return drawn(count, [&](std::size_t i) {
    if (i % 64 == 0) {
      const double range = random.uniform(3, 79);
      const double angle = random.uniform(0, two_pi);
      x = range * std::cos(angle);
      y = range * std::sin(angle);
    }
    return point(x + length * random.normal(), y + 0.05 * random.normal(),
                 ground + 0.05 * random.normal());
  });
}

Cloud corrupted(Cloud cloud, Random& random) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  constexpr std::array odd = {nan, infinity, -infinity, 0.0f, -0.0f, 3e38f, -3e38f, 1e20f, -1e-40f};
  for (Point& p : cloud) {
    const float value = odd[random.bits() % odd.size()];
    switch (random.bits() % 20) {
      case 0: p.x = value; break;
      case 1: p.y = value; break;
      case 2: p.z = value; break;
      case 3: p = {0, 0, 0}; break;
      case 4: p = {value, value, value}; break;
      default: break;
    }
  }
  return cloud;
}

/// The interior of a bin, away from its edges: ranges in metres, angles in radians.
struct Bin {
  double inner, outer;
  double begin, end;
};

/// A random bin of the preset `default`.
Bin some_bin(Random& random) {
  const PatchworkConfig config;
  std::vector<std::pair<double, int>> rings = {{config.min_range, 0}};  // outer radius, sectors
  for (const Zone& zone : config.zones) {
    for (const float radius : zone.ring_radii) rings.emplace_back(radius, zone.sectors);
  }
  const std::size_t ring = 1 + random.bits() % (rings.size() - 1);
  const int sectors = rings[ring].second;
  const auto sector = static_cast<double>(random.bits() % static_cast<std::uint64_t>(sectors));
  const double width = two_pi / sectors;
  const double begin = -std::numbers::pi + sector * width;
  const double depth = rings[ring].first - rings[ring - 1].first;
  return {.inner = rings[ring - 1].first + 0.05 * depth,
          .outer = rings[ring].first - 0.05 * depth,
          .begin = begin + 0.05 * width,
          .end = begin + 0.95 * width};
}

/// All points in one bin, with the slowest order of heights for selecting the 20 lowest. The bound
/// given by the lowest height of each of sixteen lanes excludes nothing, because seven lanes
/// contain only the maximum.
Cloud hard_to_select(std::size_t count, Random& random) {
  constexpr std::size_t seeds = 20;  // N_seed of the preset `default`
  static std::map<std::size_t, std::vector<double>> known;
  std::vector<double>& order = known[count];
  if (order.empty()) {
    order = adverse_to_selection(count, seeds - 1, [](std::size_t i) { return i % 16 >= 9; });
  }
  const double span = random.uniform(0.1, 0.3) / static_cast<double>(count);
  return drawn(count, [&](std::size_t i) {
    return point(12 + random.uniform(0, 0.2), 0.5 + random.uniform(0, 0.2),
                 ground + span * order[i]);
  });
}

/// Coordinates of about 1e-39, because CPUs are slow with denormal numbers.
Cloud denormal(std::size_t count, Random& random) {
  return drawn(count, [&](std::size_t) {
    const double tiny = random.uniform(-9e-39, 9e-39);
    const double small = random.uniform(-1e-19, 1e-19);
    return random.chance(0.5) ? point(random.uniform(3, 79), tiny, small)
                              : point(small, random.uniform(3, 79), tiny);
  });
}

/// A flat circle, with heights whose squares are denormal.
Cloud small_heights(std::size_t count, Random& random) {
  const double range = random.uniform(3, 79);
  return drawn(count, [&](std::size_t i) {
    const double angle = two_pi * static_cast<double>(i) / static_cast<double>(count);
    return polar(range, angle, random.uniform(-1e-19, 1e-19));
  });
}

std::vector<NamedPath> real_scan_paths() {
  const char* directory =
      std::getenv("FLAGSTONE_DATA");  // NOLINT(concurrency-mt-unsafe): one thread
  std::vector<NamedPath> paths;
  if (directory == nullptr || !std::filesystem::is_directory(directory)) return paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
    const std::string set = entry.path().lexically_relative(directory).begin()->string();
    // The airborne scans are not in a sensor frame: none of their points is in range.
    if (entry.is_regular_file() && io::is_scan_name(entry.path()) && set != "airborne") {
      paths.push_back({.set = set, .path = entry.path()});
    }
  }
  std::ranges::sort(paths, {}, &NamedPath::path);
  return paths;
}

/// The finite points of a file; empty if the file cannot be read.
Cloud finite_points(const std::filesystem::path& path) {
  Cloud cloud;
  io::Cloud file;
  if (!io::read_cloud(path, {}, file).ok()) return cloud;
  for (std::size_t i = 0; i < file.size(); ++i) {
    const Point p = file.view()[i];
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) cloud.push_back(p);
  }
  return cloud;
}

std::vector<ScanKind> adversarial_kinds() {
  std::vector<ScanKind> kinds;
  const auto add = [&](const char* name, auto draw) {
    kinds.push_back({.name = name, .ordinary = false, .draw = std::move(draw)});
  };
  add("all in one bin", [](std::size_t count, Random& random) {
    const Bin bin = some_bin(random);
    return drawn(count, [&](std::size_t) {
      return polar(random.uniform(bin.inner, bin.outer), random.uniform(bin.begin, bin.end),
                   ground + random.uniform(-0.1, 0.1));
    });
  });
  add("all on one line", [](std::size_t count, Random& random) {
    const double angle = random.uniform(0, two_pi);
    const double slope = random.uniform(-0.1, 0.1);
    return drawn(count, [&](std::size_t) {
      const double range = random.uniform(-80, 80);
      return polar(range, angle, ground + slope * range);
    });
  });
  add("all points equal", [](std::size_t count, Random& random) {
    return Cloud(count, polar(random.uniform(3, 79), random.uniform(0, two_pi), ground));
  });
  add("each in another bin", [](std::size_t count, Random& random) {
    const double start = random.uniform(0, two_pi);
    return drawn(count, [&](std::size_t i) {
      const double around = std::fmod(static_cast<double>(i) * std::numbers::phi, 1);
      const double out = std::fmod(static_cast<double>(i) * std::numbers::sqrt2, 1);
      return polar(3 + 76 * out, start + two_pi * around, ground + random.uniform(-0.05, 0.05));
    });
  });
  // Ground in every cell and every patch of surface.
  add("evenly on a plain", [](std::size_t count, Random& random) {
    return drawn(count, [&](std::size_t) {
      return polar(100 * std::sqrt(random.uniform(0, 1)), random.uniform(0, two_pi),
                   ground + random.uniform(-0.05, 0.05));
    });
  });
  add("runs of two", [](std::size_t n, Random& random) { return short_runs(n, 2, random); });
  add("runs of three", [](std::size_t n, Random& random) { return short_runs(n, 3, random); });
  add("runs of four", [](std::size_t n, Random& random) { return short_runs(n, 4, random); });
  add("balls", [](std::size_t n, Random& random) { return clusters(n, 0.05, random); });
  add("needles", [](std::size_t n, Random& random) { return clusters(n, 0.5, random); });
  add("hard to select from", hard_to_select);
  add("denormal numbers", denormal);
  add("heights of 1e-20 m", small_heights);
  add("no point valid", [](std::size_t count, Random& random) {
    return corrupted(Cloud(count, Point{0, 0, 0}), random);
  });
  add("all out of range", [](std::size_t count, Random& random) {
    return drawn(count, [&](std::size_t) {
      return polar(random.uniform(81, 1e4), random.uniform(0, two_pi), ground);
    });
  });
  add("arbitrary bit patterns", [](std::size_t count, Random& random) {
    return drawn(count, [&](std::size_t) {
      Point p{};
      for (float* coordinate : {&p.x, &p.y, &p.z}) {
        *coordinate = std::bit_cast<float>(static_cast<std::uint32_t>(random.bits() >> 32U));
      }
      return p;
    });
  });
  return kinds;
}

}  // namespace

std::vector<ScanKind> scan_kinds(const Sources& sources) {
  std::vector<ScanKind> kinds;
  const auto add_variants = [&](const std::string& name, const std::vector<Cloud>& scans) {
    const auto draw = [&scans](std::size_t count, Random& random) {
      return variant(scans, count, random);
    };
    kinds.push_back({.name = name, .ordinary = true, .draw = draw});
    kinds.push_back({.name = name + ", shuffled",
                     .ordinary = false,
                     .draw = [draw](std::size_t count, Random& random) {
                       return shuffled(draw(count, random), random);
                     }});
    kinds.push_back({.name = name + ", corrupted",
                     .ordinary = false,
                     .draw = [draw](std::size_t count, Random& random) {
                       return corrupted(draw(count, random), random);
                     }});
  };
  add_variants("simulated", sources.simulated);
  kinds.push_back({.name = "simulated, a quarter without return",
                   .ordinary = false,
                   .draw = [&sources](std::size_t count, Random& random) {
                     Cloud cloud = variant(sources.simulated, count, random);
                     for (Point& p : cloud) {
                       if (random.chance(0.25)) p = {0, 0, 0};
                     }
                     return cloud;
                   }});
  for (const auto& [set, scans] : sources.real) add_variants("real, " + set, scans);
  if (!sources.voxel_means.empty()) {
    kinds.push_back({.name = "real, voxel means",
                     .ordinary = false,
                     .draw = [&sources](std::size_t count, Random& random) {
                       return variant(sources.voxel_means, count, random);
                     }});
  }
  for (ScanKind& kind : adversarial_kinds()) kinds.push_back(std::move(kind));
  return kinds;
}

Sources load_sources() {
  Sources sources;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    sources.simulated.push_back(simulated_street(64, 2600, seed));
  }
  for (const auto& [set, path] : real_scan_paths()) {
    Cloud cloud = finite_points(path);
    if (cloud.empty()) continue;
    const bool voxel_means = path.stem().string().ends_with("-sub");
    (voxel_means ? sources.voxel_means : sources.real[set]).push_back(std::move(cloud));
  }
  return sources;
}

}  // namespace flagstone::performance
