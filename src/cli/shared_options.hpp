// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace flagstone::cli {

// Options that several commands have.

void add_scans_option(
    CLI::App& command, std::vector<std::string>& scans,
    std::string_view help = "Scans, or folders of them (.bin, .pcd.bin, .pcd, .ply, .npy)");

/// --columns
void add_columns_option(CLI::App& command, int& columns);

/// --threads, where 0 means all cores.
void add_threads_option(CLI::App& command, unsigned& threads,
                        std::string_view help = "Scans worked on at once. Default: all cores");

/// --seed, 0 to 2^64 - 1.
void add_seed_option(CLI::App& command, std::uint64_t& seed, std::string_view help);

}  // namespace flagstone::cli
