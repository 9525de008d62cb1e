// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/scan_job.hpp"

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

namespace flagstone::cli {
namespace fs = std::filesystem;

namespace {

fs::path with_suffix(const fs::path& stem, const std::string& suffix) {
  return {stem.string() + suffix};  // replace_extension would cut "scan.v2" short
}

/// The extension that a scan's name has, ".pcd.bin" included.
std::string scan_extension(const fs::path& file) {
  return file.filename().string().substr(without_scan_extension(file.filename()).string().size());
}

bool is_lidarseg(const fs::path& labels) {
  return labels.filename().string().ends_with("_lidarseg.bin");
}

/// The protocols that fit the ids of a label file; pictures show the first.
std::vector<const eval::Protocol*> protocols_for(const fs::path& labels) {
  if (is_lidarseg(labels)) return {&eval::lidarseg_protocol()};
  return {&eval::patchwork_protocol(), &eval::patchwork_plusplus_protocol()};
}

/// Refuses to write over what is being read.
Status check_spares(const fs::path& output, const fs::path& source) {
  std::error_code error;
  if (!fs::equivalent(output, source, error)) return {};  // nor if one of them is not there
  return Status(StatusCode::invalid_argument,
                fmt::format("{}: its output would overwrite it; name another folder with --output",
                            source.string()));
}

std::string subtitle(const ScanReport& report) {
  if (report.scores.empty()) {
    return fmt::format("{:.1f} % ground, {} patches, {:.2f} ms", 100 * report.ground_share(),
                       report.patches, report.segment_ms);
  }
  const auto& [protocol, confusion] = report.scores.front();
  return fmt::format("{} (protocol {})", eval::scores_text(confusion), protocol);
}

}  // namespace

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

  watch.lap();
  status = write(input, report);
  report.write_ms = watch.lap();
  if (!status.ok()) return status;

  return score_and_draw(input, report);
}

std::optional<MountReport> ScanWorker::mount_report() const {
  const GravityAlignedSegmenter& levelled = runner_.levelled();
  if (job_.told) return MountReport{levelled.mount(), *job_.told};
  if (job_.mount.estimates()) return MountReport{levelled.mount(), levelled.decision()};
  return {};
}

Status ScanWorker::write(const ScanInput& input, ScanReport& report) {
  const fs::path stem = job_.output / input.output_stem;
  std::error_code error;
  fs::create_directories(stem.parent_path(), error);
  if (error) {
    return Status(
        StatusCode::unwritable,
        fmt::format("{}: cannot be made: {}", stem.parent_path().string(), error.message()));
  }

  Status status =
      job_.format == OutputFormat::split ? write_split(input, report) : write_labels(input, report);
  if (status.ok() && job_.heights) status = write_heights(input, report);
  if (status.ok() && job_.surface) status = write_surface(input, report);
  return status;
}

Status ScanWorker::write_labels(const ScanInput& input, ScanReport& report) {
  const char* extension = job_.format == OutputFormat::label ? ".label"
                          : job_.format == OutputFormat::u8  ? ".label.npy"
                          : job_.format == OutputFormat::npy ? ".npy"
                          : job_.format == OutputFormat::pcd ? ".pcd"
                                                             : ".ply";
  const fs::path file = with_suffix(job_.output / input.output_stem, extension);
  for (const fs::path& source : {input.file, reference_file(job_.reference, input)}) {
    if (Status status = check_spares(file, source); !status.ok()) return status;
  }
  report.outputs = {file};
  if (job_.format == OutputFormat::label) {
    return label_writer_.write_label_file(file, result_.labels());
  }
  if (job_.format == OutputFormat::u8) {
    return label_writer_.write_label_npy(file, result_.labels());
  }
  io::Cloud labelled;
  Status status = io::with_labels(reader_.cloud(), result_.labels(), labelled);
  if (status.ok() && job_.heights) {
    status = io::with_heights(labelled, result_.heights(), labelled);
  }
  return status.ok() ? io::write_cloud(file, labelled) : status;
}

Status ScanWorker::write_split(const ScanInput& input, ScanReport& report) {
  for (const bool ground : {true, false}) {
    std::vector<std::uint8_t> mask(reader_.cloud().size());
    for (std::size_t i = 0; i < mask.size(); ++i) {
      mask[i] = (result_.labels()[i] == Label::ground) == ground;
    }
    io::Cloud part;
    if (Status status = io::select_where(reader_.cloud(), mask, part); !status.ok()) return status;
    const fs::path file =
        with_suffix(job_.output / input.output_stem,
                    (ground ? ".ground" : ".nonground") + scan_extension(input.file));
    if (Status status = io::write_cloud(file, part); !status.ok()) return status;
    report.outputs.push_back(file);
  }
  return {};
}

Status ScanWorker::write_heights(const ScanInput& input, ScanReport& report) {
  const fs::path file = with_suffix(job_.output / input.output_stem, ".heights.npy");
  if (Status status = check_spares(file, input.file); !status.ok()) return status;
  const std::span<const float> heights = result_.heights();
  Status status = io::write_npy_file(file, heights, std::array{heights.size()});
  if (status.ok()) report.outputs.push_back(file);
  return status;
}

SurfaceFiles ScanWorker::surface_files(const ScanInput& input) const {
  return {.stem = job_.output / input.output_stem,
          .scan = input.file.filename().string(),
          .resolution = job_.surface_resolution};
}

Status ScanWorker::write_surface(const ScanInput& input, ScanReport& report) {
  if (result_.surface().empty()) {
    return Status(StatusCode::invalid_argument,
                  fmt::format("{}: no surface can be made of it, {} points", input.file.string(),
                              report.points));
  }
  const SurfaceFiles files = surface_files(input);
  if (Status status = check_spares(files.grid(), input.file); !status.ok()) return status;
  Status status = files.write(result_.surface());
  if (status.ok()) report.outputs.insert(report.outputs.end(), {files.grid(), files.frame()});
  return status;
}

Status ScanWorker::draw_surface(const ScanInput& input, ScanReport& report) {
  const fs::path picture = surface_files(input).picture();
  const render::SurfacePicture options{.title = input.file.filename().string(),
                                       .subtitle = "ground as a surface; " + subtitle(report)};
  Status status = render::draw_surface(picture, result_.surface(), options);
  if (status.ok()) report.outputs.push_back(picture);
  return status;
}

Status ScanWorker::score_and_draw(const ScanInput& input, ScanReport& report) {
  std::vector<Truth> truth;  // under the first protocol
  if (!job_.reference.empty()) {
    const fs::path labels = reference_file(job_.reference, input);
    std::vector<std::uint32_t> classes;
    Status status = io::read_reference(labels, reader_.cloud().size(), classes);
    if (!status.ok()) return status;
    for (const eval::Protocol* protocol : protocols_for(labels)) {
      std::vector<Truth> under = eval::truth_of(*protocol, reader_.cloud().view(), classes);
      report.scores.push_back({protocol->name, eval::compare(result_.labels(), under)});
      if (truth.empty()) truth = std::move(under);
    }
  }
  Stopwatch watch;
  Status status;
  if (job_.picture) status = draw_birds_eye(input, report, truth);
  if (status.ok() && job_.surface && render::rendering_available().ok())
    status = draw_surface(input, report);
  if (job_.picture || job_.surface) report.picture_ms = watch.lap();
  return status;
}

Status ScanWorker::draw_birds_eye(const ScanInput& input, ScanReport& report,
                                  std::span<const Truth> truth) {
  render::BirdsEye options;
  options.title = input.file.filename().string();
  options.subtitle = subtitle(report);
  options.zones = job_.config.get_if<PatchworkConfig>();
  options.tint_patches = job_.tint_patches;
  options.reference = truth;
  const fs::path picture = with_suffix(job_.output / input.output_stem, ".png");
  Status status = render::draw_birds_eye(picture, reader_.cloud().view(), result_, options);
  if (status.ok()) report.outputs.push_back(picture);
  return status;
}

}  // namespace flagstone::cli
