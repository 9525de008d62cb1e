// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace flagstone::report {

/// The cells of a sweep by their place on a grid of one or two keys' values.
class SweepGrid {
 public:
  /// `results` as sweep_report() takes them, and must outlive this. Throws std::invalid_argument
  /// where there are not one or two keys, or a cell has another number of values.
  explicit SweepGrid(const nlohmann::ordered_json& results);

  [[nodiscard]] const std::vector<std::string>& keys() const noexcept { return keys_; }

  /// A key's values in the order they first appear in.
  [[nodiscard]] const std::vector<std::string>& values(std::size_t key) const {
    return values_.at(key);
  }

  /// Whether all values of a key are numbers.
  [[nodiscard]] bool is_numeric(std::size_t key) const;

  /// Mean and standard deviation of a metric for the first key's value `first` and the second's
  /// `second` (0 where there is one key); null where the sweep has no such cell.
  [[nodiscard]] nlohmann::ordered_json mean(std::size_t first, std::size_t second,
                                            const char* metric) const;
  [[nodiscard]] nlohmann::ordered_json deviation(std::size_t first, std::size_t second,
                                                 const char* metric) const;

  /// Lowest and highest mean of a metric; 0 and 0 where there is none.
  [[nodiscard]] std::pair<double, double> bounds(const char* metric) const;

 private:
  [[nodiscard]] nlohmann::ordered_json number(std::size_t first, std::size_t second,
                                              const char* metric, const char* of) const;

  std::vector<std::string> keys_;
  std::vector<std::vector<std::string>> values_;  // per key
  std::map<std::vector<std::string>, const nlohmann::ordered_json*> cells_;
};

}  // namespace flagstone::report
