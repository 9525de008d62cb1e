// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/scan_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "files/io/message.hpp"
#include "files/io/npy.hpp"
#include "files/io/read_cloud.hpp"
#include "files/io/text.hpp"

namespace flagstone::app {
namespace fs = std::filesystem;

namespace {

/// True if this file is a scan although it has the name of an array of labels or heights.
bool is_scan_despite_name(const fs::path& file) {
  constexpr std::array<std::string_view, 4> extensions{".label.npy", ".heights.npy", ".surface.npy",
                                                       ".ground.npy"};
  const io::PathText name = io::file_name(file);
  if (std::ranges::none_of(extensions, [&](auto end) { return io::ends_with(name, end); })) {
    return false;
  }
  std::array<char, 1024> start{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(start.data(), start.size());
  io::NpyHeader header;
  const std::string_view text(start.data(), static_cast<std::size_t>(stream.gcount()));
  if (!io::read_npy_header(text, header).ok()) return false;
  return header.is_structured || (header.shape.size() == 2 && header.shape[1] >= 3);
}

/// The scans in a directory and below. Detects those that `segment` wrote.
class Folder {
 public:
  explicit Folder(const fs::path& path) {
    std::error_code error;
    fs::recursive_directory_iterator walk(path, fs::directory_options::skip_permission_denied,
                                          error);
    for (; !error && walk != fs::recursive_directory_iterator(); walk.increment(error)) {
      const fs::path& file = walk->path();
      if (walk->is_regular_file(error) && (io::is_scan_name(file) || is_scan_despite_name(file))) {
        files_.insert(file);
        stems_.insert(without_scan_extension(file));
      }
    }
    if (error) {
      throw std::invalid_argument(
          fmt::format("{}: cannot be searched: {}", io::printable(path), error.message()));
    }
  }

  [[nodiscard]] const std::set<fs::path>& files() const noexcept { return files_; }

  [[nodiscard]] bool was_written_by_segment(const fs::path& file) const {
    const std::string extension = scan_extension(file);
    const std::string stem = without_scan_extension(file).string();
    for (const auto& [part, other] :
         {std::pair{".ground", ".nonground"}, {".nonground", ".ground"}}) {
      if (!stem.ends_with(part)) continue;
      const std::string scan = stem.substr(0, stem.size() - std::string_view(part).size());
      std::string counterpart = scan;
      counterpart.append(other).append(extension);
      return files_.contains(scan + extension) && files_.contains(counterpart);
    }
    constexpr std::string_view surface = ".surface";
    std::error_code error;
    return extension == ".npy" && stem.ends_with(surface) &&
           stems_.contains(stem.substr(0, stem.size() - surface.size())) &&
           fs::is_regular_file(stem + ".json", error);
  }

 private:
  std::set<fs::path> files_;
  std::set<fs::path> stems_;
};

std::vector<ScanInput> scans_below(const fs::path& path, const RunCallbacks& callbacks) {
  const Folder folder(path);
  std::vector<ScanInput> scans;
  for (const fs::path& file : folder.files()) {
    if (folder.was_written_by_segment(file)) continue;
    scans.push_back({file, without_scan_extension(file.lexically_relative(path))});
  }
  if (scans.empty()) {
    throw std::invalid_argument(
        fmt::format("{}: no scan in this directory or below (expected .bin, .pcd.bin, .pcd, .ply "
                    "or .npy files)",
                    io::printable(path)));
  }
  if (const std::size_t skipped = folder.files().size() - scans.size(); skipped > 0) {
    callbacks.say(fmt::format(
        "{}: skipped {} {} that an earlier run of segment wrote next to {} (to use one as a scan, "
        "name the file itself)",
        io::printable(path), skipped, skipped == 1 ? "file" : "files",
        skipped == 1 ? "its scan" : "their scans"));
  }
  return scans;
}

}  // namespace

fs::path without_scan_extension(const fs::path& file) {
  fs::path stem = file;
  stem.replace_extension();
  if (io::lower_case_name(file).ends_with(".pcd.bin")) stem.replace_extension();
  return stem;
}

std::string scan_extension(const fs::path& file) {
  return file.string().substr(without_scan_extension(file).string().size());
}

fs::path with_suffix(const fs::path& stem, const std::string& suffix) {
  return {stem.string() + suffix};
}

std::vector<ScanInput> find_scans(const std::vector<std::string>& paths,
                                  const RunCallbacks& callbacks) {
  std::vector<ScanInput> scans;
  for (const std::string& path : paths) {
    std::error_code error;
    if (fs::is_directory(path, error)) {
      std::ranges::move(scans_below(path, callbacks), std::back_inserter(scans));
    } else {
      scans.push_back({path, without_scan_extension(fs::path(path).filename())});
    }
  }
  return scans;
}

std::vector<ScanInput> list_scans(const std::vector<std::string>& paths,
                                  const RunCallbacks& callbacks) {
  std::vector<ScanInput> scans = find_scans(paths, callbacks);
  std::map<fs::path, fs::path> taken;
  for (const ScanInput& scan : scans) {
    const auto [other, is_new] = taken.emplace(scan.output_stem, scan.file);
    if (!is_new) {
      throw std::invalid_argument(fmt::format(
          "{} and {} would both write to {}.* (name a directory above both, or use separate "
          "runs)",
          io::printable(other->second), io::printable(scan.file), io::printable(scan.output_stem)));
    }
  }
  return scans;
}

}  // namespace flagstone::app
