// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/simulated_sequence.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "app/evaluate.hpp"
#include "files/io/atomic_file.hpp"
#include "files/io/cloud.hpp"
#include "files/io/label_files.hpp"
#include "files/io/load_bytes.hpp"
#include "files/io/npy.hpp"
#include "files/io/write_cloud.hpp"
#include "flagstone/version.hpp"
#include "lab/sim/drive.hpp"
#include "lab/sim/measurement.hpp"
#include "lab/sim/mesh.hpp"

namespace flagstone::app {
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view remedy =
    "choose another --output or --sequence, or remove the directory";

void must(const Status& status) {
  if (!status.ok()) throw std::runtime_error(status.message());
}

Json sensor_json(const Sensor& sensor) {
  Json json = {{"name", sensor.name},
               {"title", sensor.title},
               {"elevations", sensor.elevations},
               {"firings", sensor.firings},
               {"azimuth_begin", sensor.azimuth_begin},
               {"azimuth_end", sensor.azimuth_end},
               {"min_range", sensor.min_range},
               {"max_range", sensor.max_range},
               {"range_sigma", sensor.range_sigma},
               {"height", sensor.height}};
  if (sensor.draws_rosette()) json["rosette"] = sensor.rosette;
  return json;
}

Json noise_json(const SequenceOrigin& origin) {
  const sim::Noise& noise = origin.noise;
  return {{"name", origin.noise_name},
          {"range_sigma_scale", noise.range_sigma_scale},
          {"drop_rate", noise.drop_rate},
          {"half_detection", noise.half_detection},
          {"ghost_rate", noise.ghost_rate},
          {"ghost_max_range", noise.ghost_max_range},
          {"intensity_sigma", noise.intensity_sigma},
          {"mirroring", noise.mirroring},
          {"wetness", noise.wetness},
          {"mixed_rate", noise.mixed_rate},
          {"beam_width", noise.beam_width},
          {"rain_rate", noise.rain_rate},
          {"rain_extinction", noise.rain_extinction},
          {"dust_clouds", noise.dust_clouds},
          {"dust_extinction", noise.dust_extinction},
          {"crosstalk_rate", noise.crosstalk_rate},
          {"block_loss_rate", noise.block_loss_rate}};
}

// Everything that determines the bytes of a frame.
Json origin_json(const SequenceOrigin& origin) {
  const sim::Mounting& mount = origin.mounting;
  return {{"scene", origin.scene},
          {"seed", origin.seed},
          {"version", FLAGSTONE_VERSION},
          {"mount", {{"height", mount.height}, {"pitch", mount.pitch}, {"roll", mount.roll}}},
          {"noise", noise_json(origin)},
          {"weather", origin.weather},
          {"no_returns_kept", origin.keep_no_returns},
          {"rate", origin.pace.rate},
          {"speed", origin.pace.speed},
          {"length", origin.extent.length()},
          {"loop", origin.extent.closed},
          {"distortion", origin.pace.distortion},
          {"pose_noise", origin.pose_noise},
          {"sensor", sensor_json(origin.sensor)}};
}

// The meaning of the codes in label files.
Json class_json() {
  Json classes = {{"0", "unlabeled"}};
  for (int code = 1; code <= static_cast<int>(sim::SemanticClass::moving_other_vehicle); ++code) {
    const auto name = sim::name_of(static_cast<sim::SemanticClass>(code));
    if (!name.empty()) classes[std::to_string(code)] = name;
  }
  return classes;
}

// The meaning of the codes in files of returns and motions.
Json codes_json(std::span<const std::string_view> names) {
  Json codes = Json::object();
  for (std::size_t code = 0; code < names.size(); ++code) codes[std::to_string(code)] = names[code];
  return codes;
}

// A uint8 array.
template <class Code>
std::string codes_text(std::span<const Code> codes) {
  std::string text = io::npy_header(io::FieldType::uint8, codes.size());
  for (const Code code : codes) text += static_cast<char>(code);
  return text;
}

std::string scene_text(const SequenceOrigin& origin) {
  Json scene = origin_json(origin);
  scene["frames"] = origin.frames;
  Json drives = Json::array();
  const std::size_t per_drive = origin.pace.frames(origin.extent);
  for (std::size_t first = 0; first < origin.frames; first += per_drive) {
    drives.push_back(
        {{"first_frame", first}, {"world_seed", sim::drive_seed(origin.seed, first / per_drive)}});
  }
  scene["drives"] = drives;
  scene["files"] = {{"scans", "velodyne/NNNNNN.bin"},
                    {"labels", "labels/NNNNNN.label"},
                    {"ground", "ground/NNNNNN.ground.npy"},
                    {"returns", "returns/NNNNNN.return.npy"},
                    {"motion", "motion/NNNNNN.motion.npy"},
                    {"poses", "poses.txt"},
                    {"scan_times", "times.txt"}};
  if (origin.pose_noise != "none") scene["files"]["measured_poses"] = "poses_measured.txt";
  if (origin.pace.distortion) scene["files"]["times"] = "times/NNNNNN.time.npy";
  scene["classes"] = class_json();
  scene["return_kinds"] = codes_json(sim::echo_kind_names);
  scene["motions"] = codes_json(sim::motion_names);
  return scene.dump(1) + '\n';
}

// Readers of KITTI expect the cameras too. Here all frames are the sensor frame.
std::string calibration_text() {
  std::string text;
  for (const char* name : {"P0", "P1", "P2", "P3", "Tr"}) {
    text += fmt::format("{}: 1 0 0 0 0 1 0 0 0 0 1 0\n", name);
  }
  return text;
}

// The size of a regular file, 0 if there is none.
std::uintmax_t size_of(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  return error ? 0 : size;
}

}  // namespace

fs::path SimulatedSequence::scan_file(std::size_t frame) const {
  return folder_ / "velodyne" / fmt::format("{:06}.bin", frame);
}

fs::path SimulatedSequence::label_file(std::size_t frame) const {
  return folder_ / "labels" / fmt::format("{:06}.label", frame);
}

fs::path SimulatedSequence::ground_file(std::size_t frame) const {
  return folder_ / "ground" / fmt::format("{:06}.ground.npy", frame);
}

void SimulatedSequence::refuse_others(const SequenceOrigin& origin) const {
  const fs::path file = folder_ / "scene.json";
  std::error_code error;
  if (!fs::exists(file, error)) {
    // These may be real scans, which must not be mixed with simulated ones.
    if (!fs::exists(folder_, error) || fs::is_empty(folder_, error)) return;
    throw std::invalid_argument(fmt::format(
        "{}: contains files that are not a simulated sequence ({})", folder_.string(), remedy));
  }
  std::vector<std::byte> bytes;
  must(io::load_bytes(file, bytes));
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  const Json there = Json::parse(text, text + bytes.size(), nullptr, false);
  const Json wanted = origin_json(origin);
  for (const auto& [key, value] : wanted.items()) {
    if (there.is_object() && there.contains(key) && there[key] == value) continue;
    throw std::invalid_argument(fmt::format("{}: its {} differs from the one you requested ({})",
                                            file.string(), key, remedy));
  }
  const std::uint64_t frames = there.contains("frames") && there["frames"].is_number_unsigned()
                                   ? there["frames"].get<std::uint64_t>()
                                   : 0;
  if (frames > origin.frames) {
    throw std::invalid_argument(
        fmt::format("{}: has {} frames, more than --frames {} (set --frames {} or more, {})",
                    file.string(), frames, origin.frames, frames, remedy));
  }
}

void SimulatedSequence::begin(const SequenceOrigin& origin) const {
  refuse_others(origin);
  make_folder(folder_);
  // Written first: it marks the directory as a simulated sequence, even if this run is interrupted.
  must(io::write_file(folder_ / "scene.json", scene_text(origin)));
  must(io::write_file(folder_ / "calib.txt", calibration_text()));
  make_folder(folder_ / "velodyne");
  make_folder(folder_ / "labels");
  make_folder(folder_ / "ground");
  make_folder(folder_ / "returns");
  make_folder(folder_ / "motion");
  if (timed_) make_folder(folder_ / "times");
}

fs::path SimulatedSequence::return_file(std::size_t frame) const {
  return folder_ / "returns" / fmt::format("{:06}.return.npy", frame);
}

fs::path SimulatedSequence::motion_file(std::size_t frame) const {
  return folder_ / "motion" / fmt::format("{:06}.motion.npy", frame);
}

fs::path SimulatedSequence::time_file(std::size_t frame) const {
  return folder_ / "times" / fmt::format("{:06}.time.npy", frame);
}

bool SimulatedSequence::has(std::size_t frame) const {
  constexpr std::uintmax_t scan_bytes = 4 * sizeof(float);
  const std::uintmax_t scan = size_of(scan_file(frame));
  const std::uintmax_t points = scan / scan_bytes;
  const std::uintmax_t code_bytes = io::npy_header(io::FieldType::uint8, points).size() + points;
  return scan > 0 && scan % scan_bytes == 0 &&
         size_of(label_file(frame)) == points * sizeof(std::uint32_t) &&
         size_of(ground_file(frame)) == io::height_file_size(points) &&
         size_of(return_file(frame)) == code_bytes && size_of(motion_file(frame)) == code_bytes &&
         (!timed_ || size_of(time_file(frame)) == io::height_file_size(points));
}

void SimulatedSequence::write(std::size_t frame, const sim::SimulatedScan& scan,
                              std::span<const float> ground, std::span<const float> times) const {
  io::Cloud cloud;
  must(io::Cloud::from_floats(scan.xyzi, 4, cloud));
  must(io::write_cloud(scan_file(frame), cloud));
  must(io::write_class_file(label_file(frame), scan.classes));
  must(io::write_npy_file(ground_file(frame), ground, std::array{ground.size()}));
  must(io::write_file(return_file(frame), codes_text<sim::EchoKind>(scan.echoes)));
  must(io::write_file(motion_file(frame), codes_text<sim::Motion>(scan.motions)));
  if (timed_) must(io::write_npy_file(time_file(frame), times, std::array{times.size()}));
}

void SimulatedSequence::write_poses(const char* name, std::span<const sim::Frame> poses) const {
  std::string text;
  for (const sim::Frame& pose : poses) {
    const auto& [o, f, l, u] = pose;
    text += fmt::format("{:.9g} {:.9g} {:.9g} {:.9g} ", f.x, l.x, u.x, o.x);
    text += fmt::format("{:.9g} {:.9g} {:.9g} {:.9g} ", f.y, l.y, u.y, o.y);
    text += fmt::format("{:.9g} {:.9g} {:.9g} {:.9g}\n", f.z, l.z, u.z, o.z);
  }
  must(io::write_file(folder_ / name, text));
}

void SimulatedSequence::write_times(std::size_t frames, double rate) const {
  std::string text;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    text += fmt::format("{:.6f}\n", static_cast<double>(frame) / rate);
  }
  must(io::write_file(folder_ / "times.txt", text));
}

}  // namespace flagstone::app
