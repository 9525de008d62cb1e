// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <span>
#include <string_view>

#include "app/config/method_choice.hpp"

namespace flagstone::cli {

/// Adds --method, --preset, --sensor, --config, --set, --sensor-height and --tilt to a command that
/// runs one of the methods in `names`. They write to `choice`, whose only method is the default.
void add_method_options(CLI::App& command, config::MethodChoice& choice,
                        std::span<const std::string_view> names = config::method_names());

/// Adds these options to a command that runs several methods: --methods replaces --method, and
/// --set takes METHOD.KEY=VALUE.
void add_methods_options(CLI::App& command, config::MethodChoice& choice);

}  // namespace flagstone::cli
