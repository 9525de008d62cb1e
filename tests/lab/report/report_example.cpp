// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// report_example DIR writes example reports to the directory: eval.html and sweep.html, and edge
// cases: one.html (one scan, one method), many.html (a thousand scans), single.html (a sweep of one
// key) and heat.html (a sweep of numbers).
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

nlohmann::ordered_json eval_with_all_sections() {
  nlohmann::ordered_json results = example_eval(9, 10);
  results["failed"].push_back({{"scan", "00/000011"}, {"error", "velodyne/000011.bin: 17 bytes"}});
  results["methods"][1]["hz"] = nullptr;
  results["methods"][1]["hz_slowest_1_percent"] = nullptr;
  return results;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "usage: report_example DIR\n";
    return 2;
  }
  const std::filesystem::path directory = arguments[1];
  const std::array<ReportPicture, 1> pictures = {{{.title = "00/000000", .png = one_pixel_png()}}};
  const bool written =
      write(directory / "eval.html", eval_report(eval_with_all_sections(), pictures)) &&
      write(directory / "one.html", eval_report(example_eval(1, 1), {})) &&
      write(directory / "many.html", eval_report(example_eval(9, 1000), {})) &&
      write(directory / "sweep.html", sweep_report(example_sweep(5, 3))) &&
      write(directory / "single.html", sweep_report(example_sweep(5, 0))) &&
      write(directory / "heat.html", sweep_report(example_sweep(6, 8, true)));
  return written ? 0 : 1;
}
