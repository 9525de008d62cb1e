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
/// Which classes of a reference labelling are ground, and which are not scored. Scores are
/// comparable under one protocol only.
struct Protocol {
  std::string name;
  std::vector<std::uint32_t> ground;   ///< class ids that are ground
  std::vector<std::uint32_t> ignored;  ///< class ids that are not scored

  /// A class that is ground where it is low: `id` counts as ground below `height` (z, metres,
  /// sensor frame), else as not ground.
  struct LowGround {
    std::uint32_t id;
    float height;
  };
  std::vector<LowGround> low_ground;
};

/// The paper's, section IV-A, on SemanticKITTI ids: the six ground classes, and vegetation below
/// z = -1.3 m. Every point counts.
const Protocol& patchwork_protocol();

/// Patchwork++'s (Lee, Lim, Myung, IROS 2022), on SemanticKITTI ids: the six ground classes;
/// unlabelled points, outliers and vegetation are not scored.
const Protocol& patchwork_plusplus_protocol();

/// For nuScenes-lidarseg ids: flat surfaces are ground; noise and the own vehicle are not scored.
const Protocol& lidarseg_protocol();

/// For simulated scans, whose truth is exact: the six SemanticKITTI ground classes are ground, all
/// else is not. Every point counts.
const Protocol& simulation_protocol();

/// Every protocol known by name, in the order above.
std::span<const Protocol* const> known_protocols() noexcept;

/// What each point is under a protocol. `classes` holds one id per point of `cloud`.
std::vector<Truth> truth_of(const Protocol& protocol, CloudView cloud,
                            std::span<const std::uint32_t> classes);

/// The same into memory that is used again.
void truth_of(const Protocol& protocol, CloudView cloud, std::span<const std::uint32_t> classes,
              std::vector<Truth>& truth);

/// Reads a protocol from a TOML or JSON file:
///
///     name = "my-classes"        # the file's name if left out
///     ground = [40, 44, 48]      # class ids, 0 to 65535
///     ignored = [0, 1]           # not scored; may be left out
///     not_ground = [10, 50]      # says nothing new: whatever is not listed is not ground
///     low_ground = [{id = 70, height = -1.3}]  # ground below this z, metres; may be left out
///
/// `labels`, `names` and `note` may stand beside them and say nothing; other keys are refused, as
/// is the name of a protocol known by name. The message of an error is one line with the file and
/// the key. not_found, unreadable, bad_file, invalid_argument (unknown ending). `out` is only
/// changed on success.
Status read_protocol(const std::filesystem::path& path, Protocol& out);

/// The protocol of that name, or if there is none and the name ends in .toml or .json, from that
/// file. invalid_argument names the protocols there are.
Status find_protocol(const std::string& name_or_file, Protocol& out);

}  // namespace flagstone::eval
