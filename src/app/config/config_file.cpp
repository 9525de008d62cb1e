// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/config/config_file.hpp"

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "app/config/config_toml.hpp"
#include "files/io/load_bytes.hpp"

namespace flagstone::config {
namespace {

std::string text_of(const std::string& file) {
  std::vector<std::byte> bytes;
  const Status status = io::load_bytes(file, bytes);
  if (!status.ok()) throw std::invalid_argument(status.message());
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

void apply_file(const std::string& file, MethodConfig& config, MountSettings& mount_settings) {
  apply_toml(text_of(file), file, config, mount_settings);
}

std::optional<std::string> sensor_named_in_file(const std::string& file) {
  if (file.empty()) return std::nullopt;
  std::optional<std::string> named = sensor_named_in(text_of(file), file);
  const bool is_file = named && std::filesystem::path(*named).extension() == ".toml";
  if (is_file) named = (std::filesystem::path(file).parent_path() / *named).string();
  return named;
}

}  // namespace flagstone::config
