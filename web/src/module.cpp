// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// The functions that the WebAssembly module exports. web/api/flagstone.ts is their only caller.
//
// A function that can fail returns null or false and leaves the error message in the text.
// JavaScript passes text as UTF-8 in memory from flagstone_text_buffer(), and reads text from
// there.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "app/config/method_choice.hpp"
#include "app/config/settings_json.hpp"
#include "app/doctor_report.hpp"
#include "files/io/label_files.hpp"
#include "files/io/read_cloud.hpp"
#include "files/io/write_cloud.hpp"
#include "flagstone/version.hpp"
#include "lab/eval/method_runner.hpp"
#include "memory_files.hpp"

#define FLAGSTONE_EXPORT(name) __attribute__((export_name(#name)))

namespace flagstone::web {

/// A scan read from a file or made of points.
struct Scan {
  io::Cloud cloud;
  std::vector<float> positions;  // x, y, z; empty until they are requested
};

/// A method with its settings, and the memory that it reuses.
struct Method {
  explicit Method(config::ResolvedMethod chosen)
      : resolved(std::move(chosen)), runner(resolved.config, resolved.mount) {}

  config::ResolvedMethod resolved;
  eval::MethodRunner runner;
  Segmentation result;
};

namespace {

using Json = nlohmann::ordered_json;

/// Arguments from JavaScript, and results and error messages for it.
std::string text;

/// Calls `work`. If it throws, the text is the message and the result is a default value.
template <class Work>
auto guarded(const Work& work) noexcept -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    text = "out of memory";
  } catch (const std::exception& error) {
    text = error.what();
  }
  return {};
}

void check(const Status& status) {
  if (status.ok()) return;
  throw std::runtime_error(!status.message().empty()                    ? status.message()
                           : status.code() == StatusCode::out_of_memory ? "out of memory"
                                                                        : "unknown error");
}

config::Value value_of(const Json& json, const std::string& key) {
  if (json.is_boolean()) return {.held = json.get<bool>()};
  if (json.is_number_integer()) return {.held = json.get<std::int64_t>()};
  if (json.is_number()) return {.held = json.get<double>()};
  if (json.is_string()) return {.held = json.get<std::string>()};
  if (json.is_array()) {
    config::Value::List list;
    for (const Json& element : json) list.push_back(value_of(element, key));
    return {.held = std::move(list)};
  }
  if (json.is_object()) {
    config::Value::Table table;
    for (const auto& [name, value] : json.items()) {
      table.push_back({name, value_of(value, key.empty() ? name : key + "." + name)});
    }
    return {.held = std::move(table)};
  }
  throw std::invalid_argument(key +
                              ": null is not a type of settings (expected a number, boolean, "
                              "string, list or object)");
}

std::string string_at(const Json& options, const char* key, const std::string& otherwise) {
  const auto found = options.find(key);
  if (found == options.end()) return otherwise;
  if (!found->is_string()) {
    throw std::invalid_argument(std::string(key) + " must be a string, got " + found->dump());
  }
  return found->get<std::string>();
}

/// The mounting pose of the options `sensor_height` and `tilt`.
config::MountChoice mount_of(const Json& options) {
  config::MountChoice mount;
  const auto read = [&](const char* key, const auto& set) {
    const auto found = options.find(key);
    if (found == options.end()) return;
    try {
      set(*found);
    } catch (const std::exception& error) {
      throw std::invalid_argument(std::string(key) + ": " + error.what());
    }
  };
  const auto text_of = [](const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
  };
  read("sensor_height", [&](const Json& value) {
    if (value.is_number()) return mount.set_height(value.get<float>());
    mount.set_height(std::string_view(text_of(value)));
  });
  read("tilt", [&](const Json& value) {
    if (value.is_array() && value.size() == 3) {
      return mount.set_tilt(value.get<std::array<float, 3>>());
    }
    mount.set_tilt(std::string_view(text_of(value)));
  });
  return mount;
}

/// The method of a JSON object: `method`, `preset`, `sensor`, `sensor_height`, `tilt`, `config`
/// (TOML), and settings of the method.
config::ResolvedMethod method_of(const std::string& json) {
  Json options = Json::parse(json);
  config::MethodChoice choice;
  choice.methods = {string_at(options, "method", "surface")};
  choice.preset = string_at(options, "preset", "default");
  choice.sensor = string_at(options, "sensor", "");
  choice.mount = mount_of(options);
  choice.option_prefix = "";
  if (const std::string toml = string_at(options, "config", ""); !toml.empty()) {
    choice.config_file = "config";
    const auto bytes = std::as_bytes(std::span(toml));
    std::ranges::copy(bytes, add_file(choice.config_file, bytes.size()).begin());
  }
  for (const char* key : {"method", "preset", "sensor", "sensor_height", "tilt", "config"}) {
    options.erase(key);
  }
  choice.settings = {{.table = value_of(options, "")}};
  return config::resolve_one(choice);
}

}  // namespace

FLAGSTONE_EXPORT(flagstone_text_buffer) char* text_buffer(std::size_t size) noexcept {
  return guarded([&] {
    text.resize(size);
    return text.data();
  });
}

FLAGSTONE_EXPORT(flagstone_text_size) std::size_t text_size() noexcept { return text.size(); }

FLAGSTONE_EXPORT(flagstone_text) const char* text_data() noexcept { return text.data(); }

/// Makes the version the text.
FLAGSTONE_EXPORT(flagstone_version) bool version() noexcept {
  return guarded([] {
    text = FLAGSTONE_VERSION;
    return true;
  });
}

/// Adds a file named by the text. Returns its bytes to fill.
FLAGSTONE_EXPORT(flagstone_file_new) std::byte* file_new(std::size_t size) noexcept {
  return guarded([&] {
    remove_files();
    // An empty file has no bytes, but null means an error.
    static std::byte nothing;
    const std::span<std::byte> bytes = add_file(text, size);
    return size == 0 ? &nothing : bytes.data();
  });
}

/// The file written last.
FLAGSTONE_EXPORT(flagstone_written) const std::byte* written() noexcept {
  return written_file().data();
}

FLAGSTONE_EXPORT(flagstone_written_size) std::size_t written_size() noexcept {
  return written_file().size();
}

/// Reads the scan named by the text from the file added last.
FLAGSTONE_EXPORT(flagstone_scan_read) Scan* scan_read(int columns) noexcept {
  return guarded([&] {
    auto scan = std::make_unique<Scan>();
    io::CloudReader reader({.columns = columns});
    const Status status = reader.read(text);
    remove_files();
    check(status);
    scan->cloud = reader.release();
    return scan.release();
  });
}

FLAGSTONE_EXPORT(flagstone_scan_delete) void scan_delete(Scan* scan) noexcept { delete scan; }

FLAGSTONE_EXPORT(flagstone_scan_size) std::size_t scan_size(const Scan* scan) noexcept {
  return scan->cloud.size();
}

FLAGSTONE_EXPORT(flagstone_scan_stride) std::size_t scan_stride(const Scan* scan) noexcept {
  return scan->cloud.stride();
}

FLAGSTONE_EXPORT(flagstone_scan_rows) const std::byte* scan_rows(const Scan* scan) noexcept {
  return scan->cloud.bytes().data();
}

/// Makes the fields of a scan, as JSON, the text.
FLAGSTONE_EXPORT(flagstone_scan_fields) bool scan_fields(const Scan* scan) noexcept {
  return guarded([&] {
    Json fields = Json::array();
    for (const io::Field& field : scan->cloud.fields()) {
      fields.push_back({{"name", field.name},
                        {"type", io::to_string(field.type)},
                        {"count", field.count},
                        {"offset", field.offset}});
    }
    text = fields.dump();
    return true;
  });
}

/// x, y and z of every point: a view of the rows if they contain nothing else, otherwise a copy.
FLAGSTONE_EXPORT(flagstone_scan_positions) const float* scan_positions(Scan* scan) noexcept {
  return guarded([&]() -> const float* {
    static const float nothing = 0;
    const CloudView view = scan->cloud.view();
    if (view.empty()) return &nothing;
    const CloudLayout packed = CloudView(static_cast<const float*>(nullptr), 0, 3).layout();
    if (view.layout().stride == packed.stride && view.layout().y - view.layout().x == packed.y &&
        view.layout().z - view.layout().x == packed.z) {
      return reinterpret_cast<const float*>(static_cast<const std::byte*>(view.data()) +
                                            view.layout().x);
    }
    if (scan->positions.empty()) {
      std::vector<float> positions(view.size() * 3);
      for (std::size_t i = 0; i < view.size(); ++i) {
        const Point point = view[i];
        positions[3 * i] = point.x;
        positions[3 * i + 1] = point.y;
        positions[3 * i + 2] = point.z;
      }
      scan->positions = std::move(positions);
    }
    return scan->positions.data();
  });
}

/// Creates the method that the text describes; see method_of().
FLAGSTONE_EXPORT(flagstone_method_new) Method* method_new() noexcept {
  return guarded([] { return std::make_unique<Method>(method_of(text)).release(); });
}

FLAGSTONE_EXPORT(flagstone_method_delete) void method_delete(Method* method) noexcept {
  delete method;
}

FLAGSTONE_EXPORT(flagstone_method_reset) void method_reset(Method* method) noexcept {
  method->runner.reset();
}

/// Makes all settings of the method, as JSON, the text.
FLAGSTONE_EXPORT(flagstone_method_settings) bool method_settings(const Method* method) noexcept {
  return guarded([&] {
    text = config::to_json(method->resolved);
    return true;
  });
}

/// Segments a scan. The functions below read the result, until the next call with this method.
FLAGSTONE_EXPORT(flagstone_segment) bool segment(Method* method, const Scan* scan) noexcept {
  return guarded([&] {
    method->runner.prepare(scan->cloud);
    check(method->runner.segment(scan->cloud, method->result));
    return true;
  });
}

/// Makes the mounting pose used for the last scan, and the decision about it, the text.
FLAGSTONE_EXPORT(flagstone_mount) bool mount(const Method* method) noexcept {
  return guarded([&] {
    const GravityAlignedSegmenter& levelled = method->runner.levelled();
    const Mount& mount = levelled.mount();
    text = Json{{"sensor_height", mount.sensor_height},
                {"up", mount.up},
                {"origin", mount.origin},
                {"scale", mount.scale},
                {"decision", to_sentence(levelled.decision())},
                {"accepted", levelled.decision().accepted()}}
               .dump();
    return true;
  });
}

FLAGSTONE_EXPORT(flagstone_labels) const Label* labels(const Method* method) noexcept {
  return method->result.labels().data();
}

FLAGSTONE_EXPORT(flagstone_label_count)
std::size_t labels_with(const Method* method, unsigned code) noexcept {
  return method->result.count(static_cast<Label>(code));
}

FLAGSTONE_EXPORT(flagstone_heights) const float* heights(const Method* method) noexcept {
  return method->result.heights().data();
}

FLAGSTONE_EXPORT(flagstone_height_count) std::size_t height_count(const Method* method) noexcept {
  return method->result.heights().size();
}

FLAGSTONE_EXPORT(flagstone_patches) const Patch* patches(const Method* method) noexcept {
  return method->result.patches().data();
}

FLAGSTONE_EXPORT(flagstone_patch_count) std::size_t patch_count(const Method* method) noexcept {
  return method->result.patches().size();
}

// flagstone.ts reads patches from memory at these offsets.
static_assert(sizeof(Patch) == 80 && offsetof(Patch, verdict) == 6 &&
              offsetof(Patch, point_count) == 8 && offsetof(Patch, mean) == 20 &&
              offsetof(Patch, normal) == 32 && offsetof(Patch, d) == 44 &&
              offsetof(Patch, eigenvalues) == 48 && offsetof(Patch, uprightness) == 60);

FLAGSTONE_EXPORT(flagstone_grid_count) std::size_t grid_count(const Method* method) noexcept {
  return method->result.surface().grids().size();
}

FLAGSTONE_EXPORT(flagstone_grid_cell)
float grid_cell(const Method* method, std::size_t index) noexcept {
  return method->result.surface().grids()[index].cell;
}

FLAGSTONE_EXPORT(flagstone_grid_width)
std::size_t grid_width(const Method* method, std::size_t index) noexcept {
  return method->result.surface().grids()[index].width;
}

FLAGSTONE_EXPORT(flagstone_grid_heights)
const float* grid_heights(const Method* method, std::size_t index) noexcept {
  return method->result.surface().grids()[index].heights.data();
}

FLAGSTONE_EXPORT(flagstone_grid_confidences)
const float* grid_confidences(const Method* method, std::size_t index) noexcept {
  return method->result.surface().grids()[index].confidences.data();
}

/// The ground at (x, y): height, normal, slope and confidence, six numbers.
FLAGSTONE_EXPORT(flagstone_surface_at)
const float* surface_at(const Method* method, float x, float y) noexcept {
  static std::array<float, 6> numbers;
  const GroundSample ground = method->result.surface().at(x, y);
  numbers = {ground.height,    ground.normal[0], ground.normal[1],
             ground.normal[2], ground.slope,     ground.confidence};
  return numbers.data();
}

/// Writes the labels of the last scan as the file named by the text: .label or .npy.
FLAGSTONE_EXPORT(flagstone_write_labels)
bool write_labels(const Method* method, bool semantic_kitti) noexcept {
  return guarded([&] {
    io::LabelWriter writer(semantic_kitti ? io::LabelMap::semantic_kitti : io::LabelMap::flagstone);
    check(text.ends_with(".npy") ? writer.write_label_npy(text, method->result.labels())
                                 : writer.write_label_file(text, method->result.labels()));
    return true;
  });
}

/// Writes the last scan with a field `label`, and `height` if there are heights, as the file named
/// by the text: .pcd, .ply or .npy.
FLAGSTONE_EXPORT(flagstone_write_scan)
bool write_scan(const Method* method, const Scan* scan) noexcept {
  return guarded([&] {
    io::Cloud labelled;
    check(io::with_labels(scan->cloud, method->result.labels(), labelled));
    if (!method->result.heights().empty()) {
      check(io::with_heights(labelled, method->result.heights(), labelled));
    }
    check(io::write_cloud(text, labelled));
    return true;
  });
}

/// Reads the label file named by the text, for a scan of `points` points, and writes one uint32 per
/// point as the file written last.
FLAGSTONE_EXPORT(flagstone_read_labels) bool read_labels(std::size_t points) noexcept {
  return guarded([&] {
    std::vector<std::uint32_t> classes;
    check(io::read_reference(text, points, classes));
    check(io::write_class_file(text, classes));
    return true;
  });
}

/// Examines scans; the text describes the method, see method_of().
FLAGSTONE_EXPORT(flagstone_doctor_new) app::ScanExaminer* doctor_new() noexcept {
  return guarded([] {
    const config::ResolvedMethod method = method_of(text);
    return std::make_unique<app::ScanExaminer>(method.name, method.config).release();
  });
}

FLAGSTONE_EXPORT(flagstone_doctor_delete) void doctor_delete(app::ScanExaminer* doctor) noexcept {
  delete doctor;
}

/// Examines a scan. The text is its name.
FLAGSTONE_EXPORT(flagstone_doctor_examine)
bool doctor_examine(app::ScanExaminer* doctor, const Scan* scan) noexcept {
  return guarded([&] {
    doctor->examine(text, scan->cloud);
    return true;
  });
}

/// Makes the report, as `flagstone doctor --json` prints it, the text.
FLAGSTONE_EXPORT(flagstone_doctor_report)
bool doctor_report(const app::ScanExaminer* doctor) noexcept {
  return guarded([&] {
    text = app::json_of(doctor->report());
    return true;
  });
}

}  // namespace flagstone::web
