// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Writes the initial corpus of the fuzzers: make_seeds DIR writes DIR/pcd/..., DIR/ply/... . The
// files are few and small; the fuzzers find more.

#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "files/io/atomic_file.hpp"
#include "files/io/bytes.hpp"
#include "files/io/cloud.hpp"
#include "files/io/compress_lzf.hpp"
#include "files/io/npy.hpp"
#include "files/io/pcd.hpp"
#include "files/io/ply.hpp"
#include "files/ros/messages.hpp"
#include "library/ground_map/state_bytes.hpp"

namespace {

namespace fs = std::filesystem;
using namespace flagstone::io;

class SeedFolder {
 public:
  explicit SeedFolder(fs::path root) : root_(std::move(root)) {}

  void add(std::string_view fuzzer, std::string_view name, const Bytes& bytes) {
    const fs::path folder = root_ / fuzzer;
    fs::create_directories(folder);
    const flagstone::Status status = write_file(folder / name, bytes);
    if (status.ok()) return;
    std::fprintf(stderr, "%s\n", status.message().c_str());
    failed_ = true;
  }

  [[nodiscard]] bool failed() const { return failed_; }

 private:
  fs::path root_;
  bool failed_ = false;
};

/// Three points with one field of every type, a field of several numbers, and padding.
Cloud varied_cloud() {
  using enum FieldType;
  std::vector<Field> fields{
      {"x", float32},    {"y", float32},         {"z", float32},   {"_", uint8, 4}, {"a", int8},
      {"b", uint8},      {"c", int16},           {"d", uint16},    {"e", int32},    {"f", uint32},
      {"time", float64}, {"normal", float32, 3}, {"wide", uint64}, {"deep", int64}};
  Bytes rows;
  std::size_t stride = 0;
  for (const Field& field : fields) stride += field.size();
  const std::size_t small =
      stride - 2 * sizeof(std::uint64_t);  // keeps 64-bit integers small enough for PLY
  for (std::size_t i = 0; i < 3 * stride; ++i) {
    rows.push_back(static_cast<std::byte>(i % 7 == 0 && i % stride < small));
  }
  Cloud cloud;
  if (!Cloud::from_rows(fields, rows, cloud).ok()) std::fprintf(stderr, "no varied cloud\n");
  return cloud;
}

/// x, y and z of a type that must be converted.
Cloud converted_cloud(FieldType type) {
  Cloud cloud;
  const std::vector<Field> fields{{"z", type}, {"x", type}, {"y", type}};
  if (!Cloud::from_rows(fields, Bytes(6 * size_of(type)), cloud).ok()) {
    std::fprintf(stderr, "no converted cloud\n");
  }
  return cloud;
}

void add_pcd(SeedFolder& seeds, const Cloud& varied) {
  Bytes file;
  if (write_pcd(varied, file).ok()) seeds.add("pcd", "varied", file);
  if (write_pcd(converted_cloud(FieldType::int8), file).ok()) seeds.add("pcd", "bytes", file);
  if (write_pcd(converted_cloud(FieldType::float64), file).ok()) seeds.add("pcd", "doubles", file);
  seeds.add(
      "pcd", "ascii",
      bytes_of("# .PCD v.7\nVERSION .7\nFIELDS x y z rgb n\nSIZE 4 4 4 4 8\nTYPE F F F U F\n"
               "COUNT 1 1 1 1 2\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n"
               "1 2.5 -3e1 255 0 0\nnan inf -inf 0 1e-9 +7\n"));
  const Bytes columns(2000, std::byte{7});
  const Bytes stream = compress_lzf(columns);
  seeds.add("pcd", "compressed",
            joined({bytes_of("VERSION 0.7\nFIELDS x y z i s\nSIZE 4 4 4 4 4\nTYPE F F F U I\n"
                             "WIDTH 100\nHEIGHT 1\nPOINTS 100\nDATA binary_compressed\n"),
                    numbers({static_cast<std::uint32_t>(stream.size()),
                             static_cast<std::uint32_t>(columns.size())}),
                    stream}));
  seeds.add("lzf", "run", stream);
  seeds.add("lzf", "text", compress_lzf(bytes_of("abcabcabcabcxyzabcabcxyz0123456789abc")));
}

void add_ply(SeedFolder& seeds, const Cloud& varied) {
  Bytes file;
  if (write_ply(varied, file).ok()) seeds.add("ply", "varied", file);
  if (write_ply(converted_cloud(FieldType::uint16), file).ok()) seeds.add("ply", "shorts", file);
  constexpr std::string_view elements =
      "comment seed\nelement camera 1\nproperty float f\nproperty list uchar short tags\n"
      "element vertex 2\nproperty float x\nproperty double y\nproperty int z\nproperty uchar red\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  seeds.add("ply", "ascii",
            joined({bytes_of("ply\nformat ascii 1.0\n"), bytes_of(elements),
                    bytes_of("0.5 2 1 2\n1 2 3 4\nnan -inf -7 255\n3 0 1 1\n")}));
  const Bytes after =
      joined({numbers({0.5F}), numbers<std::uint8_t>({2}), Bytes(4), Bytes(34), Bytes(5)});
  seeds.add(
      "ply", "little",
      joined({bytes_of("ply\nformat binary_little_endian 1.0\n"), bytes_of(elements), after}));
  seeds.add("ply", "big",
            joined({bytes_of("ply\nformat binary_big_endian 1.0\n"), bytes_of(elements), after}));
}

Bytes npy_file(std::string_view dictionary, std::size_t items, char version = 1) {
  const std::string text = std::string(dictionary) + "\n";
  const auto length = static_cast<std::uint16_t>(text.size());
  return joined({bytes_of("\x93NUMPY"), numbers({version}), Bytes(1), numbers({length}),
                 version == 1 ? Bytes() : Bytes(2), bytes_of(text), Bytes(items)});
}

void add_npy(SeedFolder& seeds, const Cloud& varied) {
  Bytes file;
  if (write_npy(varied, file).ok()) seeds.add("npy", "varied", file);
  seeds.add("npy", "plain",
            npy_file("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 4), }", 32));
  seeds.add("npy", "columns",
            npy_file("{'descr': '>f8', 'fortran_order': True, 'shape': (2, 3), }", 48, 2));
  seeds.add(
      "npy", "records",
      npy_file("{'descr': [('x', '<f4'), ('y', '>f4'), ('z', '<i2'), ('', '|V2'), ('n', '<u2', "
               "(2, 2))], 'fortran_order': False, 'shape': (1,), }",
               20, 3));
}

void add_raw(SeedFolder& seeds) {
  seeds.add("raw", "kitti", joined({Bytes{std::byte{4}, std::byte{0}}, Bytes(32)}));
  seeds.add("raw", "nuscenes", joined({Bytes{std::byte{5}, std::byte{0}}, Bytes(40)}));
}

void add_labels(SeedFolder& seeds) {
  const Bytes ten_points{std::byte{10}, std::byte{0}};
  seeds.add("labels", "kitti", joined({Bytes(1, std::byte{0}), ten_points, Bytes(40)}));
  seeds.add("labels", "lidarseg", joined({Bytes(1, std::byte{1}), ten_points, Bytes(10)}));
  seeds.add("labels", "npy",
            joined({Bytes(1, std::byte{2}), ten_points,
                    npy_file("{'descr': '>i4', 'fortran_order': False, 'shape': (10,), }", 40)}));
}

/// Messages in every encoding. The first byte selects the encoding and the type of the message.
void add_messages(SeedFolder& seeds) {
  using namespace flagstone::ros;
  using enum PointFieldType;
  for (const MessageFormat& format : all_formats) {
    const bool is_ros1 = format.encoding == Encoding::ros1;
    const std::string suffix = is_ros1 ? "_ros1" : format.big_endian ? "_big" : "_little";
    const auto choice = static_cast<std::byte>(is_ros1 ? 1 : 0);
    CloudMessage message = small_message(format);
    seeds.add("point_cloud2", "small" + suffix, joined({Bytes{choice}, message.bytes()}));
    message.height = 2;
    message.width = 1;
    message.row_step = 24;
    message.data.resize(48);
    message.is_bigendian = true;
    message.fields = {{"z", 0, int16, 1},   {"y", 2, float64, 1},    {"x", 10, uint8, 1},
                      {"rgb", 0, uint8, 3}, {"label", 17, uint8, 0}, {"height", 14, uint16, 1}};
    seeds.add("point_cloud2", "rows" + suffix, joined({Bytes{choice}, message.bytes()}));
    message.point_step = 24;
    message.fields = {{"x", 0, int64, 1},
                      {"y", 8, uint64, 1},
                      {"z", 16, int32, 1},
                      {"label", 20, boolean, 1},
                      {"later", 21, static_cast<PointFieldType>(12), 1}};
    seeds.add("point_cloud2", "types" + suffix, joined({Bytes{choice}, message.bytes()}));
    seeds.add("point_cloud2", "livox" + suffix,
              joined({Bytes{choice | std::byte{2}}, livox_message(format, 3)}));
  }
}

/// The states of a map with one tile, of votes and of moving points, without their checksums, which
/// the fuzzer adds.
void add_map_states(SeedFolder& seeds) {
  Bytes map;
  flagstone::StateWriter writer(map);
  writer.start("fsgmap01");
  for (const double number : {0.5, 1.7}) writer.add(number);       // cell, base
  for (const std::uint64_t number : {3U, 1U}) writer.add(number);  // scans, tiles
  for (const std::int64_t index : {-1, 2}) writer.add(index);
  writer.add(std::uint64_t{1} << 9U);  // one cell
  for (int word = 1; word < 64; ++word) writer.add(std::uint64_t{0});
  for (int height = 0; height < 2; ++height) {
    for (const float number : {-1.7F, 900.0F, 0.5F}) writer.add(number);
    writer.add(std::uint16_t{2});
  }
  writer.add(std::uint32_t{3});
  seeds.add("map_state", "map", map);

  Bytes votes;
  flagstone::StateWriter voxels(votes);
  voxels.start("fsvote01");
  for (const double number : {0.25, 0.06}) voxels.add(number);
  voxels.add(std::uint64_t{1});
  for (const std::int64_t index : {-1, 2}) voxels.add(index);
  voxels.add(std::uint64_t{2});
  for (const std::int32_t number : {5, -2048, 1 << 20, 7}) voxels.add(number);
  seeds.add("map_state", "votes", votes);

  Bytes moving;
  flagstone::StateWriter scans(moving);
  scans.start("fsmove01");
  scans.add(57.3F);  // rows per radian
  for (const double position : {0.0, 0.0}) scans.add(position);
  scans.add(std::uint64_t{1});  // scans
  scans.add(2.5);               // time
  for (const double number : {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1, 7, 2, 0}) {
    scans.add(number);
  }
  for (const std::int32_t number : {-3, 1}) scans.add(number);  // first row, rows
  scans.add(std::uint64_t{1} << 7U);                            // one pixel
  for (int word = 1; word < 17; ++word) scans.add(std::uint64_t{0});
  for (const std::uint16_t number : std::array<std::uint16_t, 4>{900, 200, 1000, 1100}) {
    scans.add(number);
  }
  scans.add(std::uint64_t{1});  // tiles of columns
  for (const std::int64_t index : {-1, 2}) scans.add(index);
  scans.add(std::uint64_t{1} << 9U);  // one column
  for (int word = 1; word < 64; ++word) scans.add(std::uint64_t{0});
  for (const std::uint16_t number : std::array<std::uint16_t, 2>{1, 4}) scans.add(number);
  seeds.add("map_state", "moving", moving);
}

/// A few hundred ground points, as input for the fuzzer of segmenters, for the settings of each
/// method.
void add_segment(SeedFolder& seeds) {
  Bytes places;
  for (int i = 0; i < 300; ++i) {
    for (const int number : {3000 + 7 * (i % 20), 400 + 9 * (i / 20), -9450 + i * 37 % 60}) {
      places = joined({places, numbers({static_cast<std::int16_t>(number)})});
    }
  }
  const Bytes odd =
      numbers<float>({5, 5, -1.7F, 1e20F, 0, 0, 0, 0, 0, 3e38F, 6, -1.7F, 6, 2, -9999});
  for (std::uint8_t settings = 0; settings < 25; ++settings) {
    const auto choice = std::byte{settings};
    seeds.add("segment", "ground" + std::to_string(settings),
              joined({Bytes{choice, choice, std::byte{1}}, places}));
    seeds.add("segment", "odd" + std::to_string(settings),
              joined({Bytes{choice, choice, std::byte{0}}, odd}));
  }
}

/// A text after the byte that selects its kind.
Bytes chosen(std::uint8_t choice, std::string_view text) {
  return joined({Bytes{std::byte{choice}}, bytes_of(text)});
}

void add_texts(SeedFolder& seeds) {
  for (std::uint8_t method = 0; method < 11; ++method) {
    seeds.add("config", "height" + std::to_string(method),
              chosen(method, "sensor_height = 1.5\nmax_range = 40\nnoise_depth = inf\n"));
  }
  for (std::uint8_t method = 0; method < 11; ++method) {
    seeds.add("config", "zones" + std::to_string(method),
              chosen(method,
                     "seed_count = 5\n[elevation]\nenabled = false\n[flatness]\nthresholds = "
                     "[0.001, 0.01]\n[[zones]]\nring_radii = [5, 10]\nsectors = 8\n"
                     "height_margin = -inf\n"));
    seeds.add("config", "surface" + std::to_string(method),
              chosen(method, "[refinement]\nlevels = 2\ngate = 0.5\n[point]\nmargin = 0.1\n"));
  }
  seeds.add("protocol", "toml",
            chosen(0,
                   "name = \"mine\"\nground = [40, 44]\nignored = [0, 1]\nnot_ground = [10]\n"
                   "low_ground = [{id = 70, height = -1.3}]\n"));
  seeds.add("protocol", "json",
            chosen(1, R"({"name": "mine", "ground": [40, 44], "ignored": [0], "not_ground": [10],)"
                      R"( "low_ground": [{"id": 70, "height": -1.3}], "note": "seed"})"));
  seeds.add("sensor", "even",
            bytes_of("beams = 16\nelevation_top = 15.0\nelevation_bottom = -15.0\nheight = 0.6\n"));
  seeds.add("sensor", "listed",
            bytes_of("name = \"mine\"\nbeams = 3\nelevations = [2, 0, -10.5]\nheight = 1.5\n"
                     "azimuth_begin = -60\nazimuth_end = 60\nmin_range = 0.5\nmax_range = 90\n"));
  seeds.add("poses", "kitti",
            bytes_of("1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 0\n"
                     "nan nan nan nan nan nan nan nan nan nan nan nan\n"));
  seeds.add("poses", "tum",
            bytes_of("# time x y z qx qy qz qw\n0 0 0 0 0 0 0 1\n0.1 1 0 0 0 0 0.1 0.995\n"
                     "0.2 9 0 0 0 0 0.2 0.98\n0.3 3 0 0 0 0 0.3 0.954\n"));
  seeds.add(
      "poses", "csv",
      bytes_of("time [ns],x,y,z,roll,pitch,yaw [deg]\n0,0,0,0,0,0,0\n100000000,1,0,0,,0,1\n"));
  seeds.add("poses", "odometry",
            bytes_of("#sec,nsec,pose.position.x,pose.position.y,pose.position.z,orientation.x,"
                     "orientation.y,orientation.z,orientation.w\n1,0,0,0,0,0,0,0,1\n"));
  seeds.add("poses", "calibration", bytes_of("P0: 1 0\nTr: 0 -1 0 0 0 0 -1 0 1 0 0 -0.3\n"));
  seeds.add("poses", "times", bytes_of("0.0\n0.1\n"));
  const std::string counts = "[1,2,3,4]";
  std::string method = R"({"points":)" + counts + R"(,"area":)" + counts + R"(,"range":[)";
  for (int band = 0; band < 6; ++band) method += counts + (band < 5 ? "," : "");
  method += R"(],"ms":1.5})";
  seeds.add("checkpoint", "scan",
            chosen(1, R"({"scan":"a","read":1.0,"score":2.0,"methods":[)" + method + "]}\n"));
  seeds.add("checkpoint", "whole", chosen(129, "{\"flagstone-checkpoint\":\"fuzzed\"}\n"));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_seeds DIR\n");
    return 2;
  }
  SeedFolder seeds(argv[1]);
  const Cloud varied = varied_cloud();
  add_pcd(seeds, varied);
  add_ply(seeds, varied);
  add_npy(seeds, varied);
  add_raw(seeds);
  add_labels(seeds);
  add_messages(seeds);
  add_map_states(seeds);
  add_segment(seeds);
  add_texts(seeds);
  return seeds.failed() ? 1 : 0;
}
