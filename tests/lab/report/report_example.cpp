// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// report_example FOLDER writes example reports into the folder: eval.html and sweep.html, and the
// ends of what there can be: one.html (one scan, one method), many.html (a thousand scans),
// single.html (a sweep of one key) and heat.html (a sweep of numbers).
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

#include "lab/report/eval_report.hpp"
#include "lab/report/example_results.hpp"
#include "lab/report/sweep_report.hpp"

namespace {

using namespace flagstone::report;

bool write(const std::filesystem::path& file, const std::string& page) {
  std::ofstream stream(file, std::ios::binary);
  stream << page << std::flush;
  return stream.good();
}

nlohmann::ordered_json eval_with_all_there_can_be() {
  nlohmann::ordered_json results = example_eval(9, 10);
  results["failed"].push_back({{"scan", "00/000011"}, {"error", "velodyne/000011.bin: 17 bytes"}});
  results["methods"][1]["hz"] = nullptr;
  results["methods"][1]["hz_slowest_1_percent"] = nullptr;
  return results;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "usage: report_example FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = arguments[1];
  const std::array<ReportPicture, 1> pictures = {{{.title = "00/000000", .png = one_pixel_png()}}};
  const bool written =
      write(folder / "eval.html", eval_report(eval_with_all_there_can_be(), pictures)) &&
      write(folder / "one.html", eval_report(example_eval(1, 1), {})) &&
      write(folder / "many.html", eval_report(example_eval(9, 1000), {})) &&
      write(folder / "sweep.html", sweep_report(example_sweep(5, 3))) &&
      write(folder / "single.html", sweep_report(example_sweep(5, 0))) &&
      write(folder / "heat.html", sweep_report(example_sweep(6, 8, true)));
  return written ? 0 : 1;
}
