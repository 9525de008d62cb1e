// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "cli/scan_inputs.hpp"
#include "files/io/read_cloud.hpp"
#include "flagstone/mount.hpp"

namespace flagstone::cli {

/// How the sensor of a run stands, told by one of its scans.
struct FoundMount {
  MountSettings settings;      ///< what all scans are segmented with: fixed
  MountDecision decision;      ///< about the scan that tells it, or the last asked
  std::filesystem::path scan;  ///< that scan; empty if none can be read
  std::size_t asked = 0;       ///< scans
};

/// Asks so many scans before it gives up.
inline constexpr std::size_t most_scans_asked = 20;

/// Asks the scans in order, before any is segmented, so that the labels do not depend on how many
/// are segmented at once. If none tells, the given mount holds. Scans that cannot be read are
/// passed over. `settings.height` or `tilt` is `estimate`.
FoundMount find_mount(std::span<const ScanInput> scans, const MountSettings& settings,
                      const io::ReadOptions& read);

/// What was decided and why, one line.
std::string to_text(const FoundMount& found);

}  // namespace flagstone::cli
