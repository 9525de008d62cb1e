// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/scan_view_bytes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flagstone {

void write_view(const ScanView& scan, StateWriter& writer) {
  writer.add(scan.time);
  for (const double number : scan.pose.numbers()) writer.add(number);
  scan.image.write(writer);
}

Status read_view(StateReader& reader, ScanView& scan) {
  constexpr double largest = 1e12;  // products of two are within the range of float
  const std::size_t offset = reader.offset();
  scan.time = reader.read<double>();
  LevelledPose::Numbers numbers{};
  for (double& number : numbers) number = reader.read<double>();
  const bool is_pose =
      std::ranges::all_of(numbers, [&](double number) { return std::abs(number) <= largest; });
  if (reader.failed() || !std::isfinite(scan.time) || !is_pose) {
    return bad_state(offset, "a scan without a time or a pose", "finite numbers");
  }
  scan.pose = LevelledPose(numbers);
  return scan.image.read(reader);
}

}  // namespace flagstone
