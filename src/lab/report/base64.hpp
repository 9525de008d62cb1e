// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace flagstone::report {

/// Base 64 with padding, in one line: RFC 4648, section 4.
std::string base64(std::span<const std::byte> bytes);

}  // namespace flagstone::report
