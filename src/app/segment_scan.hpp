// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/scan_files.hpp"
#include "app/scan_report.hpp"
#include "app/surface_files.hpp"
#include "files/io/label_files.hpp"
#include "files/io/read_cloud.hpp"
#include "lab/eval/method_runner.hpp"
#include "library/core/truth.hpp"

namespace flagstone::app {

/// What is written for a scan.
enum class OutputFormat {
  label,  ///< STEM.label, one uint32 per point
  u8,     ///< STEM.label.npy, one uint8 per point
  npy,    ///< STEM.npy, the cloud with a field `label`, with heights also `height`
  pcd,    ///< STEM.pcd, likewise
  ply,    ///< STEM.ply, likewise
  split,  ///< STEM.ground.EXT and STEM.nonground.EXT in the format of the input
};

/// What to do with every scan.
struct ScanJob {
  std::string method;
  MethodConfig config;
  MountSettings mount;
  std::optional<MountDecision> told;  ///< how the mount was found out before, if it was
  io::ReadOptions read;
  std::filesystem::path output;
  OutputFormat format = OutputFormat::label;
  io::LabelMap label_map = io::LabelMap::flagstone;
  bool picture = false;
  bool tint_patches = false;
  bool heights = false;             ///< STEM.heights.npy, and a field `height` in labelled clouds
  bool surface = false;             ///< STEM.surface.npy, .json and .png
  double surface_resolution = 0;    ///< metres a cell of STEM.surface.npy; 0: the surface's finest
  std::filesystem::path reference;  ///< a label file, or a folder of them; empty for none
};

/// The files that a job writes for a scan; empty for those it does not.
struct ScanOutputs {
  std::filesystem::path labels;  ///< or the labelled cloud
  std::filesystem::path ground, nonground;
  std::filesystem::path heights;
  std::filesystem::path surface_grid, surface_frame, surface_picture;
  std::filesystem::path picture;

  ScanOutputs(const ScanJob& job, const ScanInput& input);

  [[nodiscard]] std::array<std::filesystem::path, 8> all() const {
    return {labels,       ground,        nonground,       heights,
            surface_grid, surface_frame, surface_picture, picture};
  }
};

/// Reads, segments and writes one scan after another, reusing its memory. One per thread.
class ScanWorker {
 public:
  explicit ScanWorker(const ScanJob& job)
      : job_(job),
        reader_(job.read),
        runner_(job.config, job.mount),
        label_writer_(job.label_map) {}

  /// Never throws: what goes wrong with this scan is in the report. The file of `later`, a scan
  /// whose turn comes soon, is fetched meanwhile; null for none.
  ScanReport run(const ScanInput& input, const ScanInput* later = nullptr) noexcept;

 private:
  [[nodiscard]] std::optional<MountReport> mount_report() const;
  Status work(const ScanInput& input, const ScanInput* later, ScanReport& report);
  Status write(const ScanInput& input, const ScanOutputs& outputs, ScanReport& report);
  Status write_cloud(const ScanOutputs& outputs);
  Status write_split(const ScanOutputs& outputs, ScanReport& report);
  Status write_heights(const ScanOutputs& outputs, ScanReport& report);
  Status write_surface(const ScanInput& input, ScanReport& report);
  Status score(const ScanInput& input, ScanReport& report, std::vector<Truth>& truth);
  Status draw(const ScanInput& input, const ScanOutputs& outputs, std::span<const Truth> truth,
              ScanReport& report);

  const ScanJob& job_;
  io::CloudReader reader_;
  eval::MethodRunner runner_;
  Segmentation result_;
  io::LabelWriter label_writer_;
};

/// The label file of a scan: `reference` itself, or in that folder the scan's stem with .label,
/// _lidarseg.bin or .label.npy. Where there is none, the first name that was tried.
std::filesystem::path reference_file(const std::filesystem::path& reference,
                                     const ScanInput& input);

}  // namespace flagstone::app
