// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Measures whether the memory of a segmenter stays constant. Segments SCANS different scans
// (default: 100,000) with one segmenter and one result, and prints the memory of the process over
// time as JSON. The scans are rotated and cut to random sizes, and every third one is corrupted.
// The exit code is 1 if the memory grew after the first tenth.
//
//   soak METHOD [SCANS]

#include <unistd.h>

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#include <flagstone/patchwork.hpp>
#include <flagstone/segmentation.hpp>
#include <flagstone/surface.hpp>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "clouds.hpp"
#include "lab/eval/results_export.hpp"

namespace flagstone::performance {
namespace {

constexpr std::size_t rows = 100;  ///< samples of the memory
/// Allowed increase after the first tenth of the scans, bytes. A leak of about 10 bytes per scan
/// reaches it after 100,000 scans.
constexpr long allowed_growth = 1 << 20;

std::unique_ptr<Segmenter> make(std::string_view method) {
  if (method == "surface") return std::make_unique<Surface>();
  if (method == "patchwork") return std::make_unique<Patchwork>();
  throw std::invalid_argument("METHOD must be patchwork or surface");
}

/// Resident memory of the process, bytes.
long resident_bytes() {
  std::ifstream file("/proc/self/statm");
  long pages = 0;
  long resident = 0;
  file >> pages >> resident;
  if (!file) throw std::runtime_error("/proc/self/statm: cannot be read");
  return resident * ::sysconf(_SC_PAGESIZE);
}

std::size_t below(Random& random, std::size_t count) {
  return static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
}

/// Replaces a tenth of the points by points with invalid coordinates.
void corrupt(Cloud& cloud, Random& random) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float huge = std::numeric_limits<float>::max();
  const Point faults[] = {{nan, 0, 0},   {1, 2, huge},   {0, 0, 0},        {-huge, huge, nan},
                          {5, 5, -9000}, {3, 3, 1e-42f}, {1e20f, 0, -1.7f}};
  const Point fault = faults[below(random, std::size(faults))];
  for (std::size_t i = 0; i < cloud.size() / 10; ++i) cloud[below(random, cloud.size())] = fault;
}

/// Creates random scans in one buffer.
class Scans {
 public:
  Scans() {
    for (std::uint64_t seed = 1; seed <= 8; ++seed)
      sources_.push_back(simulated_street(64, 3000, seed));
    for (const Cloud& source : sources_) scan_.reserve(source.size());
  }

  /// A scan of random size, rotation and height. One scan in fifty is empty.
  const Cloud& draw(Random& random) {
    const Cloud& source = sources_[below(random, sources_.size())];
    const double fraction = random.uniform();
    const auto count =
        fraction < 0.02
            ? 0
            : static_cast<std::size_t>(fraction * fraction * static_cast<double>(source.size()));
    const double angle = 6.283185307179586 * random.uniform();
    const auto cosine = static_cast<float>(std::cos(angle));
    const auto sine = static_cast<float>(std::sin(angle));
    const auto raised = static_cast<float>(0.2 * random.uniform() - 0.1);
    const std::size_t first = below(random, source.size() - count + 1);
    scan_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Point& p = source[first + i];
      scan_[i] = {cosine * p.x - sine * p.y, sine * p.x + cosine * p.y, p.z + raised};
    }
    if (!scan_.empty() && random.uniform() < 1.0 / 3) corrupt(scan_, random);
    return scan_;
  }

 private:
  std::vector<Cloud> sources_;
  Cloud scan_;
};

int soak(const std::string& method, std::size_t count) {
  const std::unique_ptr<Segmenter> segmenter = make(method);
  Segmentation result;
  Scans scans;
  Random random(7);
  nlohmann::ordered_json memory = nlohmann::ordered_json::array();
  std::size_t points = 0;
  long after_warm_up = 0;
  long maximum = 0;
  for (std::size_t done = 1; done <= count; ++done) {
    const Cloud& scan = scans.draw(random);
    const Status status = segmenter->segment(view_of(scan), result);
    if (!status.ok()) throw std::runtime_error(status.message());
    if (result.labels().size() != scan.size())
      throw std::runtime_error("number of labels differs from number of points");
    points += scan.size();
    if (done % (count / rows) != 0) continue;
    const long bytes = resident_bytes();
    memory.push_back({{"scans", done}, {"bytes", bytes}});
    if (memory.size() == rows / 10) after_warm_up = bytes;
    if (memory.size() > rows / 10) maximum = std::max(maximum, bytes);
  }
  const long growth = maximum - after_warm_up;
  const nlohmann::ordered_json results = {
      {"method", method},       {"machine", eval::machine_name()},
      {"scans", count},         {"points", points},
      {"growth_bytes", growth}, {"allowed_growth_bytes", allowed_growth},
      {"memory", memory}};
  std::cout << results.dump() << '\n';
  return growth > allowed_growth ? 1 : 0;
}

std::size_t count_of(std::string_view text) {
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < rows ||
      count > 1000000000) {
    throw std::invalid_argument("SCANS must be 100 to 1,000,000,000");
  }
  return count;
}

}  // namespace
}  // namespace flagstone::performance

int main(int argc, char** argv) {
  try {
    if (argc < 2 || argc > 3) throw std::invalid_argument("usage: soak METHOD [SCANS]");
    return flagstone::performance::soak(
        argv[1], argc < 3 ? 100000 : flagstone::performance::count_of(argv[2]));
  } catch (const std::exception& error) {
    std::cerr << "soak: " << error.what() << '\n';
    return 2;
  }
}
