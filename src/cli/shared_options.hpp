// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/help.hpp"
#include "files/io/label_files.hpp"
#include "library/core/did_you_mean.hpp"

namespace flagstone::cli {

// Options that several commands have, and how options check their values.

void add_scans_option(CLI::App& command, std::vector<std::string>& scans,
                      std::string_view help =
                          "Scan files, or directories to search for scans (.bin, .pcd.bin, .pcd, "
                          ".ply, .npy)");

/// --columns
void add_columns_option(CLI::App& command, int& columns);

/// --threads, where 0 means all cores.
void add_threads_option(CLI::App& command, unsigned& threads,
                        const std::string& default_text = "all cores");

/// --seed, 0 to 2^64 - 1.
void add_seed_option(CLI::App& command, std::uint64_t& seed, std::string_view help);

/// The names that --label-map takes.
std::vector<std::pair<std::string, io::LabelMap>> label_maps();

/// A check that a value is a number from `min` to `max`. NaN is not.
template <class Number>
CLI::Validator in_range(Number min, Number max) {
  return CLI::Validator(
      [min, max](const std::string& text) -> std::string {
        Number value{};
        const char* const problem = !CLI::detail::lexical_cast(text, value) ? "is not a number"
                                    : !(value >= min && value <= max)       ? "is out of range"
                                                                            : nullptr;
        if (problem == nullptr) return {};
        return fmt::format("{} {} (expected {} to {})", text, problem, min, max);
      },
      "");
}

/// An option that takes one of several names, each with its value. An unknown name is a usage error
/// with a suggestion. `kind`: "format", for the message.
template <class Value, class Target>
CLI::Option* add_choice_option(CLI::App& command, const std::string& option, std::string kind,
                               std::vector<std::pair<std::string, Value>> choices, Target& target,
                               const std::string& help) {
  const auto choose = [option, kind = std::move(kind), choices = std::move(choices),
                       &target](const std::string& name) {
    const auto found = std::ranges::find(choices, name, &std::pair<std::string, Value>::first);
    if (found != choices.end()) {
      target = found->second;
      return;
    }
    std::vector<std::string_view> names;
    for (const auto& [known, value] : choices) names.push_back(known);
    throw CLI::ValidationError(option, no_such(kind, name, names));
  };
  return command.add_option_function<std::string>(option, choose, help)->type_name("NAME");
}

}  // namespace flagstone::cli
