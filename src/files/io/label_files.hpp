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

/// What number a `.label` file holds for a label.
enum class LabelMap {
  flagstone,       ///< the label's own code, 0 to 4
  semantic_kitti,  ///< 40 (road) for ground, 0 (unlabelled) for all else
};

/// Writes the labels of one scan after another, with memory it keeps. One per thread.
class LabelWriter {
 public:
  explicit LabelWriter(LabelMap map = LabelMap::flagstone) : map_(map) {}

  /// Writes SemanticKITTI's layout: one little-endian uint32 a point. The file is there whole or
  /// not at all. unwritable, out_of_memory. Never throws.
  Status write_label_file(const std::filesystem::path& path, std::span<const Label> labels);

  /// The same numbers as a NumPy array, N x uint8: a quarter of the bytes. Errors likewise.
  Status write_label_npy(const std::filesystem::path& path, std::span<const Label> labels);

 private:
  LabelMap map_;
  std::vector<std::uint32_t> numbers_;
  std::string npy_;
};

/// Writes one .label file; as LabelWriter.
Status write_label_file(const std::filesystem::path& path, std::span<const Label> labels,
                        LabelMap map);

/// The same for classes of any numbering, e.g. the truth of a simulated scan.
Status write_class_file(const std::filesystem::path& path, std::span<const std::uint32_t> classes);

/// How a file of one class a point is laid out.
enum class ClassFormat {
  label,     ///< `.label`: uint32, the class in the low 16 bits, an instance in the high 16
  lidarseg,  ///< `.bin`: uint8, nuScenes-lidarseg
  npy,       ///< `.npy`: N or N x 1 integers
};

/// Reads one class a point; the name says the layout (`.label`, `.bin`, `.npy`).
/// `expected_points` is the size of the scan the file belongs to; any other number of labels is an
/// error that names both. Messages as those of read_cloud(). Never throws; `classes` is only
/// changed on success. not_found, unreadable, bad_file, invalid_argument (unknown ending),
/// out_of_memory.
Status read_reference(const std::filesystem::path& path, std::size_t expected_points,
                      std::vector<std::uint32_t>& classes);

/// The same for bytes in memory; the message has no path.
Status parse_reference(std::span<const std::byte> bytes, ClassFormat format,
                       std::size_t expected_points, std::vector<std::uint32_t>& classes);

/// Reads labels that flagstone wrote with its own codes (`.label`, `.npy`); as read_reference(),
/// and a code above 4 is an error.
Status read_labels(const std::filesystem::path& path, std::size_t expected_points,
                   std::vector<Label>& labels);

}  // namespace flagstone::io
