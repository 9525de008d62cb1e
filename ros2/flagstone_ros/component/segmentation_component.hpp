// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <variant>
#include <vector>

#include "cloud_segmenter.hpp"
#include "declaration.hpp"
#include "diagnostic_msgs/msg/diagnostic_array.hpp"
#include "files/ros/livox_message.hpp"
#include "latest_queue.hpp"
#include "monitor.hpp"
#include "rclcpp/rclcpp.hpp"
#include "segmenter_settings.hpp"
#include "sensor_msgs/msg/imu.hpp"
#include "sensor_msgs/msg/point_cloud2.hpp"
#include "sensor_poses.hpp"
#include "tf2_msgs/msg/tf_message.hpp"
#include "throttle.hpp"

namespace flagstone_ros {

/// Ground segmentation as a composable node. Parameters, topics and diagnostics are the same as in
/// the rclpy node; see flagstone_ros/declaration.py.
///
/// The executor receives messages and sets parameters. A separate thread segments the clouds and
/// publishes the outputs, so a slow cloud delays neither.
class SegmentationComponent : public rclcpp::Node {
 public:
  /// Throws std::exception with one line if a parameter is invalid or the package of the input type
  /// is not installed.
  explicit SegmentationComponent(const rclcpp::NodeOptions& options);
  ~SegmentationComponent() override;

 private:
  using PointCloud2 = sensor_msgs::msg::PointCloud2;
  using Message =
      std::variant<PointCloud2::ConstSharedPtr, std::shared_ptr<rclcpp::SerializedMessage>>;

  struct Arrival {
    Message message;
    double time;  // seconds on the steady clock
  };

  /// The parameters in use, which never change; other parameters make a new object.
  struct Configuration {
    ParameterValues given;  // by the user
    SegmenterSettings settings;
    std::shared_ptr<CloudSegmenter> segmenter;  // only used by the thread that segments
    std::string sensor_frame;
    double imu_time_constant;
  };

  // Parameters. See the comment of prepare_parameters().
  static std::shared_ptr<const Configuration> configure(ParameterValues given,
                                                        const Configuration* previous);
  void declare_parameters();
  void prepare_parameters(std::vector<rclcpp::Parameter>& parameters);
  rcl_interfaces::msg::SetParametersResult check_parameters();
  void use_parameters();
  [[nodiscard]] std::shared_ptr<const Configuration> configuration() const;

  // Topics.
  void create_inputs();
  void listen_to_imu();
  void receive(Message message);
  void add_transforms(const tf2_msgs::msg::TFMessage& message);
  void add_acceleration(const sensor_msgs::msg::Imu& message);
  void publish_diagnostics();

  // In the thread that segments.
  void segment_clouds();
  void segment(const Arrival& arrival);
  void view(const Message& message);
  void skip(std::string_view problem, const std::string& text);

  void warn(std::string_view problem, const std::string& text);
  /// A callback that logs exceptions instead of throwing them.
  template <class... Arguments>
  std::function<void(Arguments...)> guarded(std::function<void(Arguments...)> callback);

  mutable std::mutex mutex_;  // guards configuration_ and throttle_
  std::shared_ptr<const Configuration> configuration_;
  std::shared_ptr<const Configuration> next_;  // between the callbacks of one change
  std::string rejection_;
  Throttle throttle_{throttle_seconds};
  SensorPoses poses_;
  std::unique_ptr<Monitor> monitor_;
  std::unique_ptr<LatestQueue<Arrival>> queue_;

  flagstone::ros::PointCloud2View cloud_;  // the last three belong to the thread that segments
  flagstone::ros::DerivedCloud derived_;
  flagstone::ros::LivoxMessage livox_;

  std::array<rclcpp::Publisher<PointCloud2>::SharedPtr, 3> outputs_;  // by Output
  rclcpp::Publisher<diagnostic_msgs::msg::DiagnosticArray>::SharedPtr diagnostics_;
  rclcpp::SubscriptionBase::SharedPtr points_;
  rclcpp::SubscriptionBase::SharedPtr imu_;
  rclcpp::SubscriptionBase::SharedPtr transforms_;
  rclcpp::TimerBase::SharedPtr timer_;
  rclcpp::TimerBase::SharedPtr imu_timer_;
  rclcpp::node_interfaces::PreSetParametersCallbackHandle::SharedPtr preparing_;
  rclcpp::node_interfaces::OnSetParametersCallbackHandle::SharedPtr checking_;
  rclcpp::node_interfaces::PostSetParametersCallbackHandle::SharedPtr using_;
  std::thread worker_;
};

}  // namespace flagstone_ros
