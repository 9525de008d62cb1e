// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "flagstone/status.hpp"
#include "lab/eval/protocol.hpp"

namespace flagstone::eval {

/// Reads a protocol from a TOML or JSON file:
///
///     name = "my-classes"        # the file's name if left out
///     ground = [40, 44, 48]      # class ids, 0 to 65535
///     ignored = [0, 1]           # not scored; may be left out
///     not_ground = [10, 50]      # says nothing new: whatever is not listed is not ground
///     low_ground = [{id = 70, height = -1.3}]  # ground below this z, metres; may be left out
///
/// `labels`, `names` and `note` may stand beside them and say nothing; other keys are refused, as
/// is the name of a protocol known by name. The message of an error is one line with the file and
/// the key. not_found, unreadable, bad_file, invalid_argument (unknown ending). `out` is only
/// changed on success.
Status read_protocol(const std::filesystem::path& path, Protocol& out);

/// The protocol of that name, or if there is none and the name ends in .toml or .json, from that
/// file. invalid_argument names the protocols there are.
Status find_protocol(const std::string& name_or_file, Protocol& out);

}  // namespace flagstone::eval
