// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <any>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "std_msgs/msg/header.hpp"

/// A stand-in for the part of rclcpp that the component uses, with the signatures and the order of
/// callbacks of its public interface. Nodes exchange no messages: the test delivers messages to
/// subscriptions and reads what publishers have published. No thread, no executor, no middleware.
namespace rcl_interfaces::msg {
struct SetParametersResult {
  bool successful = false;
  std::string reason;
};
struct FloatingPointRange {
  double from_value = 0;
  double to_value = 0;
  double step = 0;
};
struct IntegerRange {
  std::int64_t from_value = 0;
  std::int64_t to_value = 0;
  std::uint64_t step = 0;
};
struct ParameterDescriptor {
  std::string name;
  std::uint8_t type = 0;
  std::string description;
  std::string additional_constraints;
  bool read_only = false;
  bool dynamic_typing = false;
  std::vector<FloatingPointRange> floating_point_range;
  std::vector<IntegerRange> integer_range;
};
}  // namespace rcl_interfaces::msg

namespace rclcpp {

enum ParameterType : std::uint8_t {
  PARAMETER_NOT_SET = 0,
  PARAMETER_BOOL = 1,
  PARAMETER_INTEGER = 2,
  PARAMETER_DOUBLE = 3,
  PARAMETER_STRING = 4,
  PARAMETER_BYTE_ARRAY = 5,
  PARAMETER_BOOL_ARRAY = 6,
  PARAMETER_INTEGER_ARRAY = 7,
  PARAMETER_DOUBLE_ARRAY = 8,
  PARAMETER_STRING_ARRAY = 9,
};

class ParameterValue {
 public:
  ParameterValue() = default;
  explicit ParameterValue(bool value) : held_(value) {}
  explicit ParameterValue(std::int64_t value) : held_(value) {}
  explicit ParameterValue(double value) : held_(value) {}
  explicit ParameterValue(const std::string& value) : held_(value) {}
  explicit ParameterValue(const std::vector<double>& value) : held_(value) {}
  explicit ParameterValue(const std::vector<std::int64_t>& value) : held_(value) {}

  [[nodiscard]] ParameterType get_type() const {
    constexpr ParameterType types[] = {
        PARAMETER_NOT_SET, PARAMETER_BOOL,         PARAMETER_INTEGER,      PARAMETER_DOUBLE,
        PARAMETER_STRING,  PARAMETER_DOUBLE_ARRAY, PARAMETER_INTEGER_ARRAY};
    return types[held_.index()];
  }
  template <class Value>
  [[nodiscard]] const Value& get() const {
    return std::get<Value>(held_);
  }
  friend bool operator==(const ParameterValue&, const ParameterValue&) = default;

 private:
  std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<double>,
               std::vector<std::int64_t>>
      held_;
};

class Parameter {
 public:
  Parameter() = default;
  Parameter(std::string name, ParameterValue value)
      : name_(std::move(name)), value_(std::move(value)) {}
  template <class Value>
  Parameter(std::string name, const Value& value)
      : Parameter(std::move(name), ParameterValue(value)) {}

  [[nodiscard]] const std::string& get_name() const { return name_; }
  [[nodiscard]] const ParameterValue& get_parameter_value() const { return value_; }
  [[nodiscard]] std::int64_t as_int() const { return value_.get<std::int64_t>(); }
  [[nodiscard]] double as_double() const { return value_.get<double>(); }
  [[nodiscard]] const std::string& as_string() const { return value_.get<std::string>(); }
  [[nodiscard]] const std::vector<double>& as_double_array() const {
    return value_.get<std::vector<double>>();
  }
  friend bool operator==(const Parameter&, const Parameter&) = default;

 private:
  std::string name_;
  ParameterValue value_;
};

struct KeepLast {
  explicit KeepLast(std::size_t messages) : depth(messages) {}
  std::size_t depth;
};

class QoS {
 public:
  explicit QoS(const KeepLast& history) : depth(history.depth) {}
  QoS& best_effort() {
    is_reliable = false;
    return *this;
  }
  QoS& transient_local() {
    is_transient_local = true;
    return *this;
  }
  std::size_t depth;
  bool is_reliable = true;
  bool is_transient_local = false;
};

enum class QosPolicyKind { Reliability, Depth, Durability };

class QosOverridingOptions {
 public:
  QosOverridingOptions() = default;
  QosOverridingOptions(std::initializer_list<QosPolicyKind> kinds) : kinds_(kinds) {}
  [[nodiscard]] const std::vector<QosPolicyKind>& get_policy_kinds() const { return kinds_; }

 private:
  std::vector<QosPolicyKind> kinds_;
};

struct QOSMessageLostInfo {
  std::size_t total_count = 0;
  std::size_t total_count_change = 0;
};

struct SubscriptionEventCallbacks {
  std::function<void(QOSMessageLostInfo&)> message_lost_callback;
};

enum class IntraProcessSetting { Enable, Disable, NodeDefault };

struct SubscriptionOptions {
  SubscriptionEventCallbacks event_callbacks;
  IntraProcessSetting use_intra_process_comm = IntraProcessSetting::NodeDefault;
  QosOverridingOptions qos_overriding_options;
};

struct PublisherOptions {
  QosOverridingOptions qos_overriding_options;
};

/// Bytes of a message, with the members of rcl_serialized_message_t that the component uses.
class SerializedMessage {
 public:
  struct Bytes {
    std::uint8_t* buffer = nullptr;
    std::size_t buffer_length = 0;
  };
  explicit SerializedMessage(std::vector<std::uint8_t> bytes)
      : bytes_(std::move(bytes)), view_{bytes_.data(), bytes_.size()} {}
  [[nodiscard]] const Bytes& get_rcl_serialized_message() const { return view_; }

 private:
  std::vector<std::uint8_t> bytes_;
  Bytes view_;
};

class SubscriptionBase {
 public:
  using SharedPtr = std::shared_ptr<SubscriptionBase>;
  virtual ~SubscriptionBase() = default;

  // For the test.
  std::string topic;
  std::string type;  // of generic subscriptions
  QoS quality{KeepLast(0)};
  SubscriptionOptions options;
  std::any callback;  // a std::function
};

template <class Message>
class Publisher {
 public:
  using SharedPtr = std::shared_ptr<Publisher>;

  void publish(std::unique_ptr<Message> message) {
    const std::scoped_lock lock(mutex);
    published.push_back(std::move(message));
  }
  [[nodiscard]] std::size_t get_subscription_count() const { return subscribers; }
  [[nodiscard]] std::size_t get_intra_process_subscription_count() const {
    return intra_process_subscribers;
  }

  // For the test.
  QoS quality{KeepLast(0)};
  PublisherOptions options;
  std::size_t subscribers = 0;
  std::size_t intra_process_subscribers = 0;
  std::mutex mutex;
  std::vector<std::unique_ptr<Message>> published;
};

class TimerBase {
 public:
  using SharedPtr = std::shared_ptr<TimerBase>;
  void cancel() { is_cancelled = true; }

  // For the test.
  std::chrono::duration<double> period{};
  std::function<void()> callback;
  bool is_cancelled = false;
};

class Time {
 public:
  operator builtin_interfaces::msg::Time() const { return {.sec = 12, .nanosec = 34}; }
};

class Logger {
 public:
  Logger(std::vector<std::string>* lines, std::mutex* mutex) : lines_(lines), mutex_(mutex) {}
  template <class... Arguments>
  void write(const char* format, Arguments... arguments) const {
    char line[4096];
    std::snprintf(line, sizeof line, format, arguments...);
    const std::scoped_lock lock(*mutex_);
    lines_->emplace_back(line);
  }

 private:
  std::vector<std::string>* lines_;
  std::mutex* mutex_;
};
#define RCLCPP_WARN(logger, ...) (logger).write(__VA_ARGS__)

class NodeOptions {
 public:
  NodeOptions() = default;
  [[nodiscard]] const std::vector<Parameter>& parameter_overrides() const { return overrides_; }
  NodeOptions& parameter_overrides(const std::vector<Parameter>& overrides) {
    overrides_ = overrides;
    return *this;
  }

 private:
  std::vector<Parameter> overrides_;
};

namespace node_interfaces {
template <class Callback>
struct CallbackHandle {
  using SharedPtr = std::shared_ptr<CallbackHandle>;
  Callback callback;
};
using PreSetParametersCallbackHandle = CallbackHandle<std::function<void(std::vector<Parameter>&)>>;
using OnSetParametersCallbackHandle = CallbackHandle<
    std::function<rcl_interfaces::msg::SetParametersResult(const std::vector<Parameter>&)>>;
using PostSetParametersCallbackHandle =
    CallbackHandle<std::function<void(const std::vector<Parameter>&)>>;

class NodeParametersInterface {
 public:
  explicit NodeParametersInterface(const std::vector<Parameter>& overrides) {
    for (const Parameter& parameter : overrides) {
      overrides_.insert_or_assign(parameter.get_name(), parameter.get_parameter_value());
    }
  }
  [[nodiscard]] const std::map<std::string, ParameterValue>& get_parameter_overrides() const {
    return overrides_;
  }

 private:
  std::map<std::string, ParameterValue> overrides_;
};
}  // namespace node_interfaces

class Node {
 public:
  Node(const std::string& name, const NodeOptions& options)
      : full_name_("/" + name),
        interface_(std::make_shared<node_interfaces::NodeParametersInterface>(
            options.parameter_overrides())) {}
  virtual ~Node() = default;
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  [[nodiscard]] const char* get_fully_qualified_name() const { return full_name_.c_str(); }
  [[nodiscard]] Logger get_logger() const { return Logger(&recorded.log, &recorded.mutex); }
  [[nodiscard]] Time now() const { return {}; }
  [[nodiscard]] std::shared_ptr<node_interfaces::NodeParametersInterface>
  get_node_parameters_interface() const {
    return interface_;
  }

  const ParameterValue& declare_parameter(const std::string& name,
                                          const ParameterValue& default_value,
                                          rcl_interfaces::msg::ParameterDescriptor descriptor = {},
                                          bool ignore_override = false) {
    const ChangeGuard guard(is_changing_);
    if (has_parameter(name)) throw std::runtime_error("parameter '" + name + "' is declared");
    const auto& overrides = interface_->get_parameter_overrides();
    const auto given = overrides.find(name);
    const bool is_given = !ignore_override && given != overrides.end();
    const ParameterValue& value = is_given ? given->second : default_value;
    descriptor.name = name;
    descriptor.type = default_value.get_type();
    if (value.get_type() == PARAMETER_NOT_SET) throw std::runtime_error(name + ": not set");
    const auto result = set_checked({Parameter(name, value)}, {{name, descriptor}});
    if (!result.successful) {
      throw std::runtime_error("parameter '" + name + "' could not be set: " + result.reason);
    }
    recorded.descriptors[name] = descriptor;
    return recorded.values.at(name);
  }

  [[nodiscard]] bool has_parameter(const std::string& name) const {
    return recorded.values.find(name) != recorded.values.end();
  }
  [[nodiscard]] Parameter get_parameter(const std::string& name) const {
    return {name, recorded.values.at(name)};
  }
  [[nodiscard]] rcl_interfaces::msg::ParameterDescriptor describe_parameter(
      const std::string& name) const {
    return recorded.descriptors.at(name);
  }

  rcl_interfaces::msg::SetParametersResult set_parameters_atomically(
      std::vector<Parameter> parameters) {
    const ChangeGuard guard(is_changing_);
    if (const auto handle = preparing_.lock()) handle->callback(parameters);
    for (const Parameter& parameter : parameters) {
      const std::string& name = parameter.get_name();
      if (!has_parameter(name)) throw std::runtime_error(name + ": was not declared");
      if (recorded.descriptors.at(name).read_only) {
        return {false, "parameter '" + name + "' cannot be set because it is read-only"};
      }
    }
    return set_checked(parameters, recorded.descriptors);
  }
  rcl_interfaces::msg::SetParametersResult set_parameter(const Parameter& parameter) {
    return set_parameters_atomically({parameter});
  }

  [[nodiscard]] auto add_pre_set_parameters_callback(
      std::function<void(std::vector<Parameter>&)> callback) {
    return remember(preparing_, std::move(callback));
  }
  [[nodiscard]] auto add_on_set_parameters_callback(
      std::function<rcl_interfaces::msg::SetParametersResult(const std::vector<Parameter>&)>
          callback) {
    return remember(checking_, std::move(callback));
  }
  [[nodiscard]] auto add_post_set_parameters_callback(
      std::function<void(const std::vector<Parameter>&)> callback) {
    return remember(using_, std::move(callback));
  }

  template <class Message>
  std::shared_ptr<Publisher<Message>> create_publisher(const std::string& topic, const QoS& quality,
                                                       const PublisherOptions& options = {}) {
    auto publisher = std::make_shared<Publisher<Message>>();
    publisher->quality = quality;
    publisher->options = options;
    recorded.publishers[topic] = publisher;
    return publisher;
  }

  template <class Message, class Callback>
  std::shared_ptr<SubscriptionBase> create_subscription(const std::string& topic,
                                                        const QoS& quality, Callback&& callback,
                                                        const SubscriptionOptions& options = {}) {
    return subscribe(topic, "", quality, std::forward<Callback>(callback), options);
  }

  template <class Callback>
  std::shared_ptr<SubscriptionBase> create_generic_subscription(
      const std::string& topic, const std::string& type, const QoS& quality, Callback&& callback,
      const SubscriptionOptions& options = {}) {
    return subscribe(topic, type, quality, std::forward<Callback>(callback), options);
  }

  template <class Representation, class Period>
  std::shared_ptr<TimerBase> create_wall_timer(std::chrono::duration<Representation, Period> period,
                                               std::function<void()> callback) {
    auto timer = std::make_shared<TimerBase>();
    timer->period = period;
    timer->callback = std::move(callback);
    recorded.timers.push_back(timer);
    return timer;
  }

  // For the test.
  struct Recorded {
    std::map<std::string, ParameterValue> values;
    std::map<std::string, rcl_interfaces::msg::ParameterDescriptor> descriptors;
    std::map<std::string, std::any> publishers;
    std::map<std::string, std::weak_ptr<SubscriptionBase>> subscriptions;
    std::vector<std::weak_ptr<TimerBase>> timers;
    mutable std::mutex mutex;
    mutable std::vector<std::string> log;
  };
  Recorded recorded;

 private:
  /// rclcpp throws if a callback of a change declares or sets parameters.
  class ChangeGuard {
   public:
    explicit ChangeGuard(bool& is_changing) : is_changing_(is_changing) {
      if (is_changing_) throw std::runtime_error("parameters cannot be changed in this callback");
      is_changing_ = true;
    }
    ~ChangeGuard() { is_changing_ = false; }
    ChangeGuard(const ChangeGuard&) = delete;
    ChangeGuard& operator=(const ChangeGuard&) = delete;

   private:
    bool& is_changing_;
  };

  template <class Handle, class Callback>
  std::shared_ptr<Handle> remember(std::weak_ptr<Handle>& to, Callback callback) {
    auto handle = std::make_shared<Handle>();
    handle->callback = std::move(callback);
    to = handle;
    return handle;
  }

  template <class Callback>
  std::shared_ptr<SubscriptionBase> subscribe(const std::string& topic, const std::string& type,
                                              const QoS& quality, Callback&& callback,
                                              const SubscriptionOptions& options) {
    if (!options.qos_overriding_options.get_policy_kinds().empty()) {
      const ChangeGuard guard(is_changing_);  // declares parameters
    }
    auto subscription = std::make_shared<SubscriptionBase>();
    subscription->topic = topic;
    subscription->type = type;
    subscription->quality = quality;
    subscription->options = options;
    subscription->callback = std::function(std::forward<Callback>(callback));
    recorded.subscriptions[topic] = subscription;
    return subscription;
  }

  rcl_interfaces::msg::SetParametersResult set_checked(
      const std::vector<Parameter>& parameters,
      const std::map<std::string, rcl_interfaces::msg::ParameterDescriptor>& described) {
    for (const Parameter& parameter : parameters) {
      const auto& descriptor = described.at(parameter.get_name());
      const ParameterValue& value = parameter.get_parameter_value();
      if (!descriptor.dynamic_typing && descriptor.type != value.get_type()) {
        return {false, "Wrong parameter type, parameter {" + descriptor.name + "}"};
      }
      const auto is_outside = [](const auto& range, auto number) {
        return number < range.from_value || number > range.to_value;
      };
      if ((!descriptor.floating_point_range.empty() && value.get_type() == PARAMETER_DOUBLE &&
           is_outside(descriptor.floating_point_range[0], value.get<double>())) ||
          (!descriptor.integer_range.empty() && value.get_type() == PARAMETER_INTEGER &&
           is_outside(descriptor.integer_range[0], value.get<std::int64_t>()))) {
        return {false, "Parameter {" + descriptor.name + "} doesn't comply with its range."};
      }
    }
    if (const auto handle = checking_.lock()) {
      const auto result = handle->callback(parameters);
      if (!result.successful) return result;
    }
    for (const Parameter& parameter : parameters) {
      recorded.values[parameter.get_name()] = parameter.get_parameter_value();
    }
    if (const auto handle = using_.lock()) handle->callback(parameters);
    return {true, ""};
  }

  std::string full_name_;
  std::shared_ptr<node_interfaces::NodeParametersInterface> interface_;
  std::weak_ptr<node_interfaces::PreSetParametersCallbackHandle> preparing_;
  std::weak_ptr<node_interfaces::OnSetParametersCallbackHandle> checking_;
  std::weak_ptr<node_interfaces::PostSetParametersCallbackHandle> using_;
  bool is_changing_ = false;
};

}  // namespace rclcpp
