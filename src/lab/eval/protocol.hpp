// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/status.hpp"
#include "library/core/truth.hpp"

namespace flagstone::eval {
/// Defines which ground-truth classes are ground and which are not scored. Scores are comparable
/// only under the same protocol.
struct Protocol {
  std::string name;
  std::vector<std::uint32_t> ground;   ///< class ids that are ground
  std::vector<std::uint32_t> ignored;  ///< class ids that are not scored

  /// A class that is ground at low points: `id` counts as ground below `height` (z, metres, sensor
  /// frame), otherwise as not ground.
  struct LowGround {
    std::uint32_t id;
    float height;
  };
  std::vector<LowGround> low_ground;
};

/// Protocol of the Patchwork paper, section IV-A, for SemanticKITTI ids: ground is the six ground
/// classes and vegetation below z = -1.3 m. All points are scored.
const Protocol& patchwork_protocol();

/// Protocol of Patchwork++ (Lee, Lim, Myung, IROS 2022), for SemanticKITTI ids: ground is the six
/// ground classes. Unlabelled points, outliers and vegetation are not scored.
const Protocol& patchwork_plusplus_protocol();

/// For nuScenes-lidarseg ids: flat surfaces are ground. Noise and the ego vehicle are not scored.
const Protocol& lidarseg_protocol();

/// For simulated scans, with exact ground truth: the six SemanticKITTI ground classes are ground,
/// everything else is not. All points are scored.
const Protocol& simulation_protocol();

/// All built-in protocols, in the order above.
std::span<const Protocol* const> known_protocols() noexcept;

/// Ground truth of each point under a protocol. `classes` contains one id per point of `cloud`.
std::vector<Truth> truth_of(const Protocol& protocol, CloudView cloud,
                            std::span<const std::uint32_t> classes);

/// Overload that reuses the memory of `truth`.
void truth_of(const Protocol& protocol, CloudView cloud, std::span<const std::uint32_t> classes,
              std::vector<Truth>& truth);

/// Reads a protocol from a TOML or JSON file:
///
///     name = "my-classes"        # default: the file name without extension
///     ground = [40, 44, 48]      # class ids, 0 to 65535
///     ignored = [0, 1]           # not scored; optional
///     not_ground = [10, 50]      # optional, for documentation: unlisted classes are not ground
///     low_ground = [{id = 70, height = -1.3}]  # ground below this z, metres; optional
///
/// The keys `labels`, `names` and `note` are allowed and ignored. Other keys are errors, and so is
/// the name of a built-in protocol. Errors: not_found, unreadable, bad_file, invalid_argument
/// (unknown file extension); the message is one line with the file and the key. `out` is changed
/// only on success.
Status read_protocol(const std::filesystem::path& path, Protocol& out);

/// Finds a built-in protocol by name, or reads it from a file if the name ends in .toml or .json.
/// The message of invalid_argument lists the built-in protocols.
Status find_protocol(const std::string& name_or_file, Protocol& out);

}  // namespace flagstone::eval
