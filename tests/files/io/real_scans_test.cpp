// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// The scans of the developers' machines; skipped where they are not.

#include "real_scans.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "files/io/bytes.hpp"
#include "files/io/label_files.hpp"
#include "files/io/load_bytes.hpp"
#include "files/io/npy.hpp"
#include "files/io/pcd.hpp"
#include "files/io/ply.hpp"
#include "files/io/read_cloud.hpp"
#include "files/io/rows.hpp"
#include "files/io/status_matchers.hpp"
#include "files/io/text.hpp"

namespace flagstone::io {
namespace {

using tests::RealScan;

class RealScans : public ::testing::Test {
 protected:
  void SetUp() override { FLAGSTONE_REQUIRE_SCANS(scans); }

  const std::vector<RealScan> scans = tests::real_scans();
};

TEST_F(RealScans, HaveTheNumberOfPointsInTheIndex) {
  for (const RealScan& scan : scans) {
    Cloud cloud;
    ASSERT_THAT(read_cloud(scan.points, {}, cloud), is_ok());
    EXPECT_EQ(cloud.size(), scan.point_count) << scan.points;
    EXPECT_TRUE(is_scan_name(scan.points));
  }
}

TEST_F(RealScans, HaveOneLabelPerPoint) {
  for (const RealScan& scan : scans) {
    if (scan.labels.empty()) continue;
    std::vector<std::uint32_t> classes;
    EXPECT_THAT(read_reference(scan.labels, scan.point_count, classes), is_ok());
    EXPECT_FALSE(is_scan_name(scan.labels));
  }
}

TEST_F(RealScans, RoundTripInEveryFormat) {
  for (const RealScan& scan : scans) {
    Cloud cloud;
    ASSERT_THAT(read_cloud(scan.points, {}, cloud), is_ok());
    using Writer = Status (*)(const Cloud&, std::vector<std::byte>&);
    using Reader = Status (*)(std::span<const std::byte>, Cloud&);
    const std::array<std::pair<Writer, Reader>, 3> formats{
        {{write_pcd, read_pcd}, {write_ply, read_ply}, {write_npy, read_npy}}};
    for (const auto& [write, read] : formats) {
      std::vector<std::byte> file;
      Cloud again;
      ASSERT_THAT(write(cloud, file), is_ok());
      ASSERT_THAT(read(file, again), is_ok());
      EXPECT_TRUE(std::ranges::equal(again.bytes(), cloud.bytes())) << scan.points;
      EXPECT_TRUE(std::ranges::equal(again.fields(), cloud.fields())) << scan.points;
    }
  }
}

TEST_F(RealScans, OusterHasMixedFieldsAndZeroReturns) {
  using enum FieldType;
  Cloud cloud;
  ASSERT_THAT(read_cloud(tests::real_scan_folder() / "ouster/ouster128-a.pcd", {}, cloud), is_ok());

  const std::vector<Field> expected{{"x", float32, 1, 0},        {"y", float32, 1, 4},
                                    {"z", float32, 1, 8},        {"timestamp", float64, 1, 12},
                                    {"intensity", uint8, 1, 20}, {"ring", uint16, 1, 21},
                                    {"azimuth", float32, 1, 23}};
  EXPECT_TRUE(std::ranges::equal(cloud.fields(), expected));
  std::size_t zeros = 0;
  std::size_t rings_beyond = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point point = cloud.view()[i];
    if (point.x == 0 && point.y == 0 && point.z == 0) ++zeros;
    if (cloud.value(i, *cloud.find("ring")) > 127) ++rings_beyond;
  }
  EXPECT_EQ(zeros, 34102U);
  EXPECT_EQ(rings_beyond, 0U);
}

TEST_F(RealScans, ReportTheOffsetIfTruncatedAnywhere) {
  Bytes file;
  ASSERT_THAT(load_bytes(tests::real_scan_folder() / "airborne/samp31.pcd", file), is_ok());
  // The file has unused bytes after the compressed data, so take its end from its header.
  const std::string_view last_line = "DATA binary_compressed\n";
  const std::size_t data = as_text(file).find(last_line) + last_line.size();
  const std::size_t end = data + 8 + load<std::uint32_t>(file.data() + data);
  for (std::size_t size = 0; size < end; size += 997) {
    Cloud cloud;
    EXPECT_THAT(read_pcd(std::span(file).first(size), cloud),
                fails(StatusCode::bad_file, ::testing::StartsWith(fmt::format("byte {}: ", size))));
  }
}

}  // namespace
}  // namespace flagstone::io
