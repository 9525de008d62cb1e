// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace flagstone {

/// The known name with the fewest single-character changes from `name`, case-insensitive. Empty if
/// no name is close.
std::string_view closest_name(std::string_view name, std::span<const std::string_view> known);

/// " (did you mean 'surface'?)", or an empty string if no name is close.
std::string did_you_mean(std::string_view name, std::span<const std::string_view> known);

/// "no method is named 'surfce' (expected patchwork, surface; did you mean 'surface'?)".
std::string no_such(std::string_view kind, std::string_view name,
                    std::span<const std::string_view> known);

/// True if the texts are equal except for the case of ASCII letters.
bool equal_but_for_case(std::string_view a, std::string_view b) noexcept;

}  // namespace flagstone
