// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Functions of src/library/core/simd/lanes-inl.hpp for sixteen lanes, for tests.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace flagstone::tests {

using Lanes = std::array<std::int32_t, 16>;
using FloatLanes = std::array<float, 16>;

Lanes sum_of_products(const Lanes& pairs, const Lanes& factors);
Lanes saturated_pairs(const Lanes& first, const Lanes& second);

/// ranks_of() for the lanes of one vector. The lanes after them are 0.
Lanes ranks_of(std::uint32_t bits);

/// Looks up elements of a table of one vector. Each index is less than vector_length().
FloatLanes lookup_in_one(const float* table, const Lanes& indices);

/// Looks up elements of a table of eight numbers.
FloatLanes lookup_in_eight(const float* table, const Lanes& indices);

/// bits_of() for the lanes of one vector that are not 0.
std::uint32_t bits_of(const Lanes& lanes);

/// The bytes that store_bits() writes for one vector.
std::vector<std::uint8_t> stored_bits(std::uint32_t bits);

/// Number of lanes per vector.
std::size_t vector_length();

}  // namespace flagstone::tests
