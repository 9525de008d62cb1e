// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "files/io/cloud.hpp"

namespace flagstone::cli {

/// SemanticKITTI classes for a random scan, by height: road below -1.6 m, vegetation up to -1 m,
/// building above. Every 50th point is unlabelled, so that the protocols give different ground
/// truths.
std::vector<std::uint32_t> made_up_classes(const io::Cloud& scan);

/// Writes velodyne/NAME.bin and labels/NAME.label to a directory.
void put_labelled(const std::filesystem::path& folder, const std::string& name,
                  const io::Cloud& scan);

/// Writes NAME.pcd.bin, with five floats per point, and NAME_lidarseg.bin: 24 (driveable surface)
/// for road in made_up_classes(), otherwise 30 (vegetation).
void put_lidarseg(const std::filesystem::path& folder, const std::string& name,
                  const io::Cloud& scan);

/// Reads the results file of a command.
nlohmann::json json_of(const std::filesystem::path& file);

/// Results of `flagstone eval` without the values that differ between runs: times, rates, threads.
nlohmann::json without_times(nlohmann::json results);

}  // namespace flagstone::cli
