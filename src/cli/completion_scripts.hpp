// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace flagstone::cli {

/// @name Scripts that complete commands, options and their values in a shell.
/// @{
std::string bash_completions(const CLI::App& program);
std::string zsh_completions(const CLI::App& program);
std::string fish_completions(const CLI::App& program);
/// @}

}  // namespace flagstone::cli
