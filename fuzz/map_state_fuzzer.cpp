// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allocation_meter.hpp"
#include "cloud_properties.hpp"
#include "flagstone/ground_map.hpp"
#include "flagstone/label_vote.hpp"
#include "flagstone/moving_points.hpp"
#include "library/ground_map/state_bytes.hpp"

namespace flagstone {
namespace {

// A tile of a map has at least 572 bytes and takes 147 KB; a range image without rows has 184 bytes
// and takes 50 KB.
constexpr std::size_t state_factor = 320;

// Either the bytes are rejected, or the state that they contain is saved as these bytes.
template <class State>
void check(std::span<const std::byte> bytes) {
  State state;
  const fuzz::AllocationMeter meter;
  const Status status = state.from_bytes(bytes);
  meter.require_at_most(state_factor, bytes.size());
  fuzz::check_status(status);
  if (!status.ok()) return;
  std::vector<std::byte> again;
  fuzz::require(state.to_bytes(again).ok(), "a loaded state can be saved");
  fuzz::require(std::ranges::equal(again, bytes), "a state is saved as the bytes it came from");
}

}  // namespace
}  // namespace flagstone

// Any bytes as the state of a map, of votes and of moving points, as they are and with the right
// checksum.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flagstone;
  const std::span<const std::byte> bytes = std::as_bytes(std::span(data, size));
  std::vector<std::byte> sealed(bytes.begin(), bytes.end());
  StateWriter(sealed).finish();
  for (const std::span<const std::byte> input : {bytes, std::span<const std::byte>(sealed)}) {
    check<GroundMap>(input);
    check<LabelVote>(input);
    check<MovingPoints>(input);
  }
  return 0;
}
