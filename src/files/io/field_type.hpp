// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "files/io/cloud.hpp"

namespace flagstone::io {

// Rows are kept as little-endian bytes and read as the machine's own numbers.
static_assert(std::endian::native == std::endian::little, "flagstone reads on little-endian only");

/// Calls `work.template operator()<T>()` with the C++ type of `type`.
template <class Work>
decltype(auto) visit_type(FieldType type, Work&& work) {
  switch (type) {
    case FieldType::int8: return work.template operator()<std::int8_t>();
    case FieldType::uint8: return work.template operator()<std::uint8_t>();
    case FieldType::int16: return work.template operator()<std::int16_t>();
    case FieldType::uint16: return work.template operator()<std::uint16_t>();
    case FieldType::int32: return work.template operator()<std::int32_t>();
    case FieldType::uint32: return work.template operator()<std::uint32_t>();
    case FieldType::int64: return work.template operator()<std::int64_t>();
    case FieldType::uint64: return work.template operator()<std::uint64_t>();
    case FieldType::float32: return work.template operator()<float>();
    case FieldType::float64: break;
  }
  return work.template operator()<double>();
}

/// The number at an address of any alignment.
template <class T>
T load(const std::byte* from) noexcept {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

/// Stores a number at an address of any alignment.
template <class T>
void store(std::byte* to, T value) noexcept {
  std::memcpy(to, &value, sizeof value);
}

}  // namespace flagstone::io
