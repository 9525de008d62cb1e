// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>

#include "allocation_meter.hpp"
#include "cloud_properties.hpp"
#include "files/io/pcd.hpp"
#include "files/io/read_cloud.hpp"

// The first two bytes are the number of floats per point, the rest is the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flagstone;
  if (size < 2) return 0;
  const std::size_t floats = data[0] + std::size_t{256} * (data[1] % 8);
  io::Cloud cloud;
  const fuzz::AllocationMeter meter;
  const Status status =
      io::read_raw_points(std::as_bytes(std::span(data, size)).subspan(2), floats, cloud);
  if (floats < 3 || floats > io::max_fields) {
    fuzz::require(status.code() == StatusCode::invalid_argument, "the row width is checked");
    return 0;
  }
  meter.require_at_most(fuzz::plain_factor, size);
  fuzz::check_status(status);
  if (!status.ok()) return 0;
  fuzz::check_cloud(cloud);
  std::vector<std::byte> file;
  fuzz::require(io::write_raw_points(cloud, file).ok(), "raw points can be written");
  fuzz::require(file.size() == size - 2, "raw points are written unchanged");
  fuzz::check_round_trip(cloud, io::write_pcd, io::read_pcd, true);
  return 0;
}
