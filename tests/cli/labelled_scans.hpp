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

/// SemanticKITTI's classes for a made-up scan, by height: road below -1.6 m, vegetation to -1 m,
/// building above; every 50th point is unlabelled. Each protocol finds another truth in them.
std::vector<std::uint32_t> made_up_classes(const io::Cloud& scan);

/// Writes velodyne/NAME.bin and labels/NAME.label into a folder.
void put_labelled(const std::filesystem::path& folder, const std::string& name,
                  const io::Cloud& scan);

/// Writes NAME.pcd.bin, five floats a point, and NAME_lidarseg.bin: 24, driveable surface, where
/// the made-up classes have road, else 30, vegetation.
void put_lidarseg(const std::filesystem::path& folder, const std::string& name,
                  const io::Cloud& scan);

/// The results file of a command.
nlohmann::json json_of(const std::filesystem::path& file);

/// Results of `flagstone eval` without what may differ from run to run: times, rates, threads.
nlohmann::json without_times(nlohmann::json results);

}  // namespace flagstone::cli
