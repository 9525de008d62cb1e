// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/mount_estimation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/interrupt.hpp"
#include "files/io/cloud.hpp"
#include "files/io/message.hpp"

namespace flagstone::cli {

FoundMount find_mount(std::span<const ScanInput> scans, const MountSettings& settings,
                      const io::ReadOptions& read) {
  FoundMount found;
  found.settings = settings;
  found.settings.height = HeightSource::fixed;
  if (settings.tilt == TiltSource::estimate) found.settings.tilt = TiltSource::fixed;
  found.decision.mount = settings.mount;

  MountEstimator estimator(settings);
  io::Cloud cloud;
  for (const ScanInput& input : scans.first(std::min(scans.size(), most_scans_asked))) {
    if (interrupted()) break;
    if (!io::read_cloud(input.file, read, cloud).ok()) continue;  // it is reported in its turn
    found.decision = estimator.estimate(cloud.view());
    found.scan = input.file;
    ++found.asked;
    if (!found.decision.accepted()) continue;
    const Mount& told = found.decision.mount;
    if (settings.height != HeightSource::fixed) {
      found.settings.mount.sensor_height = told.sensor_height;
    }
    if (settings.tilt == TiltSource::estimate) found.settings.mount.up = told.up;
    break;
  }
  return found;
}

std::string to_text(const FoundMount& found) {
  if (found.decision.accepted()) {
    return fmt::format("mount: {}; told by {}", to_sentence(found.decision),
                       io::printable(found.scan));
  }
  MountDecision given;
  given.mount = found.settings.mount;
  if (found.scan.empty()) {
    return fmt::format("mount: {}; no scan to ask could be read", to_sentence(given));
  }
  return fmt::format("mount: {}; told by none of the first {} scans, the last, {}: {}",
                     to_sentence(given), found.asked, io::printable(found.scan),
                     to_sentence(found.decision));
}

}  // namespace flagstone::cli
