// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/shared_options.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <charconv>
#include <limits>
#include <memory>

#include "files/io/message.hpp"
#include "library/core/thread_pool.hpp"

namespace flagstone::cli {

void add_scans_option(CLI::App& command, std::vector<std::string>& scans, std::string_view help) {
  command.add_option("scans", scans, std::string(help))->required()->type_name("SCAN...");
}

void add_columns_option(CLI::App& command, int& columns) {
  command
      .add_option("--columns", columns,
                  "Floats per point in .bin files. Default: 5 for .pcd.bin, otherwise 4")
      ->check(CLI::Range(3, 1024))
      ->type_name("N");
}

void add_threads_option(CLI::App& command, unsigned& threads, std::string_view help) {
  command.add_option("--threads", threads, std::string(help))
      ->check(CLI::Range(1U, max_threads))
      ->type_name("N");
}

void add_seed_option(CLI::App& command, std::uint64_t& seed, std::string_view help) {
  const auto read = [&seed](const std::string& text) {
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, seed);
    if (error == std::errc() && rest == end) return;
    throw CLI::ValidationError(
        "--seed", fmt::format("{} is not a whole number (expected 0 to {})", io::quote(text),
                              std::numeric_limits<std::uint64_t>::max()));
  };
  command.add_option_function<std::string>("--seed", read, std::string(help))
      ->default_str(std::to_string(seed))
      ->type_name("N");
}

}  // namespace flagstone::cli
