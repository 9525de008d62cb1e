// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace flagstone::io {

/// The last part of `path`, which must outlive it.
std::string_view file_name(const std::filesystem::path& path) noexcept;

/// The last part of `path` in lower case.
std::string lower_case_name(const std::filesystem::path& path);

/// Whether `name` ends with `ending`, which is in lower case, in any case.
bool ends_with(std::string_view name, std::string_view ending) noexcept;

}  // namespace flagstone::io
