// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "segmentation_component.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <exception>
#include <optional>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "cloud_message.hpp"
#include "files/ros/livox_message.hpp"
#include "rclcpp_components/register_node_macro.hpp"

namespace flagstone_ros {
namespace {

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The value of a parameter; nothing if no parameter of this node has its type.
std::optional<ParameterValue> value_of(const rclcpp::ParameterValue& value) {
  switch (value.get_type()) {
    case rclcpp::ParameterType::PARAMETER_BOOL: return value.get<bool>();
    case rclcpp::ParameterType::PARAMETER_INTEGER: return value.get<std::int64_t>();
    case rclcpp::ParameterType::PARAMETER_DOUBLE: return value.get<double>();
    case rclcpp::ParameterType::PARAMETER_STRING: return value.get<std::string>();
    case rclcpp::ParameterType::PARAMETER_DOUBLE_ARRAY: return value.get<std::vector<double>>();
    case rclcpp::ParameterType::PARAMETER_INTEGER_ARRAY: {  // tilt: [0, 0, 1] in YAML
      const auto& integers = value.get<std::vector<std::int64_t>>();
      return std::vector<double>(integers.begin(), integers.end());
    }
    default: return std::nullopt;
  }
}

rclcpp::ParameterValue ros_value_of(const ParameterValue& value) {
  return std::visit([](const auto& held) { return rclcpp::ParameterValue(held); }, value);
}

rclcpp::ParameterValue default_of(const NodeParameter& parameter) {
  return std::visit(
      [](const auto& held) {
        using Held = std::remove_cvref_t<decltype(held)>;
        if constexpr (std::is_same_v<Held, std::monostate>) {
          return rclcpp::ParameterValue();
        } else if constexpr (std::is_same_v<Held, std::string_view>) {
          return rclcpp::ParameterValue(std::string(held));
        } else {
          return rclcpp::ParameterValue(held);
        }
      },
      parameter.value);
}

rcl_interfaces::msg::ParameterDescriptor descriptor_of(std::string_view description,
                                                       std::string_view constraints) {
  rcl_interfaces::msg::ParameterDescriptor descriptor;
  descriptor.description = description;
  descriptor.additional_constraints = constraints;
  return descriptor;
}

void set_range(double low, double high, bool is_integer,
               rcl_interfaces::msg::ParameterDescriptor& descriptor) {
  if (is_integer) {
    descriptor.integer_range.resize(1);
    descriptor.integer_range[0].from_value = static_cast<std::int64_t>(low);
    descriptor.integer_range[0].to_value = static_cast<std::int64_t>(high);
    descriptor.integer_range[0].step = 1;
  } else {
    descriptor.floating_point_range.resize(1);
    descriptor.floating_point_range[0].from_value = low;
    descriptor.floating_point_range[0].to_value = high;
  }
}

const NodeParameter& node_parameter(std::string_view name) {
  return *std::ranges::find(node_parameters, name, &NodeParameter::name);
}

/// The value of a parameter that is not of the segmenter: the given one or the default.
template <class Value>
Value given_or_default(const ParameterValues& given, std::string_view name) {
  const auto found = given.find(name);
  const auto* value = found == given.end() ? nullptr : std::get_if<Value>(&found->second);
  return value != nullptr ? *value : default_of(node_parameter(name)).template get<Value>();
}

rclcpp::QoS quality_of(const Topic& topic) {
  rclcpp::QoS quality(rclcpp::KeepLast(topic.depth));
  if (!topic.is_reliable) quality.best_effort();
  if (topic.is_transient_local) quality.transient_local();
  return quality;
}

rclcpp::QosOverridingOptions overridable() {
  return {rclcpp::QosPolicyKind::Reliability, rclcpp::QosPolicyKind::Depth,
          rclcpp::QosPolicyKind::Durability};
}

void check(const flagstone::Status& status) {
  if (status.ok()) return;
  const std::string& problem = status.message();
  throw CloudSkipped("cloud", "points: " + (problem.empty() ? "out of memory" : problem));
}

}  // namespace

template <class... Arguments>
std::function<void(Arguments...)> SegmentationComponent::guarded(
    std::function<void(Arguments...)> callback) {
  return [this, callback = std::move(callback)](Arguments... arguments) {
    try {
      callback(std::forward<Arguments>(arguments)...);
    } catch (const std::exception& error) {
      warn("callback", error.what());
    }
  };
}

SegmentationComponent::SegmentationComponent(const rclcpp::NodeOptions& options)
    : rclcpp::Node(std::string(node_name), options) {
  declare_parameters();
  monitor_ = std::make_unique<Monitor>(steady_seconds(), get_parameter("method").as_string());
  queue_ = std::make_unique<LatestQueue<Arrival>>(
      static_cast<std::size_t>(get_parameter("queue_depth").as_int()));

  rclcpp::PublisherOptions output_options;
  output_options.qos_overriding_options = overridable();
  constexpr std::array output_topics = {topics::ground, topics::nonground, topics::labelled};
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    outputs_.at(i) = create_publisher<PointCloud2>(std::string(output_topics.at(i).name),
                                                   quality_of(output_topics.at(i)), output_options);
  }
  diagnostics_ = create_publisher<diagnostic_msgs::msg::DiagnosticArray>(
      std::string(topics::diagnostics.name), quality_of(topics::diagnostics));
  create_inputs();
  const std::chrono::duration<double> period(get_parameter("diagnostics_period").as_double());
  timer_ = create_wall_timer(period, guarded(std::function([this] { publish_diagnostics(); })));
  worker_ = std::thread([this] { segment_clouds(); });
}

SegmentationComponent::~SegmentationComponent() {
  queue_->close();
  worker_.join();
}

// Parameters

std::shared_ptr<const SegmentationComponent::Configuration> SegmentationComponent::configure(
    ParameterValues given, const Configuration* previous) {
  // The segmenter, with its estimates, is kept if only parameters of the node have changed.
  const auto of_segmenter = [](const ParameterValues& values) {
    ParameterValues of = values;
    std::erase_if(of, [](const auto& value) {
      const bool is_of_node = std::ranges::find(node_parameters, value.first,
                                                &NodeParameter::name) != node_parameters.end();
      return is_of_node && !is_segmenter_parameter(value.first);
    });
    return of;
  };
  const bool is_kept = previous != nullptr && of_segmenter(given) == of_segmenter(previous->given);
  SegmenterSettings settings = is_kept ? previous->settings : SegmenterSettings(given);
  auto segmenter = is_kept ? previous->segmenter : std::make_shared<CloudSegmenter>(settings);
  auto sensor_frame = given_or_default<std::string>(given, "sensor_frame");
  const auto time_constant = given_or_default<double>(given, "imu_time_constant");
  return std::make_shared<const Configuration>(
      Configuration{.given = std::move(given),
                    .settings = std::move(settings),
                    .segmenter = std::move(segmenter),
                    .sensor_frame = std::move(sensor_frame),
                    .imu_time_constant = time_constant});
}

void SegmentationComponent::declare_parameters() {
  const auto& overrides = get_node_parameters_interface()->get_parameter_overrides();
  ParameterValues given;
  for (const auto& [name, value] : overrides) {
    if (auto known = value_of(value)) given.insert_or_assign(name, *std::move(known));
  }
  const auto input_type = given_or_default<std::string>(given, "input_type");
  if (std::ranges::find(input_types, input_type) == input_types.end()) {
    throw std::invalid_argument("input_type: '" + input_type + "' is not supported (expected " +
                                std::string(node_parameter("input_type").constraints) + ")");
  }
  configuration_ = configure(std::move(given), nullptr);
  const ParameterValues values = configuration_->settings.values();

  for (const NodeParameter& parameter : node_parameters) {
    auto descriptor = descriptor_of(parameter.description, parameter.constraints);
    descriptor.read_only = parameter.read_only;
    descriptor.dynamic_typing = parameter.is_dynamic;
    const bool is_integer = std::holds_alternative<std::int64_t>(parameter.value);
    if (parameter.has_range) set_range(parameter.low, parameter.high, is_integer, descriptor);
    const bool follows = std::holds_alternative<std::monostate>(parameter.value);
    declare_parameter(
        std::string(parameter.name),
        follows ? ros_value_of(values.find(parameter.name)->second) : default_of(parameter),
        descriptor);
  }
  for (const SettingParameter& setting : configuration_->settings.settings()) {
    auto descriptor = descriptor_of(setting.description, setting.constraints);
    const bool is_integer = std::holds_alternative<std::int64_t>(setting.value);
    if (setting.is_number) set_range(setting.low, setting.high, is_integer, descriptor);
    declare_parameter(setting.name, ros_value_of(setting.value), descriptor);
  }
  for (const auto& [name, value] : overrides) {
    if (has_parameter(name) || name.starts_with("qos_overrides.")) continue;
    RCLCPP_WARN(get_logger(), "parameters: '%s' is not a parameter of this node with method %s",
                name.c_str(), get_parameter("method").as_string().c_str());
  }

  preparing_ = add_pre_set_parameters_callback(
      [this](std::vector<rclcpp::Parameter>& parameters) { prepare_parameters(parameters); });
  checking_ = add_on_set_parameters_callback(
      [this](const std::vector<rclcpp::Parameter>&) { return check_parameters(); });
  using_ = add_post_set_parameters_callback(
      guarded(std::function([this](const std::vector<rclcpp::Parameter>&) { use_parameters(); })));
}

/// A change of parameters has three steps, which ROS calls in this order: prepare_parameters()
/// makes the segmenter, and adds the parameters that follow from the change, so that all change
/// together; check_parameters() rejects the change with the reason; use_parameters() uses the
/// segmenter.
void SegmentationComponent::prepare_parameters(std::vector<rclcpp::Parameter>& parameters) {
  next_.reset();
  rejection_.clear();
  try {
    const auto current = configuration();
    ParameterValues given = current->given;
    for (const rclcpp::Parameter& parameter : parameters) {
      const std::string& name = parameter.get_name();
      const auto value = value_of(parameter.get_parameter_value());
      const bool is_known = has_parameter(name) && !describe_parameter(name).read_only;
      if (is_known && value) given.insert_or_assign(name, *value);
    }
    next_ = configure(std::move(given), current.get());
    for (const auto& [name, value] : next_->settings.values()) {
      const rclcpp::Parameter following(name, ros_value_of(value));
      const bool is_given = std::ranges::any_of(
          parameters, [&](const rclcpp::Parameter& other) { return other.get_name() == name; });
      if (!is_given && get_parameter(name) != following) parameters.push_back(following);
    }
  } catch (const std::exception& error) {
    rejection_ = error.what();
  }
}

rcl_interfaces::msg::SetParametersResult SegmentationComponent::check_parameters() {
  rcl_interfaces::msg::SetParametersResult result;
  result.successful = rejection_.empty();
  result.reason = std::exchange(rejection_, {});
  return result;
}

void SegmentationComponent::use_parameters() {
  if (next_ == nullptr) return;
  {
    const std::scoped_lock lock(mutex_);
    configuration_ = std::exchange(next_, nullptr);  // the next cloud uses it
  }
  // Subscribing declares parameters, which is not allowed in this callback.
  imu_timer_ = create_wall_timer(std::chrono::milliseconds(1), guarded(std::function([this] {
                                   imu_timer_->cancel();
                                   next_.reset();  // of a change that ROS rejected
                                   rejection_.clear();
                                   listen_to_imu();
                                 })));
}

std::shared_ptr<const SegmentationComponent::Configuration> SegmentationComponent::configuration()
    const {
  const std::scoped_lock lock(mutex_);
  return configuration_;
}

// Topics

void SegmentationComponent::create_inputs() {
  rclcpp::SubscriptionOptions static_options;
  static_options.use_intra_process_comm = rclcpp::IntraProcessSetting::Disable;  // not volatile
  transforms_ = create_subscription<tf2_msgs::msg::TFMessage>(
      std::string(topics::tf_static.name), quality_of(topics::tf_static),
      guarded(std::function(
          [this](const tf2_msgs::msg::TFMessage& message) { add_transforms(message); })),
      static_options);
  listen_to_imu();

  rclcpp::SubscriptionOptions options;
  options.qos_overriding_options = overridable();
  options.event_callbacks.message_lost_callback =
      guarded(std::function([this](rclcpp::QOSMessageLostInfo& lost) {
        monitor_->dropped(lost.total_count_change);
        warn("lost", "points: clouds dropped (the transport lost them)");
      }));
  const std::string name(topics::points.name);
  const std::string type = get_parameter("input_type").as_string();
  if (type == topics::points.type) {
    points_ = create_subscription<PointCloud2>(
        name, quality_of(topics::points),
        guarded(std::function(
            [this](PointCloud2::ConstSharedPtr message) { receive(std::move(message)); })),
        options);
  } else {
    points_ = create_generic_subscription(
        name, type, quality_of(topics::points),
        guarded(std::function([this](std::shared_ptr<rclcpp::SerializedMessage> message) {
          receive(std::move(message));
        })),
        options);
  }
}

void SegmentationComponent::listen_to_imu() {
  if (!configuration()->settings.uses_imu()) {
    imu_.reset();
    poses_.forget_gravity();
    return;
  }
  if (imu_ != nullptr) return;
  rclcpp::SubscriptionOptions options;
  options.qos_overriding_options = overridable();
  imu_ = create_subscription<sensor_msgs::msg::Imu>(
      std::string(topics::imu.name), quality_of(topics::imu),
      guarded(std::function(
          [this](const sensor_msgs::msg::Imu& message) { add_acceleration(message); })),
      options);
}

void SegmentationComponent::receive(Message message) {
  const double now = steady_seconds();
  monitor_->received(now);
  if (!queue_->push({std::move(message), now})) return;
  monitor_->dropped(1);
  warn("dropped",
       "points: the oldest cloud was dropped (clouds arrive faster than they are "
       "segmented)");
}

void SegmentationComponent::add_transforms(const tf2_msgs::msg::TFMessage& message) {
  for (const auto& stamped : message.transforms) {
    const auto& translation = stamped.transform.translation;
    const auto& rotation = stamped.transform.rotation;
    const auto problem = poses_.add_transform(stamped.header.frame_id, stamped.child_frame_id,
                                              {translation.x, translation.y, translation.z},
                                              {rotation.x, rotation.y, rotation.z, rotation.w});
    if (problem) warn("invalid transform", *problem);
  }
}

void SegmentationComponent::add_acceleration(const sensor_msgs::msg::Imu& message) {
  const auto& measured = message.linear_acceleration;
  const double stamp = message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec;
  const auto problem =
      poses_.add_acceleration({measured.x, measured.y, measured.z}, stamp, message.header.frame_id,
                              configuration()->imu_time_constant);
  if (problem) warn("acceleration", *problem);
}

void SegmentationComponent::publish_diagnostics() {
  Diagnosis diagnosis = monitor_->diagnose(steady_seconds());
  auto message = std::make_unique<diagnostic_msgs::msg::DiagnosticArray>();
  message->header.stamp = now();
  message->status.resize(1);
  auto& status = message->status.front();
  status.level = static_cast<std::uint8_t>(diagnosis.level);
  const std::string name(get_fully_qualified_name());  // begins with a slash
  status.name = name.substr(1) + ": " + std::string(diagnostics_name);
  status.message = std::move(diagnosis.message);
  for (auto& [key, value] : diagnosis.values) {
    auto& entry = status.values.emplace_back();
    entry.key = std::move(key);
    entry.value = std::move(value);
  }
  diagnostics_->publish(std::move(message));
}

void SegmentationComponent::warn(std::string_view problem, const std::string& text) {
  std::optional<std::string> line;
  {
    const std::scoped_lock lock(mutex_);
    line = throttle_.line(problem, text, steady_seconds());
  }
  if (line) RCLCPP_WARN(get_logger(), "%s", line->c_str());
}

// In the thread that segments

void SegmentationComponent::segment_clouds() {
  while (const std::optional<Arrival> arrival = queue_->pop()) {
    try {
      segment(*arrival);
    } catch (const CloudSkipped& skipped) {
      skip(skipped.problem(), skipped.what());
    } catch (const std::exception& error) {
      skip("exception", std::string("points: ") + error.what());
    }
  }
}

void SegmentationComponent::skip(std::string_view problem, const std::string& text) {
  monitor_->skipped(text);
  warn(problem, text + "; the cloud is skipped");
}

void SegmentationComponent::view(const Message& message) {
  if (const auto* cloud = std::get_if<PointCloud2::ConstSharedPtr>(&message)) {
    return check(view_message(**cloud, cloud_));
  }
  const auto& serialized =
      std::get<std::shared_ptr<rclcpp::SerializedMessage>>(message)->get_rcl_serialized_message();
  const std::span bytes(serialized.buffer, serialized.buffer_length);
  check(parse_livox(std::as_bytes(bytes), flagstone::ros::Encoding::cdr, cloud_, livox_));
}

void SegmentationComponent::segment(const Arrival& arrival) {
  const auto in_use = configuration();
  std::array<bool, 3> wanted{};
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const auto& output = outputs_.at(i);
    wanted.at(i) =
        output->get_subscription_count() + output->get_intra_process_subscription_count() > 0;
  }
  view(arrival.message);
  const bool is_unheard = std::ranges::none_of(wanted, std::identity());
  if (is_unheard && !in_use->settings.estimates_mount()) return monitor_->unheard();

  const SensorPose pose =
      poses_.find(cloud_.header.frame_id, in_use->sensor_frame, in_use->settings.uses_imu());
  CloudSegmenter& segmenter = *in_use->segmenter;
  check(segmenter.segment(cloud_, pose.to_sensor, pose.up));
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!wanted.at(i)) continue;
    check(segmenter.plan(static_cast<Output>(i), cloud_, derived_));
    auto message = std::make_unique<PointCloud2>();
    write_message(derived_, *message);
    outputs_.at(i)->publish(std::move(message));
  }
  CloudSummary summary = segmenter.summary();
  summary.latency = steady_seconds() - arrival.time;
  monitor_->segmented(std::move(summary));
  if (const auto warning = segmenter.warning()) warn("flagstone", *warning);
}

}  // namespace flagstone_ros

RCLCPP_COMPONENTS_REGISTER_NODE(flagstone_ros::SegmentationComponent)
