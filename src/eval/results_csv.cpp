// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "eval/results_csv.hpp"

#include <fmt/format.h>

#include <cstddef>

namespace flagstone::eval {
namespace {

std::string heading() {
  std::string text = "method,scan,precision,recall,f1,accuracy,iou,tp,fp,fn,tn";
  float from = 0;
  for (const float to : range_bands) {
    text += fmt::format(",f1_{}_{}m", from, to);
    from = to;
  }
  return text + ",f1_by_area,milliseconds\r\n";
}

std::string row(const MethodResult& result, const ScanScore& scan) {
  const Confusion& all = scan.score.points;
  std::string text = fmt::format(
      "{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{},{},{},{}", csv_cell(result.name),
      csv_cell(scan.scan), all.precision(), all.recall(), all.f1(), all.accuracy(), all.iou(),
      all.true_positives, all.false_positives, all.false_negatives, all.true_negatives);
  for (const Confusion& band : scan.score.by_range) text += fmt::format(",{:.6f}", band.f1());
  text += fmt::format(",{:.6f},", scan.score.by_area.f1());
  if (scan.segment_ms) text += fmt::format("{:.4f}", *scan.segment_ms);
  return text + "\r\n";
}

}  // namespace

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string to_csv(const Results& results) {
  std::string text = heading();
  for (const MethodResult& result : results.methods) {
    for (const ScanScore& scan : result.scans) text += row(result, scan);
  }
  return text;
}

}  // namespace flagstone::eval
