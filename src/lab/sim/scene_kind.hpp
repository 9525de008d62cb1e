// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "lab/sim/landscape.hpp"

namespace flagstone::sim {

/// A kind of surroundings by name, of which every seed draws another world.
struct SceneKind {
  std::string_view name;
  std::string_view summary;  ///< a line for a list
  Landscape (*make)(std::uint64_t seed);
};

/// All kinds there are, in the order in which they are listed.
std::span<const SceneKind> scene_kinds() noexcept;

/// The kind of this name; null if there is none.
const SceneKind* find_scene_kind(std::string_view name) noexcept;

}  // namespace flagstone::sim
