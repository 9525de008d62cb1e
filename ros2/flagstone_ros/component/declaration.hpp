// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <variant>

/// Parameters, topics and diagnostics. Written by scripts/component-declaration from
/// flagstone_ros/declaration.py; do not edit.
namespace flagstone_ros {

/// A parameter of the node. The settings of the methods are also parameters: see SegmenterSettings.
struct NodeParameter {
  std::string_view name;
  std::string_view description;
  std::string_view constraints;  ///< the allowed values in words
  /// No value: it follows from the other parameters.
  std::variant<std::monostate, bool, std::int64_t, double, std::string_view> value;
  bool is_dynamic;  ///< has several types
  bool read_only;   ///< can only be set when the node starts
  bool has_range;
  double low;   ///< of a number
  double high;  ///< of a number
};

/// A topic with its default quality of service.
struct Topic {
  std::string_view name;
  std::string_view type;
  bool is_reliable;
  bool is_transient_local;
  std::size_t depth;
};

struct DiagnosticValue {
  std::string_view key;
  int decimals;
};

// clang-format off
inline constexpr std::string_view node_name = "ground_segmentation";
inline constexpr auto methods = std::to_array<std::string_view>({"surface", "patchwork"});
inline constexpr auto input_types = std::to_array<std::string_view>({"sensor_msgs/msg/PointCloud2", "livox_ros_driver2/msg/CustomMsg", "livox_interfaces/msg/CustomMsg", "livox_ros_driver/msg/CustomMsg"});

inline constexpr auto node_parameters = std::to_array<NodeParameter>({
    {.name = "method",
     .description = "Method of segmentation. Its settings are parameters too.",
     .constraints = "surface or patchwork",
     .value = std::string_view("surface"),
     .is_dynamic = false,
     .read_only = true,
     .has_range = false,
     .low = 0,
     .high = 0},
    {.name = "input_type",
     .description = "Type of the messages on the topic points. The types of Livox need the package of their driver.",
     .constraints = "sensor_msgs/msg/PointCloud2, livox_ros_driver2/msg/CustomMsg, livox_interfaces/msg/CustomMsg or livox_ros_driver/msg/CustomMsg",
     .value = std::string_view("sensor_msgs/msg/PointCloud2"),
     .is_dynamic = false,
     .read_only = true,
     .has_range = false,
     .low = 0,
     .high = 0},
    {.name = "sensor",
     .description = "Sensor whose height and range to use; patchwork derives more settings from it.",
     .constraints = "a name that `flagstone sensors` prints, the path of a .toml file, or empty",
     .value = std::string_view(""),
     .is_dynamic = false,
     .read_only = false,
     .has_range = false,
     .low = 0,
     .high = 0},
    {.name = "preset",
     .description = "Settings of patchwork to start from if sensor is empty.",
     .constraints = "default, paper or reference",
     .value = std::string_view("default"),
     .is_dynamic = false,
     .read_only = false,
     .has_range = false,
     .low = 0,
     .high = 0},
    {.name = "config",
     .description = "File of settings, as `flagstone config` prints them. Other parameters override it.",
     .constraints = "the path of a .toml file, or empty",
     .value = std::string_view(""),
     .is_dynamic = false,
     .read_only = false,
     .has_range = false,
     .low = 0,
     .high = 0},
    {.name = "sensor_height",
     .description = "Height of the sensor above the ground in metres. estimate: from the first scan that determines it; track: updated with every scan. By default the height of the sensor, otherwise 1.73.",
     .constraints = "-100 to 100 m, estimate or track",
     .value = std::monostate(),
     .is_dynamic = true,
     .read_only = false,
     .has_range = false,
     .low = 0,
     .high = 0},
    {.name = "tilt",
     .description = "Up direction of a tilted sensor, in the frame of the sensor. off: the z axis; estimate: from the scans; imu: from the gravity that the topic imu measures. By default that of config, otherwise off.",
     .constraints = "off, estimate, imu or three numbers [x, y, z]",
     .value = std::monostate(),
     .is_dynamic = true,
     .read_only = false,
     .has_range = false,
     .low = 0,
     .high = 0},
    {.name = "sensor_frame",
     .description = "Frame of the sensor: x forward, y left, z up, origin in the sensor. Clouds in other frames are transformed to it for segmentation, with the static transforms of /tf_static. Empty: the frame of each cloud.",
     .constraints = "",
     .value = std::string_view(""),
     .is_dynamic = false,
     .read_only = false,
     .has_range = false,
     .low = 0,
     .high = 0},
    {.name = "imu_time_constant",
     .description = "Time constant of the low-pass filter of the gravity, in seconds. 0: no filter.",
     .constraints = "0 to 60 s",
     .value = 1.0,
     .is_dynamic = false,
     .read_only = false,
     .has_range = true,
     .low = 0,
     .high = 60},
    {.name = "queue_depth",
     .description = "Maximum number of clouds that wait for segmentation. If one more arrives, the oldest is dropped.",
     .constraints = "1 to 1000",
     .value = std::int64_t{5},
     .is_dynamic = false,
     .read_only = true,
     .has_range = true,
     .low = 1,
     .high = 1000},
    {.name = "threads",
     .description = "Number of threads per cloud. The result does not depend on it.",
     .constraints = "1 to 1024",
     .value = std::int64_t{1},
     .is_dynamic = false,
     .read_only = false,
     .has_range = true,
     .low = 1,
     .high = 1024},
    {.name = "diagnostics_period",
     .description = "Time between diagnostics, in seconds.",
     .constraints = "0.1 to 60 s",
     .value = 1.0,
     .is_dynamic = false,
     .read_only = true,
     .has_range = true,
     .low = 0.1,
     .high = 60},
});

namespace topics {
inline constexpr Topic points = {.name = "points", .type = "sensor_msgs/msg/PointCloud2", .is_reliable = false, .is_transient_local = false, .depth = 5};
inline constexpr Topic imu = {.name = "imu", .type = "sensor_msgs/msg/Imu", .is_reliable = false, .is_transient_local = false, .depth = 5};
inline constexpr Topic tf_static = {.name = "/tf_static", .type = "tf2_msgs/msg/TFMessage", .is_reliable = true, .is_transient_local = true, .depth = 100};
inline constexpr Topic ground = {.name = "ground", .type = "sensor_msgs/msg/PointCloud2", .is_reliable = true, .is_transient_local = false, .depth = 5};
inline constexpr Topic nonground = {.name = "nonground", .type = "sensor_msgs/msg/PointCloud2", .is_reliable = true, .is_transient_local = false, .depth = 5};
inline constexpr Topic labelled = {.name = "labelled", .type = "sensor_msgs/msg/PointCloud2", .is_reliable = true, .is_transient_local = false, .depth = 5};
inline constexpr Topic diagnostics = {.name = "/diagnostics", .type = "diagnostic_msgs/msg/DiagnosticArray", .is_reliable = true, .is_transient_local = false, .depth = 10};
}  // namespace topics

inline constexpr std::string_view diagnostics_name = "ground segmentation";
inline constexpr auto diagnostics = std::to_array<DiagnosticValue>({
    {"method", 0},
    {"clouds", 0},
    {"rate (Hz)", 1},
    {"latency, median (ms)", 2},
    {"latency, worst (ms)", 2},
    {"dropped", 0},
    {"skipped", 0},
    {"out of range (%)", 1},
    {"sensor height (m)", 3},
    {"tilt (degrees)", 2},
    {"mount", 0},
});

inline constexpr double throttle_seconds = 5.0;
inline constexpr double silence_seconds = 2.0;
inline constexpr double mostly_out_of_range = 0.9;
// clang-format on

}  // namespace flagstone_ros
