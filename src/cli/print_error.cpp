// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/print_error.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "files/io/message.hpp"

namespace flagstone::cli {

void print_error(std::string_view message) {
  // Not fmt::print, which throws where standard error cannot be written.
  std::fputs(fmt::format("flagstone: {}\n", io::printable(message)).c_str(), stderr);
}

}  // namespace flagstone::cli
