// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/message.hpp"

namespace flagstone::io {
namespace {

constexpr std::size_t longest_quote = 32;

void append_hex(std::string& out, char c) {
  out += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
}

}  // namespace

std::string quote(std::string_view text) {
  std::string out = "'";
  for (const char c : text.substr(0, longest_quote)) {
    if (c >= ' ' && c <= '~') {
      out += c;
    } else {
      append_hex(out, c);
    }
  }
  out += text.size() > longest_quote ? "...'" : "'";
  return out;
}

std::string printable(const std::filesystem::path& path) {
  std::string out;
  for (const char c : path.string()) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x20 && code != 0x7f) {
      out += c;
    } else {
      append_hex(out, c);
    }
  }
  return out;
}

Status with_path(const std::filesystem::path& path, Status status) {
  if (status.ok()) return status;
  const StatusCode code = status.code();
  return within_memory([&] {
    std::string_view reason = status.message();
    if (reason.empty()) reason = code == StatusCode::out_of_memory ? "out of memory" : "failed";
    return Status(code, fmt::format("{}: {}", printable(path), reason));
  });
}

Status refuse(const std::filesystem::path& path, std::string_view reason) {
  return with_path(path, within_memory([&] { return invalid("{}", reason); }));
}

}  // namespace flagstone::io
