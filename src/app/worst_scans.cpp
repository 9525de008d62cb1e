// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/worst_scans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "files/io/atomic_file.hpp"
#include "files/io/message.hpp"
#include "files/render/side_by_side.hpp"
#include "lab/eval/scan_evaluator.hpp"

namespace flagstone::app {
namespace fs = std::filesystem;

namespace {

void throw_if_failed(const Status& status) {
  if (!status.ok()) throw std::runtime_error(status.message());
}

/// Indices of scans in ascending order of their mean F1 over the methods.
std::vector<std::size_t> worst_first(const Evaluation& evaluation, const eval::Results& results) {
  std::map<std::string, std::vector<double>> values;
  for (const eval::MethodResult& method : results.methods) {
    for (const eval::ScanScore& scan : method.scans) {
      if (scan.score.points.has_ground()) values[scan.scan].push_back(scan.score.points.f1());
    }
  }
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < evaluation.scans().size(); ++i) {
    if (values.contains(evaluation.scans()[i].name)) order.push_back(i);
  }
  std::ranges::sort(order, {}, [&](std::size_t i) {
    return std::pair(eval::spread_of(values[evaluation.scans()[i].name]).mean, i);
  });
  return order;
}

std::vector<std::byte> draw(eval::ScanEvaluator& evaluator, const Evaluation& evaluation,
                            const eval::LabelledScan& scan) {
  std::vector<std::vector<Label>> labels;
  throw_if_failed(evaluator.label_all(scan, labels));
  std::vector<render::Panel> panels;
  for (std::size_t m = 0; m < labels.size(); ++m) {
    if (labels[m].size() != evaluator.cloud().size()) continue;  // reported during evaluation
    panels.push_back({evaluation.methods()[m].title,
                      eval::scores_text(evaluator.truth().score(labels[m]).points), labels[m]});
  }
  std::vector<std::byte> png;
  throw_if_failed(render::render_side_by_side(
      evaluator.cloud(), evaluator.truth().truth(), panels,
      {.title = scan.name, .subtitle = fmt::format("protocol {}", evaluation.protocol().name)},
      png));
  return png;
}

}  // namespace

std::vector<report::ReportPicture> draw_worst_scans(
    const Evaluation& evaluation, const eval::Results& results, std::size_t count,
    const fs::path& folder, const RunCallbacks& callbacks,
    const std::function<void(const fs::path&)>& drawn) {
  std::vector<report::ReportPicture> pictures;
  if (count == 0) return pictures;
  eval::ScanEvaluator evaluator(evaluation.methods(), evaluation.protocol(),
                                evaluation.read_options());
  std::vector<std::size_t> order = worst_first(evaluation, results);
  order.resize(std::min(count, order.size()));
  for (const std::size_t i : order) {
    if (callbacks.stopped()) break;
    const eval::LabelledScan& scan = evaluation.scans()[i];
    std::vector<std::byte> png = draw(evaluator, evaluation, scan);
    const fs::path file = folder / (scan.name + ".png");
    make_folder(file.parent_path());
    throw_if_failed(io::write_file(file, std::span<const std::byte>(png)));
    drawn(file);
    pictures.push_back({scan.name, std::move(png)});
  }
  return pictures;
}

}  // namespace flagstone::app
