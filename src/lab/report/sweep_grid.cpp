// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/report/sweep_grid.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <system_error>

namespace flagstone::report {
namespace {

using Json = nlohmann::ordered_json;

bool is_number(const std::string& text) noexcept {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stopped == end;
}

}  // namespace

SweepGrid::SweepGrid(const Json& results)
    : keys_(results.at("keys").get<std::vector<std::string>>()), values_(keys_.size()) {
  if (keys_.empty() || keys_.size() > 2) throw std::invalid_argument("a sweep has one or two keys");
  for (const Json& cell : results.at("cells")) {
    auto place = cell.at("values").get<std::vector<std::string>>();
    if (place.size() != keys_.size())
      throw std::invalid_argument("a cell of a sweep has a value per key");
    for (std::size_t key = 0; key < place.size(); ++key)
      if (std::ranges::find(values_[key], place[key]) == values_[key].end())
        values_[key].push_back(place[key]);
    cells_.emplace(std::move(place), &cell);
  }
}

bool SweepGrid::is_numeric(std::size_t key) const {
  return std::ranges::all_of(values_.at(key), is_number);
}

Json SweepGrid::mean(std::size_t first, std::size_t second, const char* metric) const {
  return number(first, second, metric, "mean");
}

Json SweepGrid::deviation(std::size_t first, std::size_t second, const char* metric) const {
  return number(first, second, metric, "std");
}

std::pair<double, double> SweepGrid::bounds(const char* metric) const {
  std::vector<double> means;
  for (const auto& [place, cell] : cells_)
    if (const Json& mean = cell->at(metric).at("mean"); mean.is_number())
      means.push_back(mean.get<double>());
  if (means.empty()) return {0, 0};
  const auto [low, high] = std::ranges::minmax(means);
  return {low, high};
}

Json SweepGrid::number(std::size_t first, std::size_t second, const char* metric,
                       const char* of) const {
  std::vector<std::string> place = {values_[0].at(first)};
  if (keys_.size() > 1) place.push_back(values_[1].at(second));
  const auto cell = cells_.find(place);
  return cell == cells_.end() ? Json() : cell->second->at(metric).at(of);
}

}  // namespace flagstone::report
