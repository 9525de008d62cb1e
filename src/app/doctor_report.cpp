// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <variant>

#include "app/doctor/advice.hpp"
#include "app/doctor/examination.hpp"
#include "app/doctor/summary.hpp"
#include "app/scan_files.hpp"
#include "app/wrapped.hpp"
#include "files/io/atomic_file.hpp"
#include "files/io/message.hpp"
#include "files/io/read_cloud.hpp"
#include "library/methods/method.hpp"

namespace flagstone::app {
namespace {

using doctor::Finding;
using doctor::Severity;

constexpr std::array<Severity, 3> most_severe_first{Severity::fix, Severity::note, Severity::fine};

constexpr std::size_t id_width = 17;
constexpr std::size_t line_width = 100;

std::string block_of(const Finding& finding, bool bold) {
  constexpr std::size_t indent = 6 + id_width;
  constexpr TextBox box{.column = indent, .indent = indent, .width = line_width};
  const bool matters = finding.severity != Severity::fine;
  const std::string severity = fmt::format("{:<6}", doctor::to_string(finding.severity));
  std::string block = bold && matters ? "\033[1m" + severity + "\033[0m" : severity;
  block += fmt::format("{:<{}}{}\n", finding.id, id_width, wrapped(finding.sentence, box));
  if (!finding.remedy.empty()) {
    block += std::string(indent, ' ') + wrapped(finding.remedy, box) + '\n';
  }
  return block + (matters ? "\n" : "");
}

std::size_t count(const DoctorReport& report, Severity severity) {
  return static_cast<std::size_t>(
      std::ranges::count(report.diagnosis.findings, severity, &Finding::severity));
}

std::string conclusion_of(const DoctorReport& report) {
  const std::size_t fixes = count(report, Severity::fix);
  const std::size_t notes = count(report, Severity::note);
  std::string text = fixes == 0   ? std::string("Nothing to fix")
                     : fixes == 1 ? std::string("One thing to fix")
                                  : fmt::format("{} things to fix", fixes);
  if (notes > 0) text += notes == 1 ? ", one to note" : fmt::format(", {} to note", notes);
  return text + (report.diagnosis.advice ? ". Recommended settings:\n"
                                         : ". No settings can fix these scans.\n");
}

/// The named files, and at most `most` scans per directory, evenly spaced.
std::vector<std::string> chosen_scans(const std::vector<std::string>& paths, std::size_t most,
                                      const RunCallbacks& callbacks) {
  std::vector<std::string> chosen;
  for (const std::string& path : paths) {
    const std::vector<ScanInput> found = find_scans({path}, callbacks);
    const std::size_t count = std::min(most, found.size());
    for (std::size_t i = 0; i < count; ++i) {
      chosen.push_back(found[i * found.size() / count].file.string());
    }
  }
  return chosen;
}

doctor::Expected expected_of(const MethodConfig& config) {
  doctor::Expected expected;
  expected.sensor_height = sensor_height_of(config, expected.sensor_height);
  if (const auto* surface = config.get_if<SurfaceConfig>()) {
    expected.max_range = surface->max_range;
  }
  return expected;
}

}  // namespace

bool DoctorReport::ok() const {
  return failures.empty() && !files.empty() && !interrupted && !diagnosis.has_something_to_fix();
}

ScanExaminer::ScanExaminer(std::string method, const MethodConfig& config)
    : expected_(expected_of(config)) {
  report_.method = std::move(method);
}

void ScanExaminer::examine(const std::string& name, const io::Cloud& cloud) {
  examinations_.push_back(doctor::examine(cloud));
  report_.files.push_back(name);
}

void ScanExaminer::fail(const std::string& name, const std::string& error) {
  report_.failures.push_back({name, error});
}

DoctorReport ScanExaminer::report() const {
  DoctorReport report = report_;
  if (!examinations_.empty()) {
    report.diagnosis = doctor::diagnose(doctor::summarise(examinations_), expected_);
  }
  return report;
}

DoctorReport examine_files(const DoctorRequest& request, const RunCallbacks& callbacks) {
  const std::vector<std::string> scans = chosen_scans(request.scans, request.max_scans, callbacks);
  OutputPlan plan = request.plan;
  for (const std::string& scan : scans) plan.reads(scan);
  plan.writes(request.output);
  plan.check();

  ScanExaminer examiner(request.method, request.config);
  const ProgressMeter meter(scans.size());
  for (std::size_t i = 0; i < scans.size() && !callbacks.stopped(); ++i) {
    callbacks.show(meter.at(i));
    io::Cloud cloud;
    const Status status = io::read_cloud(scans[i], {.columns = request.columns}, cloud);
    if (status.ok()) {
      examiner.examine(scans[i], cloud);
    } else {
      callbacks.say(status.message());
      examiner.fail(scans[i], status.message());
    }
  }
  if (callbacks.stopped()) return {.method = request.method, .interrupted = true};

  DoctorReport report = examiner.report();
  if (!report.files.empty() && !request.output.empty()) {
    const Status status = io::write_file(request.output, toml_of(report));
    if (!status.ok()) throw std::runtime_error(status.message());
  }
  return report;
}

std::string text_of(const DoctorReport& report, bool bold) {
  std::string text;
  for (const std::string& file : report.files) text += io::printable(file) + '\n';
  text += '\n';
  std::string plain;
  for (const Severity severity : most_severe_first) {
    for (const Finding& finding : report.diagnosis.findings) {
      if (finding.severity != severity) continue;
      if (finding.is_plain) {
        plain += (plain.empty() ? "fine  also: " : ", ") + finding.id;
      } else {
        text += block_of(finding, bold);
      }
    }
  }
  if (!plain.empty()) text += wrapped(plain, {.indent = 6, .width = line_width}) + '\n';
  return text + '\n' + conclusion_of(report);
}

std::string json_of(const DoctorReport& report) {
  nlohmann::ordered_json json;
  json["scans"] = report.files;
  if (!report.failures.empty()) {
    json["errors"] = nlohmann::ordered_json::array();
    for (const auto& [file, error] : report.failures) {
      json["errors"].push_back({{"file", file}, {"error", error}});
    }
  }
  json["method"] = report.method;
  json["fix"] = count(report, Severity::fix);
  json["note"] = count(report, Severity::note);
  json["findings"] = nlohmann::ordered_json::array();
  for (const Finding& finding : report.diagnosis.findings) {
    nlohmann::ordered_json entry{{"id", finding.id},
                                 {"severity", doctor::to_string(finding.severity)},
                                 {"sentence", finding.sentence},
                                 {"remedy", finding.remedy}};
    entry["values"] = nlohmann::ordered_json::object();
    for (const auto& [name, value] : finding.values) entry["values"][name] = value;
    json["findings"].push_back(std::move(entry));
  }
  if (report.diagnosis.advice) {
    json["toml"] = toml_of(report);
  } else {
    json["toml"] = nullptr;
  }
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

std::string toml_of(const DoctorReport& report) {
  if (!report.diagnosis.advice) {
    return "# 'flagstone doctor' found no settings for these scans\n";
  }
  return doctor::to_toml(*report.diagnosis.advice);
}

}  // namespace flagstone::app
