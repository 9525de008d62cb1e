// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "cloud_properties.hpp"
#include "lab/eval/protocol.hpp"
#include "text_properties.hpp"

// The first byte selects TOML or JSON for the rest.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flagstone;
  if (size == 0) return 0;
  static const fuzz::ScratchFile toml("mine.toml");
  static const fuzz::ScratchFile json("mine.json");
  const fuzz::ScratchFile& file = data[0] % 2 == 0 ? toml : json;
  file.put({reinterpret_cast<const char*>(data) + 1, size - 1});

  eval::Protocol protocol;
  const Status status = eval::read_protocol(file.path(), protocol);
  if (!status.ok()) {
    fuzz::check_line(status.message());
    fuzz::require(protocol.ground.empty(), "a rejected protocol leaves nothing");
    return 0;
  }
  fuzz::require(!protocol.ground.empty() || !protocol.low_ground.empty(), "a protocol has ground");
  fuzz::check_line(protocol.name);
  return 0;
}
