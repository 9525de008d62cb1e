// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "files/io/cloud.hpp"
#include "flagstone/status.hpp"

/// Properties of every reader, for any bytes. A violation aborts, which the fuzzer reports.
namespace flagstone::fuzz {

/// Aborts and prints `property` unless `holds`.
void require(bool holds, const char* property);

/// An error has an error code of a reader and one printable line with a byte offset; a success has
/// no message.
void check_status(const Status& status);

/// The rows are whole, the fields cover them, and every point can be read through view() and
/// value().
void check_cloud(const io::Cloud& cloud);

using Writer = Status (*)(const io::Cloud&, std::vector<std::byte>&);
using Reader = Status (*)(std::span<const std::byte>, io::Cloud&);

/// A written cloud reads back with the same points and the same fields, except for the type of
/// padding. A writer may fail if its format does not support the cloud, but not with `holds_all`.
void check_round_trip(const io::Cloud& cloud, Writer write, Reader read, bool holds_all);

}  // namespace flagstone::fuzz
