// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "eval/journal.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "io/message.hpp"

namespace flagstone::eval {
namespace {

using Json = nlohmann::json;
constexpr auto replace = Json::error_handler_t::replace;  // file names may not be UTF-8

Json to_json(const Confusion& c) {
  return {c.true_positives, c.false_positives, c.false_negatives, c.true_negatives};
}

Confusion confusion_of(const Json& json) {
  return {json.at(0), json.at(1), json.at(2), json.at(3)};
}

Json to_json(const MethodOutcome& outcome) {
  if (outcome.error) return {{"error", *outcome.error}};
  Json json = {{"points", to_json(outcome.score.points)}, {"area", to_json(outcome.score.by_area)}};
  for (const Confusion& band : outcome.score.by_range) json["range"].push_back(to_json(band));
  if (outcome.segment_ms) json["ms"] = *outcome.segment_ms;
  return json;
}

MethodOutcome method_outcome_of(const Json& json) {
  MethodOutcome outcome;
  if (json.contains("error")) {
    outcome.error = json.at("error").get<std::string>();
    return outcome;
  }
  outcome.score.points = confusion_of(json.at("points"));
  outcome.score.by_area = confusion_of(json.at("area"));
  for (std::size_t band = 0; band < outcome.score.by_range.size(); ++band) {
    outcome.score.by_range[band] = confusion_of(json.at("range").at(band));
  }
  if (json.contains("ms")) outcome.segment_ms = json.at("ms").get<double>();
  return outcome;
}

Json to_json(const std::string& scan, const ScanOutcome& outcome) {
  Json json = {{"scan", scan}, {"read", outcome.read_ms}, {"score", outcome.score_ms}};
  json["methods"] = Json::array();
  for (const MethodOutcome& method : outcome.methods) json["methods"].push_back(to_json(method));
  return json;
}

/// Adds the scan of one line; nothing where the line is cut short.
void read_line(const std::string& line, std::map<std::string, ScanOutcome>& finished) {
  try {
    const Json json = Json::parse(line);
    ScanOutcome outcome;
    outcome.read_ms = json.at("read");
    outcome.score_ms = json.at("score");
    for (const Json& method : json.at("methods")) {
      outcome.methods.push_back(method_outcome_of(method));
    }
    finished.insert_or_assign(json.at("scan").get<std::string>(), std::move(outcome));
  } catch (const Json::exception&) {
    return;
  }
}

std::string heading_of(const std::string& evaluation) {
  return Json{{"flagstone-journal", evaluation}}.dump(-1, ' ', false, replace);
}

}  // namespace

Status Journal::start(const std::filesystem::path& path, const std::string& evaluation) {
  path_ = path;
  file_.reset(std::fopen(path.c_str(), "w"));
  if (!file_) {
    return Status(StatusCode::unwritable,
                  fmt::format("{}: cannot be written: {}", io::printable(path),
                              std::generic_category().message(errno)));
  }
  fmt::print(file_.get(), "{}\n", heading_of(evaluation));
  std::fflush(file_.get());
  return {};
}

Status Journal::resume(const std::filesystem::path& path, const std::string& evaluation,
                       std::map<std::string, ScanOutcome>& finished) {
  std::ifstream old(path);
  if (!old) return start(path, evaluation);
  std::string line;
  std::getline(old, line);
  if (!line.starts_with("{\"flagstone-journal\":")) {
    return io::with_path(path, Status(StatusCode::bad_file, "is no journal of an evaluation"));
  }
  if (line != heading_of(evaluation)) {
    return io::refuse(path,
                      "is of an evaluation with other methods, settings or protocol; leave "
                      "--resume out to start afresh");
  }
  while (std::getline(old, line)) read_line(line, finished);
  // Written anew, so that a line cut short does not spoil the next.
  if (Status status = start(path, evaluation); !status.ok()) return status;
  for (const auto& [scan, outcome] : finished) add(scan, outcome);
  return {};
}

void Journal::add(const std::string& scan, const ScanOutcome& outcome) {
  if (!file_ || outcome.error) return;
  fmt::print(file_.get(), "{}\n", to_json(scan, outcome).dump(-1, ' ', false, replace));
  std::fflush(file_.get());
}

void Journal::remove() {
  if (!file_) return;
  file_.reset();
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace flagstone::eval
