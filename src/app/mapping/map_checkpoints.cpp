// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/mapping/map_checkpoints.hpp"

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <system_error>
#include <vector>

#include "files/io/atomic_file.hpp"
#include "files/io/load_bytes.hpp"

namespace flagstone::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string to_text(const MapProgress& progress, unsigned number) {
  Json scans = Json::array();
  for (const MapProgress::Scan& scan : progress.scans) {
    const Levelling& l = scan.levelling;
    scans.push_back(
        {scan.is_used, scan.failed, l.applied, l.cells, l.offset, l.slope_x, l.slope_y});
  }
  const Json json = {{"checkpoint", number},        {"next", progress.next},
                     {"scans", std::move(scans)},   {"moving_points", progress.moving_points},
                     {"objects", progress.objects}, {"problems", progress.problems}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

MapProgress from_json(const Json& json) {
  MapProgress progress;
  progress.next = json.at("next");
  for (const Json& scan : json.at("scans")) {
    progress.scans.push_back({.is_used = scan.at(0),
                              .failed = scan.at(1),
                              .levelling = {.applied = scan.at(2),
                                            .cells = scan.at(3),
                                            .offset = scan.at(4),
                                            .slope_x = scan.at(5),
                                            .slope_y = scan.at(6)}});
  }
  progress.moving_points = json.at("moving_points");
  progress.objects = json.at("objects");
  progress.problems = json.at("problems");
  return progress;
}

}  // namespace

bool MapCheckpoints::is_due() const {
  constexpr double work_per_saving = 19;
  const std::chrono::duration<double> since = Clock::now() - saved_;
  return interval_ == 0 || since.count() >= std::max(interval_, work_per_saving * duration_);
}

Status MapCheckpoints::save(const MapProgress& progress, const RunMapper& mapper) {
  const Clock::time_point start = Clock::now();
  const unsigned number = 1 - number_;
  fs::create_directories(mapper_files(number));
  if (Status status = mapper.save(mapper_files(number)); !status.ok()) return status;
  const std::string text = to_text(progress, number);
  if (Status status = io::write_file(progress_file(), text); !status.ok()) return status;
  std::error_code ignored;
  fs::remove_all(mapper_files(number_), ignored);
  number_ = number;
  saved_ = Clock::now();
  duration_ = std::chrono::duration<double>(saved_ - start).count();
  return {};
}

std::optional<MapProgress> MapCheckpoints::load(std::size_t scans, RunMapper& mapper,
                                                const RunMapper::Reread& reread) {
  std::vector<std::byte> bytes;
  if (!io::load_bytes(progress_file(), bytes).ok()) return {};
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  try {
    const Json json = Json::parse(text);
    const unsigned number = json.at("checkpoint");
    MapProgress progress = from_json(json);
    if (number > 1 || progress.scans.size() != scans || progress.next > scans) return {};
    if (!mapper.load(mapper_files(number), reread).ok()) return {};
    number_ = number;
    return progress;
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

}  // namespace flagstone::app
