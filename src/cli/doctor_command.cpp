// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/doctor_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "app/doctor/examination.hpp"
#include "app/doctor/summary.hpp"
#include "cli/doctor_report.hpp"
#include "cli/interrupt.hpp"
#include "cli/method_options.hpp"
#include "cli/print_error.hpp"
#include "cli/progress.hpp"
#include "cli/scan_inputs.hpp"
#include "files/io/atomic_file.hpp"
#include "files/io/read_cloud.hpp"
#include "library/methods/method.hpp"

namespace flagstone::cli {
namespace {

struct DoctorOptions {
  std::vector<std::string> scans;
  std::size_t max_scans = 5;
  std::string output;
  config::MethodChoice method;
  int columns = 0;
  bool json = false;
  bool toml = false;
};

/// Files as named; of a folder at most `most`, spread over it evenly.
std::vector<std::string> chosen_scans(const std::vector<std::string>& paths, std::size_t most) {
  std::vector<std::string> chosen;
  for (const std::string& path : paths) {
    const std::vector<ScanInput> found = find_scans({path});
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

int examine_scans(const DoctorOptions& options) {
  const config::ResolvedMethod method = config::resolve_one(options.method);
  DoctorReport report{.files = {}, .method = method.name, .diagnosis = {}};
  const doctor::Expected expected = expected_of(method.config);
  const std::vector<std::string> scans = chosen_scans(options.scans, options.max_scans);

  catch_interrupts();
  Progress progress(scans.size());
  std::vector<doctor::Examination> examinations;
  bool failed = false;
  for (std::size_t i = 0; i < scans.size() && !interrupted(); ++i) {
    progress.show(i);
    io::Cloud cloud;
    const Status status = io::read_cloud(scans[i], {.columns = options.columns}, cloud);
    if (status.ok()) {
      examinations.push_back(doctor::examine(cloud));
      report.files.push_back(scans[i]);
    } else {
      progress.clear();
      print_error(status.message());
      failed = true;
    }
  }
  progress.clear();
  if (interrupted()) print_error("interrupted; run it again, with a smaller --max-scans perhaps");
  if (examinations.empty() || interrupted()) return 1;

  report.diagnosis = doctor::diagnose(doctor::summarise(examinations), expected);
  const std::string toml = toml_of(report);
  if (!options.output.empty()) {
    const Status status = io::write_file(options.output, toml);
    if (!status.ok()) throw std::runtime_error(status.message());
  }
  if (options.json) {
    fmt::print("{}", json_of(report));
  } else if (!options.toml) {
    fmt::print("{}", text_of(report, isatty(STDOUT_FILENO) != 0));
    if (options.output.empty()) fmt::print("\n");
  }
  if (!options.json && options.output.empty()) fmt::print("{}", toml);
  return failed || report.diagnosis.has_something_to_fix() ? 1 : 0;
}

}  // namespace

void add_doctor_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<DoctorOptions>();
  CLI::App* command = app.add_subcommand(
      "doctor",
      "Look at a few scans and say what to set.\n\n"
      "Example:  flagstone doctor scans/ --output doctor.toml\n"
      "          flagstone segment scans/ --output labels --config doctor.toml\n\n"
      "Exit code: 0 all is fine, 1 something is to fix or a scan cannot be read, 2 wrong usage.");
  command
      ->add_option("scans", options->scans,
                   "Scans, or folders of them (.bin, .pcd.bin, .pcd, .ply, .npy)")
      ->required()
      ->type_name("SCAN...");
  command->add_option("--max-scans", options->max_scans, "Of each folder, look at so many scans")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str()
      ->type_name("N");
  command
      ->add_option("-o,--output", options->output,
                   "Write the settings that fit to this file, for --config")
      ->type_name("FILE");
  add_method_options(*command, options->method);
  command
      ->add_option("--columns", options->columns,
                   "Floats a point in .bin files. Default: 5 for .pcd.bin, else 4")
      ->check(CLI::Range(3, 1024))
      ->type_name("N");
  CLI::Option* const json =
      command->add_flag("--json", options->json, "Print one JSON object instead of text");
  command->add_flag("--toml", options->toml, "Print the settings that fit and nothing else")
      ->excludes(json);
  command->callback([options, &exit_code] { exit_code = examine_scans(*options); });
}

}  // namespace flagstone::cli
