// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/segment_files.hpp"
#include "cli/commands.hpp"
#include "cli/help.hpp"
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
      print_error(fmt::format(
          "interrupted: {} of {} scans are segmented (their files are complete; run the command "
          "again for all scans)",
          outcome.reports.size(), outcome.scans));
    }
    return outcome.ok() ? 0 : 1;
  }
};

}  // namespace

std::unique_ptr<Command> add_segment_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("segment", "Label every point of LiDAR scans as ground or non-ground.");
  set_help(
      *command,
      {.examples = {{"flagstone segment scans/ --output labels", "write one .label file per scan"},
                    {"flagstone segment scan.pcd --output out --format pcd",
                     "add a field 'label' to the cloud"},
                    {"flagstone segment scans/ --output labels --sensor-height estimate",
                     "determine the height of the sensor from the scans"}}});
  auto made = std::make_unique<SegmentCommand>(*command);
  SegmentOptions* const options = &made->options;
  add_scans_option(*command, options->scans);
  add_columns_option(*command, options->columns);
  command
      ->add_option("--reference", options->reference,
                   "Ground-truth labels to score against: a file, or a directory with STEM.label, "
                   "STEM_lidarseg.bin or STEM.label.npy")
      ->type_name("PATH")
      ->group(input_group);
  add_method_options(*command, options->method);

  command->option_defaults()->group(output_group);
  command
      ->add_option("-o,--output", options->output, "Output directory, created if it does not exist")
      ->required()
      ->type_name("DIR");
  add_choice_option<OutputFormat>(*command, "--format", "format",
                                  {{"label", OutputFormat::label},
                                   {"u8", OutputFormat::u8},
                                   {"npy", OutputFormat::npy},
                                   {"pcd", OutputFormat::pcd},
                                   {"ply", OutputFormat::ply},
                                   {"split", OutputFormat::split}},
                                  options->format,
                                  "Output format"
                                  "\nlabel\tlabels only, one uint32 per point"
                                  "\nu8\tlabels only, one uint8 per point, as a NumPy array"
                                  "\nnpy, pcd, ply\tthe cloud with an added field 'label'"
                                  "\nsplit\tseparate clouds of ground and non-ground points")
      ->default_str("label")
      ->type_name("FORMAT");
  add_choice_option(*command, "--label-map", "label map", label_maps(), options->label_map,
                    "Codes in label files"
                    "\nflagstone\t0 to 4, one per label"
                    "\nsemantic-kitti\t40 for ground, otherwise 0")
      ->default_str("flagstone");
  command->add_flag("--heights", options->heights,
                    "Write the height of each point above the ground to STEM.heights.npy, and to a "
                    "field 'height' with --format npy, pcd or ply");
  CLI::Option* const surface =
      command->add_flag("--surface", options->surface,
                        "Write the ground surface: heights (STEM.surface.npy), grid geometry "
                        "(.json) and a map (.png)");
  command
      ->add_option("--surface-resolution", options->surface_resolution,
                   "Cell size of the surface grid in metres, 0.1 to 10")
      ->check(in_range(0.1, 10.0))
      ->default_str("the finest cell size of the surface")
      ->needs(surface)
      ->type_name("M");
  CLI::Option* const image =
      command->add_flag("--image", options->picture, "Draw a bird's-eye view of each scan as PNG");
  command
      ->add_flag("--color-patches", options->tint_patches,
                 "Colour each patch in the image by its status, with patchwork, r_gpf or czm+...")
      ->needs(image);
  command->add_flag("--json", options->json, "Print one JSON object per scan instead of text");
  add_threads_option(*command, options->threads, "all cores; 1 with --sensor-height track");
  return made;
}

}  // namespace flagstone::cli
