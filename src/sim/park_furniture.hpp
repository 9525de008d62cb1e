// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "sim/frame.hpp"
#include "sim/mesh.hpp"

namespace flagstone::sim {

/// A bench of slats, 1.8 m wide (class other_object). `frame` stands on the ground below its seat,
/// whoever sits on it looks along x.
void add_bench(Mesh& mesh, const Frame& frame);

/// A litter bin on a post (class other_object). `frame` stands on the ground.
void add_litter_bin(Mesh& mesh, const Frame& frame);

}  // namespace flagstone::sim
