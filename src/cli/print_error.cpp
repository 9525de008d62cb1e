// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/print_error.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "io/message.hpp"

namespace flagstone::cli {

void print_error(std::string_view message) {
  fmt::print(stderr, "flagstone: {}\n", io::printable(message));
}

}  // namespace flagstone::cli
