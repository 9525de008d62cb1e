// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>

namespace flagstone {

/// Why something did not succeed.
enum class StatusCode {
  ok,                ///< it did succeed
  invalid_argument,  ///< the caller's arguments are off (null cloud with points, unknown name)
  out_of_memory,     ///< a buffer could not be allocated
  not_found,         ///< a file or folder is not there
  unreadable,        ///< a file exists, the system would not read it
  bad_file,          ///< a file's contents are not what its format allows
  unwritable,        ///< the system would not write a file
};

/// Success, or a code and one line that says what is wrong, where, and what to do.
/// A successful status holds no text and allocates nothing.
class Status {
 public:
  /// Success.
  Status() noexcept = default;
  /// `message` is one line without a newline; may be empty where the code says it all.
  explicit Status(StatusCode code, std::string message = {}) noexcept
      : code_(code), message_(std::move(message)) {}

  /// Did it succeed?
  [[nodiscard]] bool ok() const noexcept { return code_ == StatusCode::ok; }
  /// Why not, or `ok`.
  [[nodiscard]] StatusCode code() const noexcept { return code_; }
  /// One line without a newline; empty where the code says it all.
  [[nodiscard]] const std::string& message() const noexcept { return message_; }

 private:
  StatusCode code_ = StatusCode::ok;
  std::string message_;
};

}  // namespace flagstone
