// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>

#include "cloud_properties.hpp"
#include "files/io/lzf.hpp"

// Any bytes as an LZF stream.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flagstone;
  const auto stream = std::as_bytes(std::span(data, size));
  std::size_t expanded = 0;
  const Status status = io::measure_lzf(stream, 0, expanded);
  fuzz::check_status(status);
  if (!status.ok()) return 0;
  fuzz::require(expanded <= 88 * size, "three bytes expand to at most 264");
  std::vector<std::byte> out(expanded);
  io::expand_lzf(stream, out);
  return 0;
}
