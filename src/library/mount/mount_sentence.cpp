// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <iomanip>
#include <sstream>

#include "flagstone/mount.hpp"

namespace flagstone {
namespace {

void add_mount(std::ostream& text, const MountDecision& decision) {
  text << "sensor " << decision.mount.sensor_height << " m above the ground";
  if (decision.tilt >= 0.05f) {
    const auto& up = decision.mount.up;
    text << ", tilted by " << std::setprecision(1) << decision.tilt << " degrees"
         << std::setprecision(3) << ", up is (" << up[0] << ", " << up[1] << ", " << up[2] << ')'
         << std::setprecision(2);
  }
}

void add_reason(std::ostream& text, const MountDecision& decision) {
  const auto percent = [&](float share) {
    text << std::setprecision(0) << 100 * share << " %" << std::setprecision(2);
  };
  switch (decision.verdict) {
    case MountVerdict::fixed:
    case MountVerdict::accepted: break;
    case MountVerdict::too_few_points:
      text << "too few points where ground can be, " << decision.points << " places, "
           << decision.cells << " square metres";
      break;
    case MountVerdict::no_plane:
      text << "near points agree on no plane, they lie within " << decision.spread
           << " m of the best";
      break;
    case MountVerdict::obstructed:
      text << "what lies lowest is the foot of what stands on it, only ";
      percent(decision.free);
      text << " of it is free";
      break;
    case MountVerdict::points_below:
      text << "too much lies below the best plane, ";
      percent(decision.below);
      break;
    case MountVerdict::one_sided:
      text << "that ground is seen in " << decision.directions << " directions of " << decision.seen
           << " with any points";
      break;
    case MountVerdict::height_limit: text << "that height is not within the limits"; break;
    case MountVerdict::tilt_limit: text << "that tilt is beyond the limit"; break;
    case MountVerdict::outlier: text << "too far from what the scans before have told"; break;
  }
}

}  // namespace

std::string to_sentence(const MountDecision& decision) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2);
  if (decision.verdict == MountVerdict::fixed) {
    add_mount(text, decision);
    text << ", as given";
  } else if (decision.accepted()) {
    add_mount(text, decision);
    text << ", confidence " << decision.confidence;
  } else {
    text << "not told by this scan: ";
    add_reason(text, decision);
    const bool has_plane = decision.cells > 0;
    if (has_plane) {
      text << " (it seems: ";
      add_mount(text, decision);
      text << ", confidence " << decision.confidence << ')';
    }
  }
  return text.str();
}

}  // namespace flagstone
