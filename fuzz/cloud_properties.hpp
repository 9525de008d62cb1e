// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "files/io/cloud.hpp"
#include "flagstone/status.hpp"

/// What must hold of every reader, whatever the bytes. A broken property aborts, which the fuzzer
/// takes for a finding.
namespace flagstone::fuzz {

/// Aborts with its text unless `holds`.
void require(bool holds, const char* property);

/// An error has a code of a reader and one printable line that names a byte; a success has no text.
void check_status(const Status& status);

/// The rows are whole, the fields cover them, and every point can be read through view() and
/// value().
void check_cloud(const io::Cloud& cloud);

using Writer = Status (*)(const io::Cloud&, std::vector<std::byte>&);
using Reader = Status (*)(std::span<const std::byte>, io::Cloud&);

/// What a writer makes of `cloud` reads back with the same points, and the same fields but for
/// padding, whose type may differ. A writer may refuse where its format cannot hold the cloud; one
/// that `holds_all` must not.
void check_round_trip(const io::Cloud& cloud, Writer write, Reader read, bool holds_all);

}  // namespace flagstone::fuzz
