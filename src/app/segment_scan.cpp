// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/segment_scan.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <exception>
#include <span>
#include <system_error>
#include <vector>

#include "files/io/load_bytes.hpp"
#include "files/io/npy.hpp"
#include "files/io/write_cloud.hpp"
#include "files/render/birds_eye.hpp"
#include "files/render/rendering_available.hpp"
#include "files/render/surface_picture.hpp"
#include "lab/eval/protocol.hpp"
#include "library/core/stopwatch.hpp"

namespace flagstone::app {
namespace fs = std::filesystem;

namespace {

bool is_lidarseg(const fs::path& labels) {
  return labels.filename().string().ends_with("_lidarseg.bin");
}

/// The protocols for the class ids of a label file; images use the first.
std::vector<const eval::Protocol*> protocols_for(const fs::path& labels) {
  if (is_lidarseg(labels)) return {&eval::lidarseg_protocol()};
  return {&eval::patchwork_protocol(), &eval::patchwork_plusplus_protocol()};
}

/// Without times, so that images are the same on every run.
std::string subtitle(const ScanReport& report) {
  if (report.scores.empty()) {
    return fmt::format("{:.1f} % ground, {} patches", 100 * report.ground_share(), report.patches);
  }
  const auto& [protocol, confusion] = report.scores.front();
  return fmt::format("{} (protocol {})", eval::scores_text(confusion), protocol);
}

const char* extension_of(OutputFormat format) {
  switch (format) {
    case OutputFormat::u8: return ".label.npy";
    case OutputFormat::npy: return ".npy";
    case OutputFormat::pcd: return ".pcd";
    case OutputFormat::ply: return ".ply";
    default: return ".label";
  }
}

SurfaceFiles surface_files(const ScanJob& job, const ScanInput& input) {
  return {.stem = job.output / input.output_stem,
          .scan = input.file.filename().string(),
          .resolution = job.surface_resolution};
}

}  // namespace

ScanOutputs::ScanOutputs(const ScanJob& job, const ScanInput& input) {
  const fs::path stem = job.output / input.output_stem;
  if (job.format == OutputFormat::split) {
    const std::string extension = scan_extension(input.file);
    ground = with_suffix(stem, ".ground" + extension);
    nonground = with_suffix(stem, ".nonground" + extension);
  } else {
    labels = with_suffix(stem, extension_of(job.format));
  }
  if (job.heights) heights = with_suffix(stem, ".heights.npy");
  if (job.surface) {
    const SurfaceFiles files = surface_files(job, input);
    surface_grid = files.grid();
    surface_frame = files.frame();
    surface_picture = files.picture();
  }
  if (job.picture) picture = with_suffix(stem, ".png");
}

fs::path reference_file(const fs::path& reference, const ScanInput& input) {
  std::error_code error;
  if (!fs::is_directory(reference, error)) return reference;
  const fs::path name = input.output_stem.filename();
  const std::array candidates = {
      with_suffix(reference / input.output_stem, ".label"),
      with_suffix(reference / name, ".label"),
      with_suffix(reference / name, "_lidarseg.bin"),
      with_suffix(reference / input.output_stem, ".label.npy"),
      with_suffix(reference / name, ".label.npy"),
  };
  for (const fs::path& candidate : candidates) {
    if (fs::exists(candidate, error)) return candidate;
  }
  return candidates.front();
}

ScanReport ScanWorker::run(const ScanInput& input, const ScanInput* later) noexcept {
  ScanReport report;
  report.file = input.file;
  try {
    const Status status = work(input, later, report);
    if (!status.ok()) report.error = status.message();
  } catch (const std::exception& error) {
    report.error = fmt::format("{}: {}", input.file.string(), error.what());
  }
  return report;
}

Status ScanWorker::work(const ScanInput& input, const ScanInput* later, ScanReport& report) {
  Stopwatch watch;
  if (later != nullptr) io::read_ahead(later->file);
  if (Status status = reader_.read(input.file); !status.ok()) return status;
  report.read_ms = watch.lap();
  report.file_size = reader_.file_size();

  const io::Cloud& cloud = reader_.cloud();
  runner_.prepare(cloud);
  watch.lap();
  Status status = runner_.segment(cloud, result_);
  report.segment_ms = watch.lap();
  if (!status.ok()) {
    return Status(status.code(), fmt::format("{}: {}", input.file.string(), status.message()));
  }
  report.mount = mount_report();
  report.mount_is_own = job_.mount.estimates();
  report.points = cloud.size();
  report.patches = result_.patches().size();
  for (std::size_t code = 0; code < label_count; ++code) {
    report.counts[code] = result_.count(static_cast<Label>(code));
  }

  const ScanOutputs outputs(job_, input);
  watch.lap();
  status = write(input, outputs, report);
  report.write_ms = watch.lap();
  std::vector<Truth> truth;  // under the first protocol
  if (status.ok()) status = score(input, report, truth);
  watch.lap();
  if (status.ok()) status = draw(input, outputs, truth, report);
  if (job_.picture || job_.surface) report.picture_ms = watch.lap();
  return status;
}

std::optional<MountReport> ScanWorker::mount_report() const {
  const GravityAlignedSegmenter& levelled = runner_.levelled();
  if (job_.told) return MountReport{levelled.mount(), *job_.told};
  if (job_.mount.estimates()) return MountReport{levelled.mount(), levelled.decision()};
  return {};
}

Status ScanWorker::write(const ScanInput& input, const ScanOutputs& outputs, ScanReport& report) {
  const fs::path folder = (job_.output / input.output_stem).parent_path();
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    return Status(StatusCode::unwritable,
                  fmt::format("{}: cannot be created: {}", folder.string(), error.message()));
  }
  Status status;
  if (job_.format != OutputFormat::split) report.outputs = {outputs.labels};
  switch (job_.format) {
    case OutputFormat::label:
      status = label_writer_.write_label_file(outputs.labels, result_.labels());
      break;
    case OutputFormat::u8:
      status = label_writer_.write_label_npy(outputs.labels, result_.labels());
      break;
    case OutputFormat::npy:
    case OutputFormat::pcd:
    case OutputFormat::ply: status = write_cloud(outputs); break;
    case OutputFormat::split: status = write_split(outputs, report); break;
  }
  if (status.ok() && job_.heights) status = write_heights(outputs, report);
  if (status.ok() && job_.surface) status = write_surface(input, report);
  return status;
}

Status ScanWorker::write_cloud(const ScanOutputs& outputs) {
  io::Cloud labelled;
  Status status = io::with_labels(reader_.cloud(), result_.labels(), labelled);
  if (status.ok() && job_.heights) {
    status = io::with_heights(labelled, result_.heights(), labelled);
  }
  return status.ok() ? io::write_cloud(outputs.labels, labelled) : status;
}

Status ScanWorker::write_split(const ScanOutputs& outputs, ScanReport& report) {
  for (const bool ground : {true, false}) {
    std::vector<std::uint8_t> mask(reader_.cloud().size());
    for (std::size_t i = 0; i < mask.size(); ++i) {
      mask[i] = (result_.labels()[i] == Label::ground) == ground;
    }
    io::Cloud part;
    if (Status status = io::select_where(reader_.cloud(), mask, part); !status.ok()) return status;
    const fs::path& file = ground ? outputs.ground : outputs.nonground;
    if (Status status = io::write_cloud(file, part); !status.ok()) return status;
    report.outputs.push_back(file);
  }
  return {};
}

Status ScanWorker::write_heights(const ScanOutputs& outputs, ScanReport& report) {
  const std::span<const float> heights = result_.heights();
  Status status = io::write_npy_file(outputs.heights, heights, std::array{heights.size()});
  if (status.ok()) report.outputs.push_back(outputs.heights);
  return status;
}

Status ScanWorker::write_surface(const ScanInput& input, ScanReport& report) {
  if (result_.surface().empty()) {
    return Status(StatusCode::invalid_argument,
                  fmt::format("{}: no surface can be estimated from {} points", input.file.string(),
                              report.points));
  }
  const SurfaceFiles files = surface_files(job_, input);
  Status status = files.write(result_.surface());
  if (status.ok()) report.outputs.insert(report.outputs.end(), {files.grid(), files.frame()});
  return status;
}

Status ScanWorker::score(const ScanInput& input, ScanReport& report, std::vector<Truth>& truth) {
  if (job_.reference.empty()) return {};
  const fs::path labels = reference_file(job_.reference, input);
  std::vector<std::uint32_t> classes;
  Status status = io::read_reference(labels, reader_.cloud().size(), classes);
  if (!status.ok()) return status;
  for (const eval::Protocol* protocol : protocols_for(labels)) {
    std::vector<Truth> under = eval::truth_of(*protocol, reader_.cloud().view(), classes);
    report.scores.push_back({protocol->name, eval::compare(result_.labels(), under)});
    if (truth.empty()) truth = std::move(under);
  }
  return {};
}

Status ScanWorker::draw(const ScanInput& input, const ScanOutputs& outputs,
                        std::span<const Truth> truth, ScanReport& report) {
  const std::string title = input.file.filename().string();
  if (job_.picture) {
    render::BirdsEye options;
    options.title = title;
    options.subtitle = subtitle(report);
    options.zones = job_.config.get_if<PatchworkConfig>();
    options.tint_patches = job_.tint_patches;
    options.reference = truth;
    Status status =
        render::draw_birds_eye(outputs.picture, reader_.cloud().view(), result_, options);
    if (!status.ok()) return status;
    report.outputs.push_back(outputs.picture);
  }
  if (job_.surface && render::rendering_available().ok()) {
    Status status =
        render::draw_surface(outputs.surface_picture, result_.surface(),
                             {.title = title, .subtitle = "ground surface; " + subtitle(report)});
    if (!status.ok()) return status;
    report.outputs.push_back(outputs.surface_picture);
  }
  return {};
}

}  // namespace flagstone::app
