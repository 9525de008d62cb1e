// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace flagstone::cli {

/// Replaces this process with the Python of the package that this command belongs to, which runs
/// `command`. `options` must be UTF-8; `paths` may contain any bytes.
///
/// Throws std::invalid_argument with what to install if the command was not started by the Python
/// package, std::runtime_error if Python cannot be started.
[[noreturn]] void run_in_python(const std::string& command, const nlohmann::ordered_json& options,
                                const std::vector<std::string>& paths);

/// Runs `command` in the same Python and waits for it. Returns its exit code; 1 if a signal ended
/// it. It is ended some time after a signal that catch_interrupts() noticed. `extra`: the optional
/// dependencies that the command needs, for the message if the Python package is missing. Throws as
/// run_in_python().
int call_python(const std::string& command, const nlohmann::ordered_json& options,
                const std::vector<std::string>& paths, std::string_view extra);

/// Whether the path names a bag: a file .bag, .mcap or .db3, or a directory with metadata.yaml.
bool is_bag(std::string_view path);

/// Whether the paths name bags. Throws std::invalid_argument if only some of them do.
bool are_bags(const std::vector<std::string>& paths);

}  // namespace flagstone::cli
