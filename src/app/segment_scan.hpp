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

/// The output for a scan.
enum class OutputFormat {
  label,  ///< STEM.label, one uint32 per point
  u8,     ///< STEM.label.npy, one uint8 per point
  npy,    ///< STEM.npy, the cloud with a field `label`, and `height` with heights
  pcd,    ///< STEM.pcd, with the same fields
  ply,    ///< STEM.ply, with the same fields
  split,  ///< STEM.ground.EXT and STEM.nonground.EXT in the format of the input
};

/// The work to do for every scan.
struct ScanJob {
  std::string method;
  MethodConfig config;
  MountSettings mount;
  std::optional<MountDecision> told;  ///< of find_mount(), if it was called
  io::ReadOptions read;
  std::filesystem::path output;
  OutputFormat format = OutputFormat::label;
  io::LabelMap label_map = io::LabelMap::flagstone;
  bool picture = false;
  bool tint_patches = false;
  bool heights = false;  ///< STEM.heights.npy, and a field `height` in labelled clouds
  bool surface = false;  ///< STEM.surface.npy, .json and .png
  double surface_resolution =
      0;  ///< cell size of STEM.surface.npy, metres; 0: the finest of the surface
  std::filesystem::path reference;  ///< a label file or a directory; empty for none
};

/// The files that a job writes for a scan. Empty paths are not written.
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

/// Reads, segments and writes one scan after another and reuses its buffers. Not thread-safe: use
/// one instance per thread.
class ScanWorker {
 public:
  explicit ScanWorker(const ScanJob& job)
      : job_(job),
        reader_(job.read),
        runner_(job.config, job.mount),
        label_writer_(job.label_map) {}

  /// Never throws: errors of this scan are in the report. `later`: a scan that comes soon, whose
  /// file is read ahead; null for none.
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

/// The label file of a scan: `reference` itself, or the file in that directory with the scan's stem
/// and .label, _lidarseg.bin or .label.npy. If there is none, the first name that was tried.
std::filesystem::path reference_file(const std::filesystem::path& reference,
                                     const ScanInput& input);

}  // namespace flagstone::app
