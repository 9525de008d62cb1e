// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "app/segment_files.hpp"
#include "cli/commands.hpp"
#include "cli/method_options.hpp"
#include "cli/shared_options.hpp"
#include "cli/terminal.hpp"

namespace flagstone::cli {
namespace {

using app::OutputFormat;

struct SegmentOptions {
  std::vector<std::string> scans;
  std::string output;
  config::MethodChoice method;
  OutputFormat format = OutputFormat::label;
  std::optional<io::LabelMap> label_map;
  int columns = 0;
  std::string reference;
  bool picture = false;
  bool tint_patches = false;
  bool heights = false;
  bool surface = false;
  std::optional<double> surface_resolution;
  unsigned threads = 0;
  bool json = false;
};

app::SegmentRequest request_of(const SegmentOptions& options) {
  const double resolution = options.surface_resolution.value_or(1);
  const bool is_allowed = resolution >= 0.1 && resolution <= 10;  // not NaN, as CLI::Range has it
  if (!is_allowed) {
    throw std::invalid_argument(
        fmt::format("--surface-resolution {}: not within 0.1 to 10 metres a cell", resolution));
  }
  config::ResolvedMethod method = config::resolve_one(options.method);
  app::SegmentRequest request{
      .scans = options.scans,
      .job = {.method = method.name,
              .config = std::move(method.config),
              .mount = method.mount,
              .told = {},
              .read = {.columns = options.columns},
              .output = options.output,
              .format = options.format,
              .label_map = options.label_map.value_or(io::LabelMap::flagstone),
              .picture = options.picture,
              .tint_patches = options.tint_patches,
              .heights = options.heights,
              .surface = options.surface,
              .surface_resolution = options.surface_resolution.value_or(0),
              .reference = options.reference},
      .label_map_given = options.label_map.has_value(),
      .threads = options.threads};
  request.plan.reads_settings(options.method.config_file, options.method.sensor);
  return request;
}

class SegmentCommand final : public Command {
 public:
  using Command::Command;
  SegmentOptions options;

  int run() override {
    app::SegmentRequest request = request_of(options);
    catch_interrupts();
    ProgressBar bar;
    const app::SegmentOutcome outcome =
        app::segment_files(std::move(request), {.run = bar.callbacks(),
                                                .mount =
                                                    [this](const app::FoundMount& found) {
                                                      if (!options.json)
                                                        fmt::print("{}\n", app::to_text(found));
                                                    },
                                                .report =
                                                    [&](const app::ScanReport& report) {
                                                      bar.clear();
                                                      if (report.error) print_error(*report.error);
                                                      if (options.json) {
                                                        fmt::print("{}\n", app::json_line(report));
                                                      } else if (!report.error) {
                                                        fmt::print("{}\n", app::text_line(report));
                                                      }
                                                    }});
    bar.clear();
    if (!options.json && outcome.scans > 1) {
      fmt::print("{}{}", app::summary_text(outcome.reports),
                 app::throughput_text(outcome.reports, outcome.time));
    }
    if (outcome.reports.size() < outcome.scans) {
      print_error(fmt::format("interrupted, {} of {} scans are done; run it again for the rest",
                              outcome.reports.size(), outcome.scans));
    }
    return outcome.ok() ? 0 : 1;
  }
};

}  // namespace

std::unique_ptr<Command> add_segment_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("segment",
                         "Label every point of scans.\n\n"
                         "Example:  flagstone segment scans/ --output labels --image\n");
  auto made = std::make_unique<SegmentCommand>(*command);
  SegmentOptions* const options = &made->options;
  add_scans_option(*command, options->scans);
  command->add_option("-o,--output", options->output, "Folder for what is written; made if missing")
      ->required()
      ->type_name("DIR");
  add_method_options(*command, options->method);
  const std::map<std::string, OutputFormat> formats = {
      {"label", OutputFormat::label}, {"u8", OutputFormat::u8},   {"npy", OutputFormat::npy},
      {"pcd", OutputFormat::pcd},     {"ply", OutputFormat::ply}, {"split", OutputFormat::split}};
  command
      ->add_option(
          "--format", options->format,
          "label: labels alone, uint32 each; u8: labels alone, uint8 each in a NumPy file; npy, "
          "pcd, ply: the cloud with a field 'label'; split: ground and nonground clouds. Default: "
          "label")
      ->transform(CLI::Transformer(formats).description(""))
      ->transform(CLI::IsMember(formats));  // looked at first: names only, no numbers
  const std::map<std::string, io::LabelMap> maps = {
      {"flagstone", io::LabelMap::flagstone}, {"semantic-kitti", io::LabelMap::semantic_kitti}};
  command
      ->add_option("--label-map", options->label_map,
                   "Codes in label files: flagstone (0..4), or semantic-kitti (40 ground, 0 else)")
      ->transform(CLI::Transformer(maps).description(""))
      ->transform(CLI::IsMember(maps));
  add_columns_option(*command, options->columns);
  command
      ->add_option(
          "--reference", options->reference,
          "True labels to compare with: a file, or a folder of STEM.label, STEM_lidarseg.bin "
          "or STEM.label.npy")
      ->type_name("LABELS");
  CLI::Option* const picture =
      command->add_flag("--image", options->picture, "Draw each scan from above, as PNG");
  command
      ->add_flag("--color-patches", options->tint_patches,
                 "In the picture, tint every patch by its verdict; with patchwork, r_gpf, czm+...")
      ->needs(picture);
  command->add_flag("--heights", options->heights,
                    "Write each point's height above the ground: STEM.heights.npy, and with "
                    "--format npy, pcd or ply a field 'height'");
  CLI::Option* const surface =
      command->add_flag("--surface", options->surface,
                        "Write the ground itself: STEM.surface.npy, a grid of heights, .json, "
                        "where it lies, .png, a map");
  command
      ->add_option("--surface-resolution", options->surface_resolution,
                   "Metres a cell of that grid, 0.1 to 10. Default: the surface's finest")
      ->needs(surface)
      ->type_name("M");
  add_threads_option(
      *command, options->threads,
      "Scans worked on at once. Default: all cores; one where the height is tracked");
  command->add_flag("--json", options->json, "Print one JSON object per scan instead of text");
  return made;
}

}  // namespace flagstone::cli
