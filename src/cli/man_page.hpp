// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace flagstone::cli {

/// The help of the program, or of one of its commands, as a manual page for man(1).
std::string man_page(const CLI::App& command);

}  // namespace flagstone::cli
