// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/scan_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "files/io/message.hpp"
#include "lab/eval/statistics.hpp"
#include "library/core/statistics.hpp"

namespace flagstone::app {
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
      text += fmt::format(", without {} that have no ground", others);
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

std::string hint_of(const ScanReport& report) {
  const std::size_t beyond = report.counts[static_cast<std::size_t>(Label::out_of_range)];
  if (2 * beyond <= report.points) return {};
  return {
      "most points are out of range (expected metres and an origin at the sensor; 'flagstone "
      "doctor' finds the cause)"};
}

std::string text_line(const ScanReport& report) {
  std::string line = fmt::format(
      "{}: {} points, {:.1f} % ground, {} patches; read {:.2f} ms, segment {:.2f} ms, write {:.2f} "
      "ms",
      io::printable(report.file), report.points, 100 * report.ground_share(), report.patches,
      report.read_ms, report.segment_ms, report.write_ms);
  for (const auto& [protocol, confusion] : report.scores) {
    line += fmt::format("; F1 {} % ({})", eval::percent_text(confusion.f1()), protocol);
  }
  if (report.mount && report.mount_is_own) {
    line += fmt::format("; sensor height {:.2f} m: {}", report.mount->mount.sensor_height,
                        to_sentence(report.mount->decision));
  }
  if (const std::string hint = hint_of(report); !hint.empty()) line += "; " + hint;
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
  if (const std::string hint = hint_of(report); !hint.empty()) json["hint"] = hint;
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
  if (!times.empty()) text += fmt::format(", median {:.2f} ms per scan", median(times));
  return text + "\n";
}

std::string throughput_text(std::span<const ScanReport> reports, const RunTime& time) {
  double scans = 0;
  double bytes = 0;
  double read_ms = 0;
  double segment_ms = 0;
  double write_ms = 0;
  for (const ScanReport& report : reports) {
    if (report.error) continue;
    scans += 1;
    bytes += static_cast<double>(report.file_size);
    read_ms += report.read_ms;
    segment_ms += report.segment_ms;
    write_ms += report.write_ms;
  }
  if (scans == 0 || time.seconds <= 0) return {};

  const double all_ms = 1000 * time.seconds * static_cast<double>(time.workers);
  const double files_ms = read_ms + write_ms;
  const double other_ms = std::max(0.0, all_ms - files_ms - segment_ms);
  const char* const bottleneck = other_ms > std::max(files_ms, segment_ms) ? "neither"
                                 : files_ms > segment_ms                   ? "file I/O"
                                                                           : "segmentation";
  return fmt::format(
      "{:.1f} scans per second, {:.1f} MB/s read; {} {}: {:.0f} % reading, {:.0f} % segmenting, "
      "{:.0f} % writing, {:.0f} % other; bottleneck: {} (per scan {:.3f} ms file I/O, {:.3f} ms "
      "segmentation)\n",
      scans / time.seconds, bytes / 1e6 / time.seconds, time.workers,
      time.workers == 1 ? "worker" : "workers", 100 * read_ms / all_ms, 100 * segment_ms / all_ms,
      100 * write_ms / all_ms, 100 * other_ms / all_ms, bottleneck, files_ms / scans,
      segment_ms / scans);
}

}  // namespace flagstone::app
