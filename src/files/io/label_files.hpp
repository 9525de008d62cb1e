// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "flagstone/label.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

/// The numbers that represent labels in a file.
enum class LabelMap {
  flagstone,       ///< the code of the label, 0 to 4
  semantic_kitti,  ///< 40 (road) for ground, 0 (unlabelled) for every other label
};

/// Writes label files and reuses its memory from scan to scan. Not thread-safe: use one instance
/// per thread.
class LabelWriter {
 public:
  explicit LabelWriter(LabelMap map = LabelMap::flagstone) : map_(map) {}

  /// Writes the layout of SemanticKITTI: one little-endian uint32 per point. The file is written
  /// atomically. unwritable, out_of_memory. Never throws.
  Status write_label_file(const std::filesystem::path& path, std::span<const Label> labels);

  /// Writes the same numbers as a NumPy array of uint8, a quarter of the size. Errors as
  /// write_label_file().
  Status write_label_npy(const std::filesystem::path& path, std::span<const Label> labels);

 private:
  LabelMap map_;
  std::vector<std::uint32_t> numbers_;
  std::string npy_;
};

/// Writes one .label file, as LabelWriter::write_label_file().
Status write_label_file(const std::filesystem::path& path, std::span<const Label> labels,
                        LabelMap map);

/// Writes classes of any numbering as a .label file, for example the ground truth of a simulated
/// scan.
Status write_class_file(const std::filesystem::path& path, std::span<const std::uint32_t> classes);

/// Layouts of files with one class per point.
enum class ClassFormat {
  label,     ///< `.label`: uint32, the class in the low 16 bits, an instance in the high 16
  lidarseg,  ///< `.bin`: uint8, nuScenes-lidarseg
  npy,       ///< `.npy`: N or N x 1 integers
};

/// Reads one class per point; the file extension determines the layout (`.label`, `.bin`, `.npy`).
/// `expected_points` is the size of the scan that the file belongs to; any other number of labels
/// is an error that reports both numbers. Messages as read_cloud(). Never throws; changes `classes`
/// only on success. not_found, unreadable, bad_file, invalid_argument (unknown extension),
/// out_of_memory.
Status read_reference(const std::filesystem::path& path, std::size_t expected_points,
                      std::vector<std::uint32_t>& classes);

/// As read_reference(), for bytes in memory; the message has no path.
Status parse_reference(std::span<const std::byte> bytes, ClassFormat format,
                       std::size_t expected_points, std::vector<std::uint32_t>& classes);

/// Reads labels in flagstone's own codes (`.label`, `.npy`), as read_reference(). A code above 4 is
/// an error.
Status read_labels(const std::filesystem::path& path, std::size_t expected_points,
                   std::vector<Label>& labels);

}  // namespace flagstone::io
