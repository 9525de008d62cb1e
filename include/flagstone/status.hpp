// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>

namespace flagstone {

/// Outcome of an operation: success, or the kind of error.
enum class StatusCode {
  ok,                ///< success
  invalid_argument,  ///< an argument is invalid, such as a null cloud with points
  out_of_memory,     ///< a buffer could not be allocated
  not_found,         ///< a file or directory does not exist
  unreadable,        ///< a file exists, but reading it failed
  bad_file,          ///< the contents of a file or message do not match its format
  unwritable,        ///< writing a file failed
};

/// Success, or an error code with a message. The message is one line with the location of the
/// problem, its description and a hint. A successful status has no message and allocates nothing.
class Status {
 public:
  /// Success.
  Status() noexcept = default;
  /// An error. `message` is one line without a newline; it can be empty if the code is enough.
  explicit Status(StatusCode code, std::string message = {}) noexcept
      : code_(code), message_(std::move(message)) {}

  /// True on success.
  [[nodiscard]] bool ok() const noexcept { return code_ == StatusCode::ok; }
  /// The kind of error, or `ok`.
  [[nodiscard]] StatusCode code() const noexcept { return code_; }
  /// The message: one line without a newline, or empty if the code is enough.
  [[nodiscard]] const std::string& message() const noexcept { return message_; }

 private:
  StatusCode code_ = StatusCode::ok;
  std::string message_;
};

}  // namespace flagstone
