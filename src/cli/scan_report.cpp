// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/scan_report.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "lab/eval/statistics.hpp"
#include "library/core/statistics.hpp"

namespace flagstone::cli {
namespace {

using Json = nlohmann::ordered_json;

Json counts_json(const ScanReport& report) {
  Json counts;
  for (std::size_t code = 0; code < label_count; ++code) {
    counts[to_string(static_cast<Label>(code))] = report.counts[code];
  }
  return counts;
}

Json scores_json(const ScanReport& report) {
  Json scores;
  for (const auto& [protocol, confusion] : report.scores) {
    scores[protocol] = {{"precision", confusion.precision()},
                        {"recall", confusion.recall()},
                        {"f1", confusion.f1()},
                        {"accuracy", confusion.accuracy()}};
  }
  return scores;
}

Json mount_json(const MountReport& report) {
  return {{"sensor_height", report.mount.sensor_height},
          {"up", report.mount.up},
          {"verdict", to_string(report.decision.verdict)},
          {"confidence", report.decision.confidence},
          {"why", to_sentence(report.decision)}};
}

std::string scores_text(std::span<const ScanReport> reports) {
  struct Scores {
    std::vector<double> precision, recall, f1;
  };
  std::map<std::string, Scores> all;
  for (const ScanReport& report : reports) {
    for (const auto& [protocol, confusion] : report.scores) {
      Scores& scores = all[protocol];
      scores.precision.push_back(confusion.precision());
      scores.recall.push_back(confusion.recall());
      scores.f1.push_back(confusion.f1());
    }
  }
  const auto mean = [](const std::vector<double>& values) {
    return eval::percent_text(eval::spread_of(values).mean);
  };
  std::string text;
  for (const auto& [protocol, scores] : all) {
    const std::size_t with_ground = eval::spread_of(scores.f1).count;
    text += fmt::format(
        "protocol {:<12} precision {:>6}  recall {:>6}  F1 {:>6}  (mean of {} scans", protocol,
        mean(scores.precision), mean(scores.recall), mean(scores.f1), with_ground);
    if (const std::size_t others = scores.f1.size() - with_ground; others > 0) {
      text += fmt::format(", {} without ground in the ground truth left out", others);
    }
    text += ", %)\n";
  }
  return text;
}

}  // namespace

double ScanReport::ground_share() const noexcept {
  const std::size_t ground = counts[static_cast<std::size_t>(Label::ground)];
  return points == 0 ? 0 : static_cast<double>(ground) / static_cast<double>(points);
}

std::string text_line(const ScanReport& report) {
  std::string line = fmt::format(
      "{}: {} points, {:.1f} % ground, {} patches; read {:.2f} ms, segment {:.2f} ms, write {:.2f} "
      "ms",
      report.file.string(), report.points, 100 * report.ground_share(), report.patches,
      report.read_ms, report.segment_ms, report.write_ms);
  for (const auto& [protocol, confusion] : report.scores) {
    line += fmt::format("; F1 {} % ({})", eval::percent_text(confusion.f1()), protocol);
  }
  if (report.mount && report.mount_is_own) {
    line += fmt::format("; sensor taken for {:.2f} m high: {}", report.mount->mount.sensor_height,
                        to_sentence(report.mount->decision));
  }
  return line;
}

std::string json_line(const ScanReport& report) {
  Json json;
  json["file"] = report.file.string();
  if (report.error) {
    json["error"] = *report.error;
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  json["points"] = report.points;
  json["counts"] = counts_json(report);
  json["patches"] = report.patches;
  json["milliseconds"] = {
      {"read", report.read_ms}, {"segment", report.segment_ms}, {"write", report.write_ms}};
  if (report.picture_ms > 0) json["milliseconds"]["picture"] = report.picture_ms;
  if (report.mount) json["mount"] = mount_json(*report.mount);
  if (!report.scores.empty()) json["scores"] = scores_json(report);
  json["outputs"] = Json::array();
  for (const auto& output : report.outputs) json["outputs"].push_back(output.string());
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);  // file names may not be UTF-8
}

std::string summary_text(std::span<const ScanReport> reports) {
  std::vector<double> times;
  std::size_t points = 0;
  for (const ScanReport& report : reports) {
    if (report.error) continue;
    times.push_back(report.segment_ms);
    points += report.points;
  }
  std::string text = scores_text(reports);
  text += fmt::format("{} of {} scans segmented, {} points", times.size(), reports.size(), points);
  if (!times.empty()) text += fmt::format(", median {:.2f} ms a scan", median(times));
  return text + "\n";
}

}  // namespace flagstone::cli
