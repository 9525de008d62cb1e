// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cloud_properties.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace flagstone::fuzz {
namespace {

/// Makes the reads observable, so that a sanitizer detects a read out of bounds.
volatile double sink;

bool is_same(const io::Cloud& a, const io::Cloud& b) {
  if (a.size() != b.size() || a.stride() != b.stride()) return false;
  if (!std::ranges::equal(a.bytes(), b.bytes())) return false;
  const auto is_kept = [](const io::Field& f, const io::Field& g) {
    return f == g ||
           (f.is_padding() && g.is_padding() && f.offset == g.offset && f.size() == g.size());
  };
  return std::ranges::equal(a.fields(), b.fields(), is_kept);
}

/// Compares only the numbers, for formats that change the layout (PLY).
bool has_same_numbers(const io::Cloud& a, const io::Cloud& b) {
  if (a.size() != b.size()) return false;
  std::size_t column = 0;
  for (const io::Field& field : a.fields()) {
    if (field.is_padding()) continue;
    for (std::size_t element = 0; element < field.count; ++element, ++column) {
      if (column >= b.fields().size()) return false;
      const io::Field& other = b.fields()[column];
      for (std::size_t i = 0; i < a.size(); ++i) {
        const double left = a.value(i, field, element);
        const double right = b.value(i, other);
        const bool are_both_nan = std::isnan(left) && std::isnan(right);
        if (left != right && !are_both_nan) return false;
      }
    }
  }
  return column == b.fields().size();
}

}  // namespace

void require(bool holds, const char* property) {
  if (holds) return;
  std::fprintf(stderr, "broken property: %s\n", property);
  std::abort();
}

void check_status(const Status& status) {
  const std::string& message = status.message();
  if (status.ok()) return require(message.empty(), "a success has no message");
  if (status.code() == StatusCode::out_of_memory) return;
  require(status.code() == StatusCode::bad_file, "a reader reports a bad file");
  require(message.starts_with("byte "), "a message starts with a byte offset");
  require(message.size() < 600, "a message is short");
  require(std::ranges::all_of(message, [](char c) { return c >= ' ' && c <= '~'; }),
          "a message is one printable line");
}

void check_cloud(const io::Cloud& cloud) {
  require(cloud.size() * cloud.stride() == cloud.bytes().size(), "the rows are whole");
  require(cloud.view().size() == cloud.size(), "the view has every point");
  std::size_t offset = 0;
  for (const io::Field& field : cloud.fields()) {
    require(field.offset == offset, "the fields are packed");
    offset += field.size();
  }
  require(offset == cloud.stride(), "the fields cover the row");
  double sum = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point point = cloud.view()[i];
    sum += static_cast<double>(point.x + point.y + point.z);
    const io::Field& last = cloud.fields().back();
    sum += cloud.value(i, last, last.count - 1);
  }
  sink = sum;
}

void check_round_trip(const io::Cloud& cloud, Writer write, Reader read, bool holds_all) {
  std::vector<std::byte> file;
  const Status written = write(cloud, file);
  if (!written.ok()) {
    require(!holds_all, "the format supports every cloud");
    return require(written.code() == StatusCode::invalid_argument, "a writer reports the reason");
  }
  io::Cloud again;
  const Status reread = read(file, again);
  if (!reread.ok()) std::fprintf(stderr, "%s\n", reread.message().c_str());
  require(reread.ok(), "a written cloud can be read");
  require(holds_all ? is_same(cloud, again) : has_same_numbers(cloud, again),
          "a written cloud is unchanged when it is read");
}

}  // namespace flagstone::fuzz
