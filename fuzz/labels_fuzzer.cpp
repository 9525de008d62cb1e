// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>

#include "allocation_meter.hpp"
#include "cloud_properties.hpp"
#include "files/io/label_files.hpp"

// The first byte selects the layout, the next two the number of points of the scan, and the rest is
// the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flagstone;
  if (size < 3) return 0;
  const auto format = static_cast<io::ClassFormat>(data[0] % 3);
  const std::size_t expected = data[1] + std::size_t{256} * data[2];
  std::vector<std::uint32_t> classes;
  const fuzz::AllocationMeter meter;
  const Status status = io::parse_reference(std::as_bytes(std::span(data, size)).subspan(3), format,
                                            expected, classes);
  meter.require_at_most(fuzz::plain_factor, size);
  fuzz::check_status(status);
  fuzz::require(classes.size() == (status.ok() ? expected : 0), "one class per point, or none");
  return 0;
}
