// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>

#include "allocation_meter.hpp"
#include "cloud_properties.hpp"
#include "files/io/npy.hpp"
#include "files/io/pcd.hpp"
#include "files/io/ply.hpp"

// Any bytes as a PLY file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flagstone;
  io::Cloud cloud;
  const fuzz::AllocationMeter meter;
  const Status status = io::read_ply(std::as_bytes(std::span(data, size)), cloud);
  meter.require_at_most(fuzz::plain_factor, size);
  fuzz::check_status(status);
  if (!status.ok()) return 0;
  fuzz::check_cloud(cloud);
  fuzz::check_round_trip(cloud, io::write_ply, io::read_ply, false);
  fuzz::check_round_trip(cloud, io::write_pcd, io::read_pcd, true);
  fuzz::check_round_trip(cloud, io::write_npy, io::read_npy, true);
  return 0;
}
