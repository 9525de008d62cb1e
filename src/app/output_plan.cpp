// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/output_plan.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/config/config_toml.hpp"
#include "files/io/message.hpp"

namespace flagstone::app {
namespace fs = std::filesystem;

namespace {

using Identity = std::pair<dev_t, ino_t>;

std::optional<Identity> identity_of(const fs::path& file) {
  struct stat status{};
  if (::stat(file.c_str(), &status) != 0) return {};
  return Identity(status.st_dev, status.st_ino);
}

/// Canonical paths of files; remembers the directory, which most files share.
class CanonicalPaths {
 public:
  fs::path of(const fs::path& file) {
    std::error_code error;
    if (fs::is_symlink(file, error)) {
      fs::path target = fs::weakly_canonical(file, error);
      if (!error) return target;
    }
    const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
    if (folder != folder_ || canonical_folder_.empty()) {
      folder_ = folder;
      canonical_folder_ = fs::weakly_canonical(folder, error);
      if (error) canonical_folder_ = fs::absolute(folder, error).lexically_normal();
    }
    return canonical_folder_ / file.filename();
  }

 private:
  fs::path folder_, canonical_folder_;
};

/// Could this file in a dataset be the result of an earlier run?
bool is_result(const fs::path& file) {
  constexpr std::array<std::string_view, 5> extensions{".json", ".csv", ".html", ".png",
                                                       ".checkpoint"};
  return file.filename() != "scene.json" &&
         std::ranges::find(extensions, file.extension().string()) != extensions.end();
}

void refuse(const fs::path& output, const fs::path& input) {
  throw std::invalid_argument(
      fmt::format("{}: this output would overwrite the input {} (choose another output)",
                  io::printable(output), io::printable(input)));
}

void refuse_two_of_one_file(const std::vector<fs::path>& outputs) {
  CanonicalPaths paths;
  std::map<fs::path, const fs::path*> taken;
  for (const fs::path& output : outputs) {
    const auto [other, is_new] = taken.emplace(paths.of(output), &output);
    if (is_new) continue;
    throw std::invalid_argument(
        fmt::format("{}: this output would overwrite the output {} of the same run (choose another "
                    "output)",
                    io::printable(output), io::printable(*other->second)));
  }
}

}  // namespace

void OutputPlan::reads(const fs::path& file) {
  if (!file.empty()) inputs_.push_back(file);
}

void OutputPlan::reads_settings(const std::string& config_file, const std::string& sensor) {
  reads(config_file);
  reads(sensor);
  if (config_file.empty()) return;
  const auto named = config::sensor_named_in(config::parse_toml_file(config_file));
  if (!named) return;
  reads(*named);
  reads(fs::path(config_file).parent_path() / *named);
}

void OutputPlan::reads_dataset(const fs::path& folder) {
  if (!folder.empty()) datasets_.push_back(folder);
}

void OutputPlan::writes(const fs::path& file) {
  if (!file.empty()) outputs_.push_back(file);
}

void OutputPlan::check() const {
  refuse_two_of_one_file(outputs_);
  std::map<Identity, const fs::path*> existing;
  for (const fs::path& output : outputs_) {
    if (const auto identity = identity_of(output)) existing.emplace(*identity, &output);
  }
  if (existing.empty()) return;  // nothing can be overwritten

  const auto compare = [&](const fs::path& input) {
    const auto identity = identity_of(input);
    if (!identity) return;
    if (const auto found = existing.find(*identity); found != existing.end()) {
      refuse(*found->second, input);
    }
  };
  for (const fs::path& input : inputs_) compare(input);
  for (const fs::path& dataset : datasets_) {
    constexpr auto options = fs::directory_options::skip_permission_denied |
                             fs::directory_options::follow_directory_symlink;
    std::error_code error;
    for (fs::recursive_directory_iterator walk(dataset, options, error);
         !error && walk != fs::recursive_directory_iterator(); walk.increment(error)) {
      if (walk->is_regular_file(error) && !is_result(walk->path())) compare(walk->path());
    }
  }
}

}  // namespace flagstone::app
