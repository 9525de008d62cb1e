// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Readers allocate in proportion to the size of the file, never as a header specifies, and report a
// failed allocation as a status.

#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "counted_allocation.hpp"
#include "files/io/bytes.hpp"
#include "files/io/compress_lzf.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/label_files.hpp"
#include "files/io/npy.hpp"
#include "files/io/pcd.hpp"
#include "files/io/ply.hpp"
#include "files/io/read_cloud.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::io {
namespace {

// Bytes that parsing a header and formatting an error may allocate.
constexpr std::size_t any_file = std::size_t{64} * 1024;

template <class Read>
std::size_t allocated_by(Read read) {
  allocated = 0;
  read();
  return allocated;
}

std::string pcd_header(const std::string& points, const std::string& data,
                       const std::string& type = "F", const std::string& size = "4") {
  const auto thrice = [](const std::string& word) {
    return " " + word + " " + word + " " + word + "\n";
  };
  return "FIELDS x y z\nSIZE" + thrice(size) + "TYPE" + thrice(type) + "POINTS " + points +
         "\nDATA " + data + "\n";
}

const std::string endless = "18446744073709551615";

TEST(Allocation, IsSmallForHeadersWithWrongSizes) {
  const std::string zeros(1000, '0');
  const std::string ply_end =
      "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  const std::string dictionary =
      "{'descr': '<f4', 'fortran_order': True, 'shape': (999999999999, 3)}\n";
  const std::vector<Bytes> files{
      bytes_of(pcd_header(endless, "ascii") + zeros),
      bytes_of(pcd_header(endless, "binary") + zeros),
      joined({bytes_of(pcd_header("333333333", "binary_compressed")),
              numbers<std::uint32_t>({992, 3999999996U}), Bytes(992)}),
      bytes_of("ply\nformat ascii 1.0\nelement vertex " + endless + ply_end + zeros),
      bytes_of("ply\nformat binary_big_endian 1.0\nelement vertex " + endless + ply_end + zeros),
      joined({bytes_of("\x93NUMPY"), numbers<std::uint8_t>({1, 0}),
              numbers({static_cast<std::uint16_t>(dictionary.size())}), bytes_of(dictionary),
              Bytes(1000)})};
  for (const Bytes& file : files) {
    Cloud cloud;
    EXPECT_LT(allocated_by([&] { EXPECT_FALSE(read_pcd(file, cloud).ok()); }), any_file);
    EXPECT_LT(allocated_by([&] { EXPECT_FALSE(read_ply(file, cloud).ok()); }), any_file);
    EXPECT_LT(allocated_by([&] { EXPECT_FALSE(read_npy(file, cloud).ok()); }), any_file);
  }
}

TEST(Allocation, IsAtMostTheFileSizeForRawPoints) {
  const Bytes file(1600000);
  Cloud cloud;
  EXPECT_LT(allocated_by([&] { EXPECT_TRUE(read_raw_points(file, 4, cloud).ok()); }),
            file.size() + any_file);
}

TEST(Allocation, IsSmallForRawFilesNoLargerThanAPreviousOne) {
  const TemporaryFolder folder;
  put_file(folder / "a.bin", std::string(1600000, '\0'));
  put_file(folder / "b.bin", std::string(1599984, '\0'));
  CloudReader reader;
  EXPECT_LT(allocated_by([&] { EXPECT_TRUE(reader.read(folder / "a.bin").ok()); }),
            1600000 + any_file);

  EXPECT_LT(allocated_by([&] { EXPECT_TRUE(reader.read(folder / "b.bin").ok()); }), any_file);
  EXPECT_LT(allocated_by([&] { EXPECT_TRUE(reader.read(folder / "a.bin").ok()); }), any_file);
}

TEST(Allocation, IsSmallForLabelFilesNoLongerThanAPreviousOne) {
  const TemporaryFolder folder;
  const std::vector<Label> labels(100000);
  LabelWriter writer;
  EXPECT_TRUE(writer.write_label_file(folder / "a.label", labels).ok());
  EXPECT_TRUE(writer.write_label_npy(folder / "a.npy", labels).ok());

  EXPECT_LT(allocated_by([&] {
              EXPECT_TRUE(writer.write_label_file(folder / "b.label", labels).ok());
              EXPECT_TRUE(writer.write_label_npy(folder / "b.npy", labels).ok());
            }),
            any_file);
}

TEST(Allocation, IsAtMostTheFileSizeForBinaryPcd) {
  const Bytes file = joined({bytes_of(pcd_header("100000", "binary")), Bytes(1200000)});
  Cloud cloud;
  EXPECT_LT(allocated_by([&] { EXPECT_TRUE(read_pcd(file, cloud).ok()); }), file.size() + any_file);
}

TEST(Allocation, IsAtMostFiveTimesTheFileSizeForOneByteCoordinates) {
  const Bytes file = joined({bytes_of(pcd_header("100000", "binary", "U", "1")), Bytes(300000)});
  Cloud cloud;
  EXPECT_LT(allocated_by([&] { EXPECT_TRUE(read_pcd(file, cloud).ok()); }),
            5 * file.size() + any_file);
}

TEST(Allocation, IsAtMostSixTimesTheTextForTheShortestNumbers) {
  std::string text = pcd_header("100000", "ascii", "F", "8");
  for (int i = 0; i < 100000; ++i) text += "1 1 1\n";
  const Bytes file = bytes_of(text);
  Cloud cloud;
  // The rows take four times the size of the text, the converted coordinates twice.
  EXPECT_LT(allocated_by([&] { EXPECT_TRUE(read_pcd(file, cloud).ok()); }),
            6 * file.size() + any_file);
}

TEST(Allocation, IsAtMostTwiceTheExpandedSizeForCompressedPcd) {
  const Bytes columns(1200000);
  const Bytes stream = compress_lzf(columns);
  const Bytes file = joined(
      {bytes_of(pcd_header("100000", "binary_compressed")),
       numbers({static_cast<std::uint32_t>(stream.size()), std::uint32_t{1200000}}), stream});
  Cloud cloud;
  EXPECT_LT(allocated_by([&] { EXPECT_TRUE(read_pcd(file, cloud).ok()); }),
            2 * columns.size() + any_file);
  EXPECT_GT(88 * file.size(), columns.size());
}

TEST(Allocation, IsAtMostFourTimesTheFileSizeForLabels) {
  const Bytes file(100000);
  std::vector<std::uint32_t> classes;
  EXPECT_LT(allocated_by([&] {
              EXPECT_TRUE(parse_reference(file, ClassFormat::lidarseg, 100000, classes).ok());
            }),
            4 * file.size() + any_file);
}

TEST(Allocation, ReturnsOutOfMemoryIfAnyAllocationFails) {
  const Bytes file = joined({bytes_of(pcd_header("100", "binary", "F", "8")), Bytes(2400)});
  Cloud cloud;
  const std::size_t needed = allocated_by([&] { ASSERT_TRUE(read_pcd(file, cloud).ok()); });
  std::size_t failures = 0;
  for (std::size_t budget = 0; budget < needed; budget += 7) {
    allocated = 0;
    allowed = budget;
    const Status status = read_pcd(file, cloud);
    allowed = unlimited;
    if (status.code() == StatusCode::out_of_memory) ++failures;
  }
  EXPECT_EQ(failures, (needed + 6) / 7);
}

}  // namespace
}  // namespace flagstone::io
