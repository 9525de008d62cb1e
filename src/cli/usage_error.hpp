// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace flagstone::cli {

/// One line for what CLI11 rejects: WHERE: PROBLEM (expected EXPECTED; HINT). Call it after
/// `program.parse()` threw `error`.
std::string usage_message(const CLI::App& program, const CLI::ParseError& error);

/// Throws std::invalid_argument if `word`, the first argument, is neither an option nor a command.
void check_command(const CLI::App& program, std::string_view word);

}  // namespace flagstone::cli
