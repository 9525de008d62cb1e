// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>

#include <cstddef>
#include <string>

#include "flagstone/status.hpp"

namespace flagstone::io {

MATCHER(is_ok, "is a success") {
  *result_listener << arg.message();
  return arg.ok();
}

/// An error of this code whose one-line message matches.
template <class MessageMatcher>
auto fails(StatusCode code, const MessageMatcher& message) {
  using ::testing::AllOf;
  using ::testing::Not;
  using ::testing::Property;
  return AllOf(
      Property("code", &Status::code, code),
      Property("message", &Status::message,
               AllOf(Not(::testing::HasSubstr("\n")), ::testing::Matcher<std::string>(message))));
}

/// bad_file with "byte OFFSET: " and a message that contains `reason`.
inline auto is_bad_at(std::size_t offset, const std::string& reason) {
  return fails(StatusCode::bad_file,
               ::testing::AllOf(::testing::StartsWith("byte " + std::to_string(offset) + ": "),
                                ::testing::HasSubstr(reason)));
}

}  // namespace flagstone::io
