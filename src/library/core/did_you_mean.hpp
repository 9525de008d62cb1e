// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace flagstone {

/// The name that was probably meant: the nearest by single-character changes, whatever the case;
/// empty if none is near.
std::string_view closest_name(std::string_view name, std::span<const std::string_view> known);

/// " (did you mean 'surface'?)", or nothing if no name is near.
std::string did_you_mean(std::string_view name, std::span<const std::string_view> known);

/// "no method is named 'surfce' (did you mean 'surface'?); there are: patchwork, surface".
std::string no_such(std::string_view kind, std::string_view name,
                    std::span<const std::string_view> known);

/// Are these the same, whatever the case of ASCII letters?
bool equal_but_for_case(std::string_view a, std::string_view b) noexcept;

}  // namespace flagstone
