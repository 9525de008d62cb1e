// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "library/ground_map/state_bytes.hpp"
#include "library/moving_points/looks.hpp"

namespace flagstone {

/// Appends a scan to a state: time, pose and range image. May throw std::bad_alloc.
void write_view(const ScanView& scan, StateWriter& writer);

/// Reads a scan of a state. bad_file if it is damaged. May throw std::bad_alloc.
Status read_view(StateReader& reader, ScanView& scan);

}  // namespace flagstone
