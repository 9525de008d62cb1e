// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/lzf.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "files/io/bytes.hpp"
#include "files/io/compress_lzf.hpp"
#include "files/io/status_matchers.hpp"

namespace flagstone::io {
namespace {

Bytes expanded(const Bytes& stream) {
  std::size_t size = 0;
  EXPECT_THAT(measure_lzf(stream, 0, size), is_ok());
  Bytes out(size);
  expand_lzf(stream, out);
  return out;
}

Bytes stream(std::initializer_list<std::uint8_t> items) { return numbers(items); }

TEST(Lzf, ExpandsALiteral) { EXPECT_EQ(expanded(stream({2, 'a', 'b', 'c'})), bytes_of("abc")); }

TEST(Lzf, ExpandsAShortReference) {
  // 'abc', then 3 bytes from 3 back: length code 1, distance minus one is 2.
  EXPECT_EQ(expanded(stream({2, 'a', 'b', 'c', 1U << 5U, 2})), bytes_of("abcabc"));
}

TEST(Lzf, ExpandsAnOverlappingReference) {
  EXPECT_EQ(expanded(stream({0, 'a', 3U << 5U, 0})), bytes_of("aaaaaa"));
}

TEST(Lzf, ThreeBytesExpandToAtMost264) {
  EXPECT_EQ(expanded(stream({0, 'a', 7U << 5U, 255, 0})).size(), 265U);
}

TEST(Lzf, ExpandsAnEmptyStream) { EXPECT_TRUE(expanded({}).empty()); }

TEST(Lzf, RejectsAReferenceBeforeTheStart) {
  std::size_t size = 0;
  EXPECT_THAT(measure_lzf(stream({0, 'a', 1U << 5U, 1}), 100, size),
              is_bad_at(102, "refers 2 bytes back (expected at most 1)"));
}

TEST(Lzf, RejectsATruncatedLiteral) {
  std::size_t size = 0;
  EXPECT_THAT(measure_lzf(stream({0, 'a', 5, 'b'}), 100, size),
              is_bad_at(102, "ends within an item"));
}

TEST(Lzf, RejectsATruncatedReference) {
  std::size_t size = 0;
  EXPECT_THAT(measure_lzf(stream({0, 'a', 1U << 5U}), 0, size),
              is_bad_at(2, "ends within an item"));
  EXPECT_THAT(measure_lzf(stream({0, 'a', 7U << 5U, 9}), 0, size),
              is_bad_at(2, "ends within an item"));
}

RC_GTEST_PROP(Lzf, ExpandsCompressedBytes, ()) {
  const auto values =
      *rc::gen::container<std::vector<std::uint8_t>>(rc::gen::inRange<std::uint8_t>(0, 3));
  Bytes bytes;
  const auto repeats = *rc::gen::inRange(1, 30);
  for (int i = 0; i < repeats; ++i) {
    for (const std::uint8_t value : values) bytes.push_back(static_cast<std::byte>(value));
  }

  RC_ASSERT(expanded(compress_lzf(bytes)) == bytes);
}

}  // namespace
}  // namespace flagstone::io
