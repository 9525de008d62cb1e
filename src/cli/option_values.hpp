// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace CLI {
class Option;
}  // namespace CLI

namespace flagstone::cli {

/// What a shell can suggest as the value of an option or argument.
struct OptionValues {
  enum class Paths { none, directories, all };

  std::vector<std::string> words;
  Paths paths = Paths::none;
  bool separated_by_commas = false;
};

OptionValues values_of(const CLI::Option& option);

}  // namespace flagstone::cli
