// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/core/lane_functions.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/core/lane_functions.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h includes this file once per instruction set.
#include "library/core/simd/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::tests::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
namespace simd = flagstone::HWY_NAMESPACE;
using simd::FloatTag;
using simd::IntTag;

std::size_t length() { return hn::Lanes(IntTag()); }

void add_products(const std::int32_t* pairs, const std::int32_t* factors, std::int32_t* to) {
  const IntTag di;
  for (std::size_t i = 0; i < simd::lanes; i += hn::Lanes(di)) {
    hn::StoreU(simd::sum_of_products(hn::LoadU(di, pairs + i), hn::LoadU(di, factors + i)), di,
               to + i);
  }
}

void saturate(const std::int32_t* first, const std::int32_t* second, std::int32_t* to) {
  const IntTag di;
  for (std::size_t i = 0; i < simd::lanes; i += hn::Lanes(di)) {
    hn::StoreU(simd::saturated_pairs(hn::LoadU(di, first + i), hn::LoadU(di, second + i)), di,
               to + i);
  }
}

void rank(std::uint32_t bits, std::int32_t* to) { hn::StoreU(simd::ranks_of(bits), IntTag(), to); }

void look_up_in_one(const float* table, const std::int32_t* indices, float* to) {
  const IntTag di;
  for (std::size_t i = 0; i < simd::lanes; i += hn::Lanes(di)) {
    hn::StoreU(simd::lookup_in_one(table, hn::LoadU(di, indices + i)), FloatTag(), to + i);
  }
}

void look_up_in_eight(const float* table, const std::int32_t* indices, float* to) {
  const IntTag di;
  const simd::Table8<FloatTag> eight(table);
  for (std::size_t i = 0; i < simd::lanes; i += hn::Lanes(di)) {
    hn::StoreU(eight[hn::LoadU(di, indices + i)], FloatTag(), to + i);
  }
}

void store(std::uint32_t bits, std::uint8_t* to) { simd::store_bits(bits, to); }

std::uint32_t find_bits(const std::int32_t* numbers) {
  const IntTag di;
  return simd::bits_of(di, hn::Ne(hn::LoadU(di, numbers), hn::Zero(di)));
}

}  // namespace
}  // namespace flagstone::tests::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::tests {
namespace {
HWY_EXPORT(length);
HWY_EXPORT(add_products);
HWY_EXPORT(saturate);
HWY_EXPORT(rank);
HWY_EXPORT(look_up_in_one);
HWY_EXPORT(look_up_in_eight);
HWY_EXPORT(store);
HWY_EXPORT(find_bits);
}  // namespace

std::size_t vector_length() { return HWY_DYNAMIC_DISPATCH(length)(); }

Lanes sum_of_products(const Lanes& pairs, const Lanes& factors) {
  Lanes sums{};
  HWY_DYNAMIC_DISPATCH(add_products)(pairs.data(), factors.data(), sums.data());
  return sums;
}

Lanes saturated_pairs(const Lanes& first, const Lanes& second) {
  Lanes pairs{};
  HWY_DYNAMIC_DISPATCH(saturate)(first.data(), second.data(), pairs.data());
  return pairs;
}

Lanes ranks_of(std::uint32_t bits) {
  Lanes ranks{};
  HWY_DYNAMIC_DISPATCH(rank)(bits, ranks.data());
  return ranks;
}

FloatLanes lookup_in_one(const float* table, const Lanes& indices) {
  FloatLanes found{};
  HWY_DYNAMIC_DISPATCH(look_up_in_one)(table, indices.data(), found.data());
  return found;
}

FloatLanes lookup_in_eight(const float* table, const Lanes& indices) {
  FloatLanes found{};
  HWY_DYNAMIC_DISPATCH(look_up_in_eight)(table, indices.data(), found.data());
  return found;
}

std::vector<std::uint8_t> stored_bits(std::uint32_t bits) {
  std::vector<std::uint8_t> bytes(vector_length(), 7);
  HWY_DYNAMIC_DISPATCH(store)(bits, bytes.data());
  return bytes;
}

std::uint32_t bits_of(const Lanes& lanes) { return HWY_DYNAMIC_DISPATCH(find_bits)(lanes.data()); }

}  // namespace flagstone::tests
#endif
