// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Written clouds read back unchanged in every format, for any fields.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "files/io/bytes.hpp"
#include "files/io/cloud_generator.hpp"
#include "files/io/npy.hpp"
#include "files/io/pcd.hpp"
#include "files/io/ply.hpp"

namespace flagstone::io {
namespace {

RC_GTEST_PROP(RoundTrip, PcdKeepsFieldsAndBytes, ()) {
  const Cloud cloud = *arbitrary_cloud();
  Bytes file;
  Cloud again;

  RC_ASSERT(write_pcd(cloud, file).ok());
  RC_ASSERT(read_pcd(file, again).message().empty());

  RC_ASSERT(std::ranges::equal(again.fields(), cloud.fields()));
  RC_ASSERT(std::ranges::equal(again.bytes(), cloud.bytes()));
}

RC_GTEST_PROP(RoundTrip, NpyKeepsFieldsAndBytes, ()) {
  const Cloud cloud = *arbitrary_cloud();
  Bytes file;
  Cloud again;

  RC_ASSERT(write_npy(cloud, file).ok());
  RC_ASSERT(read_npy(file, again).message().empty());

  // NumPy stores padding of any type as bytes.
  const auto is_kept = [](const Field& a, const Field& b) {
    return a == b || (a.is_padding() && b.is_padding() && a.size() == b.size());
  };
  RC_ASSERT(std::ranges::equal(again.fields(), cloud.fields(), is_kept));
  RC_ASSERT(std::ranges::equal(again.bytes(), cloud.bytes()));
}

bool is_same_number(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

RC_GTEST_PROP(RoundTrip, PlyKeepsEveryNumber, ()) {
  const Cloud cloud = *arbitrary_cloud();
  Bytes file;
  Cloud again;

  const Status written = write_ply(cloud, file);
  if (!written.ok()) {  // only 64-bit integers are not supported
    RC_ASSERT(written.message().find("64-bit") != std::string::npos);
    RC_DISCARD("a number that PLY cannot store");
  }
  RC_ASSERT(read_ply(file, again).message().empty());

  RC_ASSERT(again.size() == cloud.size());
  std::size_t column = 0;
  for (const Field& field : cloud.fields()) {
    if (field.is_padding()) continue;
    for (std::size_t element = 0; element < field.count; ++element, ++column) {
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        RC_ASSERT(
            is_same_number(again.value(i, again.fields()[column]), cloud.value(i, field, element)));
      }
    }
  }
  RC_ASSERT(column == again.fields().size());
}

}  // namespace
}  // namespace flagstone::io
