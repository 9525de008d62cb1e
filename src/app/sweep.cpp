// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/sweep.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "app/config/config_toml.hpp"
#include "files/io/message.hpp"
#include "lab/eval/results_export.hpp"
#include "library/methods/method.hpp"

namespace flagstone::app {
namespace {

/// The integer in `text`; 0 if it is not an integer.
int integer_of(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : 0;
}

void make_uniform_grid(const std::string& value, MethodConfig& config) {
  auto* patchwork = config.get_if<PatchworkConfig>();
  const std::size_t times = value.find('x');
  const int rings = integer_of(std::string_view(value).substr(0, times));
  const int sectors =
      times == std::string::npos ? 0 : integer_of(std::string_view(value).substr(times + 1));
  if (patchwork == nullptr || rings < 1 || rings > 1000 || sectors < 1) {
    throw std::invalid_argument(fmt::format(
        "bins = {}: is not allowed (expected RINGSxSECTORS, e.g. 30x108, with --method patchwork, "
        "r_gpf or czm+...)",
        value));
  }
  const float outer = patchwork->zones.back().ring_radii.back();
  patchwork->zones = {{.ring_radii = equal_rings(patchwork->min_range, outer, rings),
                       .sectors = sectors,
                       .height_margin = -std::numeric_limits<float>::infinity()}};
}

/// Fig. 5 of the paper: bin sizes of the uniform grid and uprightness thresholds. The paper does
/// not list its values. At 0 degrees, uprightness rejects nothing.
const std::vector<std::string> figure_5 = {"bins=10x36,15x54,20x72,30x108,45x162,60x216",
                                           "uprightness.angle=0,15,30,45,60,75"};

constexpr double percent = 100;

std::string name_of(const Sweep& sweep, std::size_t point) {
  const std::vector<std::string> values = sweep.values_at(point);
  std::string name;
  for (std::size_t a = 0; a < sweep.axes.size(); ++a) {
    name += fmt::format("{}{} = {}", a == 0 ? "" : ", ", sweep.axes[a].key, values[a]);
  }
  return name;
}

/// Width of a column for the key and the values of an axis, with a gap before it.
std::size_t width_of(const SweepAxis& axis) {
  std::size_t longest = axis.key.size();
  for (const std::string& value : axis.values) longest = std::max(longest, value.size());
  return longest + 2;
}

/// "-" if there is no value, as for the standard deviation over one scan.
std::string percent_text(const std::optional<double>& share) {
  return share ? fmt::format("{:>6}", eval::percent_text(*share)) : fmt::format("{:>6}", "-");
}

std::string spread_text(const eval::Spread& spread) {
  return fmt::format("{:>8} {}", eval::percent_text(spread.mean), percent_text(spread.std));
}

/// F1 of `a` minus F1 of `b`, over the scans that both have.
eval::Spread difference(const eval::MethodResult& a, const eval::MethodResult& b) {
  std::map<std::string, double> of_b;
  for (const eval::ScanScore& scan : b.scans) of_b[scan.scan] = scan.score.points.f1();
  std::vector<double> differences;
  for (const eval::ScanScore& scan : a.scans) {
    const auto found = of_b.find(scan.scan);
    if (found != of_b.end()) differences.push_back(scan.score.points.f1() - found->second);
  }
  return eval::spread_of(differences);
}

}  // namespace

SweepAxis sweep_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    throw std::invalid_argument(
        fmt::format("--param {}: is not KEY=VALUE,VALUE,... (expected e.g. --param "
                    "distance_margin=0.1,0.125,0.15)",
                    text));
  }
  if (io::printable(text) != text) {
    throw std::invalid_argument(fmt::format("--param {}: contains unprintable characters", text));
  }
  SweepAxis axis{.key = text.substr(0, equals), .values = {}};
  std::size_t begin = equals + 1;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    axis.values.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return axis;
}

void apply_axis(const std::string& key, const std::string& value, MethodConfig& config) {
  if (key == "bins") {
    make_uniform_grid(value, config);
  } else {
    MountSettings unused;
    config::apply_toml(fmt::format("{} = {}", key, value), fmt::format("--param {}={}", key, value),
                       config, unused);
  }
}

std::vector<SweepAxis> sweep_axes(const std::vector<std::string>& texts) {
  std::vector<SweepAxis> axes;
  for (const std::string& text : texts.empty() ? figure_5 : texts) axes.push_back(sweep_axis(text));
  if (axes.size() > 2)
    throw std::invalid_argument("--param: is given more than twice (expected once or twice)");
  if (axes.size() == 2 && axes[0].key == axes[1].key) {
    throw std::invalid_argument(
        fmt::format("--param: {} is given twice (give all its values at once)", axes[0].key));
  }
  return axes;
}

std::vector<std::string> Sweep::values_at(std::size_t point) const {
  std::vector<std::string> values(axes.size());
  for (std::size_t a = axes.size(); a-- > 0;) {
    values[a] = axes[a].values[point % axes[a].values.size()];
    point /= axes[a].values.size();
  }
  return values;
}

std::vector<eval::Method> Sweep::points(const MethodConfig& base,
                                        const MountSettings& mount) const {
  std::size_t count = 1;
  for (const SweepAxis& axis : axes) count *= axis.values.size();
  constexpr std::size_t most = 10000;
  if (count > most) {
    throw std::invalid_argument(
        fmt::format("--param: {} points are too many (expected up to {})", count, most));
  }
  std::vector<eval::Method> points;
  for (std::size_t p = 0; p < count; ++p) {
    const std::vector<std::string> values = values_at(p);
    MethodConfig config = base;
    for (std::size_t a = 0; a < values.size(); ++a) {
      if (axes[a].key != "bins") apply_axis(axes[a].key, values[a], config);
    }
    for (std::size_t a = 0; a < values.size(); ++a) {  // last, because it reads min_range
      if (axes[a].key == "bins") apply_axis(axes[a].key, values[a], config);
    }
    MountSettings own_mount = mount;  // the sweep may be over the sensor height
    own_mount.mount.sensor_height = sensor_height_of(config, mount.mount.sensor_height);
    points.push_back(eval::method_of(method, std::move(config), own_mount));
  }
  return points;
}

std::string to_text(const Sweep& sweep) {
  std::string text;
  for (const SweepAxis& axis : sweep.axes) text += fmt::format("{:>{}}", axis.key, width_of(axis));
  text += fmt::format("{:>11}{:>7}{:>9}{:>7}{:>9}{:>7}{:>7}\n", "precision", "std", "recall", "std",
                      "F1", "std", "±95%");
  for (std::size_t p = 0; p < sweep.results.methods.size(); ++p) {
    const eval::MethodResult& result = sweep.results.methods[p];
    const std::vector<std::string> values = sweep.values_at(p);
    for (std::size_t a = 0; a < values.size(); ++a) {
      text += fmt::format("{:>{}}", values[a], width_of(sweep.axes[a]));
    }
    text +=
        fmt::format("   {} {} {} {}\n", spread_text(result.precision), spread_text(result.recall),
                    spread_text(result.f1), percent_text(result.f1.ci95));
  }
  return text;
}

std::string to_csv(const Sweep& sweep) {
  std::string text;
  for (const SweepAxis& axis : sweep.axes) text += eval::csv_cell(axis.key) + ",";
  text += "scans";
  for (const char* figure : {"precision", "recall", "f1"}) {
    text += fmt::format(",{0}_mean,{0}_std,{0}_ci95", figure);
  }
  text += "\r\n";
  const auto cell = [](const std::optional<double>& value) {
    return value && !std::isnan(*value) ? fmt::format(",{:.6f}", *value) : std::string(",");
  };
  for (std::size_t p = 0; p < sweep.results.methods.size(); ++p) {
    const eval::MethodResult& result = sweep.results.methods[p];
    for (const std::string& value : sweep.values_at(p)) text += eval::csv_cell(value) + ",";
    text += fmt::format("{}", result.scans.size());
    for (const eval::Spread& spread : {result.precision, result.recall, result.f1}) {
      text += cell(spread.mean) + cell(spread.std) + cell(spread.ci95);
    }
    text += "\r\n";
  }
  return text;
}

nlohmann::ordered_json to_json(const Sweep& sweep) {
  nlohmann::ordered_json json = eval::results_heading();
  json["protocol"] = sweep.results.protocol;
  json["datasets"] = sweep.results.datasets;
  json["scans"] = sweep.results.scans;
  json["method"] = sweep.method;
  json["keys"] = nlohmann::ordered_json::array();
  for (const SweepAxis& axis : sweep.axes) json["keys"].push_back(axis.key);
  json["cells"] = nlohmann::ordered_json::array();
  for (std::size_t p = 0; p < sweep.results.methods.size(); ++p) {
    const eval::MethodResult& result = sweep.results.methods[p];
    json["cells"].push_back({{"values", sweep.values_at(p)},
                             {"precision", eval::to_json(result.precision)},
                             {"recall", eval::to_json(result.recall)},
                             {"f1", eval::to_json(result.f1)}});
  }
  json["winner"] = winner_text(sweep);
  return json;
}

std::string winner_text(const Sweep& sweep) {
  const std::vector<eval::MethodResult>& points = sweep.results.methods;
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (sweep.results.scans == sweep.results.without_ground) {
    return "No F1: the ground truth of no scan contains ground.";
  }
  std::erase_if(order, [&](std::size_t p) { return points[p].f1.count == 0; });  // it failed
  if (order.empty()) return "No setting has an F1.";
  std::ranges::sort(order, {}, [&](std::size_t p) { return std::pair(-points[p].f1.mean, p); });
  std::string text = fmt::format("Best F1: {:.2f} % at {}", percent * points[order[0]].f1.mean,
                                 name_of(sweep, order[0]));
  if (order.size() < 2) return text + ".";
  const eval::Spread ahead = difference(points[order[0]], points[order[1]]);
  text += fmt::format("; {:.2f} percentage points ahead of {}", percent * ahead.mean,
                      name_of(sweep, order[1]));
  if (!ahead.ci95) return text + "; one scan gives no confidence interval.";
  if (*ahead.ci95 == 0) return text + ", the same difference on every scan.";
  const double intervals = ahead.mean / *ahead.ci95;
  return text + fmt::format(", {:.1f} times the half-width of its 95 % confidence interval: {}.",
                            intervals, intervals > 1 ? "significant" : "not significant");
}

}  // namespace flagstone::app
