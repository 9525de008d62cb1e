// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/segment_command.hpp"

#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cli/interrupt.hpp"
#include "cli/method_options.hpp"
#include "cli/mount_estimation.hpp"
#include "cli/print_error.hpp"
#include "cli/progress.hpp"
#include "cli/scan_job.hpp"
#include "cli/thread_pool.hpp"
#include "cli/throughput.hpp"
#include "files/render/rendering_available.hpp"
#include "flagstone/surface_config.hpp"
#include "library/core/stopwatch.hpp"

namespace flagstone::cli {
namespace {

struct SegmentOptions {
  std::vector<std::string> scans;
  std::string output;
  config::MethodChoice method;
  OutputFormat format = OutputFormat::label;
  io::LabelMap label_map = io::LabelMap::flagstone;
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

/// Collects what workers report and prints it in the order of the scans: at once where a scan takes
/// long, ten times a second where thousands are done in it, since waking who reads the lines takes
/// longer than making one.
class Reporter {
 public:
  Reporter(std::size_t scans, bool json) : reports_(scans), progress_(scans), json_(json) {
    progress_.show(0);
  }

  void add(std::size_t index, ScanReport report) {
    std::string line = line_of(report);  // before the lock, for which other workers wait
    const std::scoped_lock lock(mutex_);
    reports_[index] = {std::move(report), std::move(line)};
    ++done_;
    const auto now = std::chrono::steady_clock::now();
    if (now < next_print_) return;
    next_print_ = now + pause;
    print_ready();
  }

  /// Takes the progress bar away, prints what is left to print; returns what was reported.
  std::vector<ScanReport> finish() {
    progress_.clear();
    std::vector<ScanReport> finished;
    for (std::size_t i = 0; i < reports_.size(); ++i) {
      std::optional<Entry>& entry = reports_[i];
      if (!entry) continue;
      if (i >= next_) print(*entry);
      finished.push_back(std::move(entry->report));
    }
    return finished;
  }

 private:
  struct Entry {
    ScanReport report;
    std::string line;  // empty where there is nothing to print, or not any more
  };

  static constexpr std::chrono::milliseconds pause{100};

  void print_ready() {
    if (next_ < reports_.size() && reports_[next_]) progress_.clear();
    for (; next_ < reports_.size(); ++next_) {
      std::optional<Entry>& next = reports_[next_];
      if (!next) break;
      print(*next);
    }
    std::fflush(stdout);
    progress_.show(done_);
  }

  std::string line_of(const ScanReport& report) const {
    if (json_) return json_line(report) + '\n';
    return report.error ? std::string() : text_line(report) + '\n';
  }

  static void print(Entry& entry) {
    if (entry.report.error) print_error(*entry.report.error);
    fmt::print("{}", std::exchange(entry.line, {}));
  }

  std::mutex mutex_;
  std::vector<std::optional<Entry>> reports_;
  std::size_t next_ = 0;  // first one not printed
  std::size_t done_ = 0;
  std::chrono::steady_clock::time_point next_print_;
  Progress progress_;
  bool json_;
};

void check_tint(const SegmentOptions& options, const MethodConfig& config) {
  if (!options.tint_patches || config.get_if<PatchworkConfig>() != nullptr) return;
  throw std::invalid_argument(
      fmt::format("--color-patches: method {} has no zones to tint; --method patchwork has, r_gpf "
                  "and czm+... too",
                  options.method.methods.front()));
}

void check_surface(const SegmentOptions& options, const MethodConfig& config) {
  const double resolution = options.surface_resolution.value_or(1);
  const bool is_allowed = resolution >= 0.1 && resolution <= 10;  // not NaN, as CLI::Range has it
  if (!is_allowed) {
    throw std::invalid_argument(
        fmt::format("--surface-resolution {}: not within 0.1 to 10 metres a cell", resolution));
  }
  if (config.get_if<SurfaceConfig>() != nullptr) return;
  for (const auto& [asked, option] :
       {std::pair{options.heights, "--heights"}, std::pair{options.surface, "--surface"}}) {
    if (!asked) continue;
    throw std::invalid_argument(fmt::format("{}: method {} makes no surface; --method surface does",
                                            option, options.method.methods.front()));
  }
}

/// Of the surface only the map is a picture: its grid is written all the same.
void check_pictures(const SegmentOptions& options) {
  const Status rendering_available = render::rendering_available();
  if (rendering_available.ok()) return;
  if (options.picture) throw std::invalid_argument("--image: " + rendering_available.message());
  if (options.surface)
    print_error("--surface: grids without maps: " + rendering_available.message());
}

int segment(const SegmentOptions& options) {
  const auto [name, config, mount] = config::resolve_one(options.method);
  config::check_threads(mount, options.threads);
  ScanJob job{.method = name,
              .config = config,
              .mount = mount,
              .told = {},
              .read = {.columns = options.columns},
              .output = options.output,
              .format = options.format,
              .label_map = options.label_map,
              .picture = options.picture,
              .tint_patches = options.tint_patches,
              .heights = options.heights,
              .surface = options.surface,
              .surface_resolution = options.surface_resolution.value_or(0),
              .reference = options.reference};
  check_tint(options, job.config);
  check_surface(options, job.config);
  check_pictures(options);
  const std::vector<ScanInput> scans = list_scans(options.scans);

  catch_interrupts();
  const unsigned threads = mount.tracks() ? 1 : options.threads;
  if (mount.estimates() && !mount.tracks()) {
    const FoundMount found = find_mount(scans, mount, job.read);
    job.mount = found.settings;
    job.told = found.decision;
    if (!options.json) fmt::print("{}\n", to_text(found));
  }
  Reporter reporter(scans.size(), options.json);
  const std::size_t ahead = thread_count(threads);  // a scan for each worker
  Stopwatch watch;
  const std::size_t workers = run_crew(scans.size(), threads, [&] {
    return [&, worker = std::make_shared<ScanWorker>(job)](std::size_t index) {
      const std::size_t later = index + ahead;
      reporter.add(index,
                   worker->run(scans[index], later < scans.size() ? &scans[later] : nullptr));
    };
  });
  const CrewTime time{.seconds = watch.lap() / 1000, .workers = workers};
  const std::vector<ScanReport> reports = reporter.finish();

  if (!options.json && scans.size() > 1) {
    fmt::print("{}{}", summary_text(reports), throughput_text(reports, time));
  }
  const bool failed =
      std::ranges::any_of(reports, [](const auto& r) { return r.error.has_value(); });
  if (reports.size() < scans.size()) {
    print_error(fmt::format("interrupted, {} of {} scans are done; run it again for the rest",
                            reports.size(), scans.size()));
  }
  return failed || reports.size() < scans.size() ? 1 : 0;
}

}  // namespace

void add_segment_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<SegmentOptions>();
  CLI::App* command =
      app.add_subcommand("segment",
                         "Label every point of scans.\n\n"
                         "Example:  flagstone segment scans/ --output labels --image\n");
  command
      ->add_option("scans", options->scans,
                   "Scans, or folders of them (.bin, .pcd.bin, .pcd, .ply, .npy)")
      ->required()
      ->type_name("SCAN...");
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
  command
      ->add_option("--columns", options->columns,
                   "Floats a point in .bin files. Default: 5 for .pcd.bin, else 4")
      ->check(CLI::Range(3, 1024))
      ->type_name("N");
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
  command
      ->add_option("--threads", options->threads,
                   "Scans worked on at once. Default: all cores; one where the height is tracked")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  command->add_flag("--json", options->json, "Print one JSON object per scan instead of text");
  command->callback([options, &exit_code] { exit_code = segment(*options); });
}

}  // namespace flagstone::cli
