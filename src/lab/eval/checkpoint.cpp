// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "files/io/atomic_file.hpp"
#include "files/io/message.hpp"

namespace flagstone::eval {
namespace {

using Json = nlohmann::json;
constexpr auto replace = Json::error_handler_t::replace;  // file names may not be UTF-8

Json checkpoint_json(const Confusion& c) {
  return {c.true_positives, c.false_positives, c.false_negatives, c.true_negatives};
}

Confusion confusion_of(const Json& json) {
  return {json.at(0), json.at(1), json.at(2), json.at(3)};
}

Json checkpoint_json(const HeightErrors& e) {
  return {e.points, e.given, e.median, e.percentile95, e.bias};
}

HeightErrors height_errors_of(const Json& json) {
  return {.points = json.at(0),
          .given = json.at(1),
          .median = json.at(2),
          .percentile95 = json.at(3),
          .bias = json.at(4)};
}

Json checkpoint_json(const HeightErrorsByRange& errors) {
  Json json = Json::array();
  json.push_back(checkpoint_json(errors.all));
  for (const HeightErrors& band : errors.by_range) json.push_back(checkpoint_json(band));
  return json;
}

HeightErrorsByRange height_errors_by_range_of(const Json& json) {
  HeightErrorsByRange errors{.all = height_errors_of(json.at(0))};
  for (std::size_t band = 0; band < errors.by_range.size(); ++band) {
    errors.by_range[band] = height_errors_of(json.at(band + 1));
  }
  return errors;
}

Json checkpoint_json(const MethodOutcome& outcome) {
  Json json = {{"points", checkpoint_json(outcome.score.points)},
               {"area", checkpoint_json(outcome.score.by_area)}};
  for (const Confusion& band : outcome.score.by_range)
    json["range"].push_back(checkpoint_json(band));
  if (outcome.segment_ms) json["ms"] = *outcome.segment_ms;
  if (outcome.heights) {
    const HeightScore& heights = *outcome.heights;
    json["heights"] =
        Json::array({checkpoint_json(heights.ground), checkpoint_json(heights.everywhere)});
    if (heights.has_common) {
      json["heights"].push_back(checkpoint_json(heights.common_ground));
      json["heights"].push_back(checkpoint_json(heights.common_everywhere));
    }
  }
  return json;
}

MethodOutcome method_outcome_of(const Json& json) {
  MethodOutcome outcome;
  outcome.score.points = confusion_of(json.at("points"));
  outcome.score.by_area = confusion_of(json.at("area"));
  for (std::size_t band = 0; band < outcome.score.by_range.size(); ++band) {
    outcome.score.by_range[band] = confusion_of(json.at("range").at(band));
  }
  if (json.contains("ms")) outcome.segment_ms = json.at("ms").get<double>();
  if (json.contains("heights")) {
    const Json& heights = json.at("heights");
    outcome.heights = {.ground = height_errors_by_range_of(heights.at(0)),
                       .everywhere = height_errors_by_range_of(heights.at(1)),
                       .common_ground = {},
                       .common_everywhere = {}};
    if (heights.size() > 2) {
      outcome.heights->has_common = true;
      outcome.heights->common_ground = height_errors_by_range_of(heights.at(2));
      outcome.heights->common_everywhere = height_errors_by_range_of(heights.at(3));
    }
  }
  return outcome;
}

Json checkpoint_json(const MovingCounts& counts) {
  Json json = checkpoint_json(counts.points);
  json.push_back(counts.obstacles);
  json.push_back(counts.kept);
  return json;
}

MovingCounts moving_counts_of(const Json& json) {
  return {.points = confusion_of(json), .obstacles = json.at(4), .kept = json.at(5)};
}

/// The counts of each range band.
Json checkpoint_json(const MovingOutcome& outcome) {
  Json json = Json::array();
  for (const MovingCounts& band : outcome.score.by_range) json.push_back(checkpoint_json(band));
  return json;
}

MovingOutcome moving_outcome_of(const Json& json) {
  MovingOutcome outcome;
  for (std::size_t band = 0; band < outcome.score.by_range.size(); ++band) {
    outcome.score.by_range[band] = moving_counts_of(json.at(band));
    outcome.score.all += outcome.score.by_range[band];
  }
  return outcome;
}

Json checkpoint_json(const std::string& scan, const ScanOutcome& outcome) {
  Json json = {{"scan", scan}, {"read", outcome.read_ms}, {"score", outcome.score_ms}};
  json["methods"] = Json::array();
  for (const MethodOutcome& method : outcome.methods)
    json["methods"].push_back(checkpoint_json(method));
  for (const MovingOutcome& moving : outcome.moving)
    json["moving"].push_back(checkpoint_json(moving));
  return json;
}

/// The scan of one line; nullopt if the line is truncated.
std::optional<std::pair<std::string, ScanOutcome>> scan_of(const std::string& line) {
  try {
    const Json json = Json::parse(line);
    ScanOutcome outcome;
    outcome.read_ms = json.at("read");
    outcome.score_ms = json.at("score");
    for (const Json& method : json.at("methods")) {
      outcome.methods.push_back(method_outcome_of(method));
    }
    if (json.contains("moving")) {
      for (const Json& moving : json.at("moving")) {
        outcome.moving.push_back(moving_outcome_of(moving));
      }
    }
    return std::pair(json.at("scan").get<std::string>(), std::move(outcome));
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

constexpr std::string_view heading_begin = "{\"flagstone-checkpoint\":";

std::string heading_of(const std::string& evaluation) {
  return Json{{"flagstone-checkpoint", evaluation}}.dump(-1, ' ', false, replace) + "\n";
}

/// Whether the file contains at least one scan of an evaluation.
bool contains_scans(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string heading;
  std::string scan;
  return std::getline(file, heading) && heading.starts_with(heading_begin) &&
         std::getline(file, scan) && scan_of(scan);
}

bool has_failed(const ScanOutcome& outcome) {
  const auto failed = [](const auto& part) { return part.error.has_value(); };
  return outcome.error || std::ranges::any_of(outcome.methods, failed) ||
         std::ranges::any_of(outcome.moving, failed);
}

}  // namespace

Status Checkpoint::open(const std::filesystem::path& path) {
  file_.reset(std::fopen(path.c_str(), "a"));
  if (file_) return {};
  return Status(StatusCode::unwritable,
                fmt::format("{}: cannot be written: {}", io::printable(path),
                            std::generic_category().message(errno)));
}

Status Checkpoint::start(const std::filesystem::path& path, const std::string& evaluation) {
  if (contains_scans(path)) {
    return io::refuse(
        path,
        "contains the finished scans of an interrupted run (continue it with --resume, or "
        "delete the file to start again)");
  }
  Status status = io::write_file(path, std::string_view(heading_of(evaluation)));
  return status.ok() ? open(path) : status;
}

Status Checkpoint::resume(const std::filesystem::path& path, const std::string& evaluation,
                          const OutcomeCounts& counts,
                          std::map<std::string, ScanOutcome>& finished) {
  std::ifstream old(path);
  if (!old) return start(path, evaluation);
  std::string line;
  std::getline(old, line);
  if (!line.starts_with(heading_begin)) {
    return io::with_path(path,
                         Status(StatusCode::bad_file, "is not a checkpoint of an evaluation"));
  }
  if (line + "\n" != heading_of(evaluation)) {
    return io::refuse(path,
                      "belongs to an evaluation with other datasets, methods, settings or protocol "
                      "(delete the file to start again)");
  }
  // Rewrite the file without truncated lines, which would corrupt the next line.
  std::string kept = heading_of(evaluation);
  while (std::getline(old, line)) {
    std::optional<std::pair<std::string, ScanOutcome>> scan = scan_of(line);
    if (!scan || scan->second.methods.size() != counts.methods ||
        scan->second.moving.size() != counts.moving) {
      continue;
    }
    kept += line + "\n";
    finished.insert(std::move(*scan));
  }
  Status status = io::write_file(path, std::string_view(kept));
  return status.ok() ? open(path) : status;
}

void Checkpoint::add(const std::string& scan, const ScanOutcome& outcome) {
  if (!file_ || has_failed(outcome)) return;
  const std::string line = checkpoint_json(scan, outcome).dump(-1, ' ', false, replace) + "\n";
  std::fwrite(line.data(), 1, line.size(), file_.get());
  std::fflush(file_.get());
}

}  // namespace flagstone::eval
