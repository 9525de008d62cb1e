// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "app/config/method_choice.hpp"
#include "lab/eval/method.hpp"

namespace flagstone::cli {

/// The options that say which methods are evaluated, and with which settings.
struct EvalMethods {
  config::MethodChoice choice = {.methods = {"surface", "patchwork"}};
  std::vector<std::string> labels{};  ///< name=folder
  io::LabelMap label_map = io::LabelMap::flagstone;

  /// Adds the options to a command.
  void add_to(CLI::App& command);

  /// The methods in the order they are listed, each once; then those whose labels were made
  /// elsewhere. Throws std::invalid_argument with one line that says what is wrong.
  [[nodiscard]] std::vector<eval::Method> resolve() const;
};

}  // namespace flagstone::cli
