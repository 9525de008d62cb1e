// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/shared_options.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Error.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <charconv>
#include <limits>
#include <memory>

#include "files/io/message.hpp"
#include "library/core/thread_pool.hpp"

namespace flagstone::cli {

std::vector<std::pair<std::string, io::LabelMap>> label_maps() {
  return {{"flagstone", io::LabelMap::flagstone}, {"semantic-kitti", io::LabelMap::semantic_kitti}};
}

void add_scans_option(CLI::App& command, std::vector<std::string>& scans, std::string_view help) {
  command.add_option("scans", scans, std::string(help))->required()->type_name("SCAN");
}

void add_columns_option(CLI::App& command, int& columns) {
  command.add_option("--columns", columns, "Floats per point in .bin files, 3 to 1024")
      ->check(in_range(3, 1024))
      ->default_str("5 for .pcd.bin, otherwise 4")
      ->type_name("N")
      ->group(input_group);
}

void add_threads_option(CLI::App& command, unsigned& threads, const std::string& default_text) {
  command
      .add_option("--threads", threads,
                  fmt::format("Number of scans to process in parallel, 1 to {}", max_threads))
      ->check(in_range(1U, max_threads))
      ->default_str(default_text)
      ->type_name("N")
      ->group(other_group);
}

void add_seed_option(CLI::App& command, std::uint64_t& seed, std::string_view help) {
  const auto read = [&seed](const std::string& text) {
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, seed);
    if (error == std::errc() && rest == end) return;
    throw CLI::ValidationError(
        "--seed", fmt::format("{} {} (expected 0 to {})", io::quote(text),
                              error == std::errc::result_out_of_range ? "is out of range"
                                                                      : "is not an integer",
                              std::numeric_limits<std::uint64_t>::max()));
  };
  command.add_option_function<std::string>("--seed", read, std::string(help))
      ->default_str(std::to_string(seed))
      ->type_name("N");
}

}  // namespace flagstone::cli
