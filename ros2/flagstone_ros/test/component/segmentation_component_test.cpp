// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "segmentation_component.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <any>
#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "scene.hpp"

std::shared_ptr<rclcpp::Node> make_registered_component(const rclcpp::NodeOptions& options);

namespace flagstone_ros {
namespace {

using diagnostic_msgs::msg::DiagnosticArray;
using sensor_msgs::msg::PointCloud2;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr std::array<const char*, 3> outputs = {"ground", "nonground", "labelled"};

/// The component as a container of components loads it, with a test in the place of the middleware.
class Component {
 public:
  explicit Component(std::vector<rclcpp::Parameter> parameters = {}) {
    rclcpp::NodeOptions options;
    node = make_registered_component(options.parameter_overrides(parameters));
  }

  void subscribe(const char* output) { publisher<PointCloud2>(output).subscribers = 1; }

  void publish(PointCloud2 message) {
    deliver<PointCloud2::ConstSharedPtr>("points",
                                         std::make_shared<const PointCloud2>(std::move(message)));
  }

  template <class Argument, class Message>
  void deliver(const std::string& topic, Message message) {
    const auto subscription = node->recorded.subscriptions.at(topic).lock();
    std::any_cast<std::function<void(Argument)>&>(subscription->callback)(std::move(message));
  }

  void deliver_transform(const std::string& parent, const std::string& child, double z) {
    tf2_msgs::msg::TFMessage message;
    auto& stamped = message.transforms.emplace_back();
    stamped.header.frame_id = parent;
    stamped.child_frame_id = child;
    stamped.transform.translation.z = z;
    deliver<const tf2_msgs::msg::TFMessage&>("/tf_static", message);
  }

  /// The messages published on an output, once there are `count`.
  std::vector<PointCloud2> received(const char* output, std::size_t count) {
    auto& from = publisher<PointCloud2>(output);
    wait([&] {
      const std::scoped_lock lock(from.mutex);
      return from.published.size() >= count;
    });
    const std::scoped_lock lock(from.mutex);
    std::vector<PointCloud2> messages;
    for (const auto& message : from.published) messages.push_back(*message);
    return messages;
  }

  /// Runs the timers until the diagnostics have a value, and returns their last status.
  diagnostic_msgs::msg::DiagnosticStatus diagnostics_with(const std::string& key,
                                                          const std::string& value) {
    diagnostic_msgs::msg::DiagnosticStatus status;
    wait([&] {
      status = diagnostics();
      for (const auto& entry : status.values) {
        if (entry.key == key && entry.value == value) return true;
      }
      return false;
    });
    return status;
  }

  diagnostic_msgs::msg::DiagnosticStatus diagnostics() {
    run_timers();
    return publisher<DiagnosticArray>("/diagnostics").published.back()->status.at(0);
  }

  void run_timers() {
    const auto timers = node->recorded.timers;  // callbacks can add timers
    for (const auto& weak : timers) {
      const auto timer = weak.lock();
      if (timer != nullptr && !timer->is_cancelled) timer->callback();
    }
  }

  rcl_interfaces::msg::SetParametersResult set(const rclcpp::Parameter& parameter) {
    return node->set_parameter(parameter);
  }

  std::vector<std::string> log() {
    const std::scoped_lock lock(node->recorded.mutex);
    return node->recorded.log;
  }

  void wait_for_log(const std::string& text) {
    wait([&] {
      for (const std::string& line : log()) {
        if (line.find(text) != std::string::npos) return true;
      }
      return false;
    });
  }

  template <class Message>
  rclcpp::Publisher<Message>& publisher(const std::string& topic) {
    return *std::any_cast<const std::shared_ptr<rclcpp::Publisher<Message>>&>(
        node->recorded.publishers.at(topic));
  }

  std::shared_ptr<rclcpp::Node> node;

 private:
  template <class Condition>
  static void wait(const Condition& condition) {
    for (int i = 0; i < 3000; ++i) {
      if (condition()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    FAIL() << "nothing has happened for 30 s";
  }
};

// Declaration

TEST(Component, DeclaresTheParametersOfTheDeclaration) {
  const Component component;

  for (const NodeParameter& parameter : node_parameters) {
    const auto& descriptor = component.node->recorded.descriptors.at(std::string(parameter.name));
    EXPECT_EQ(descriptor.description, parameter.description);
    EXPECT_EQ(descriptor.additional_constraints, parameter.constraints);
    EXPECT_EQ(descriptor.read_only, parameter.read_only);
    EXPECT_EQ(descriptor.dynamic_typing, parameter.is_dynamic);
    EXPECT_EQ(descriptor.floating_point_range.size() + descriptor.integer_range.size(),
              parameter.has_range ? 1u : 0u);
  }
}

TEST(Component, DeclaresTheSettingsOfTheMethodWithTheirRanges) {
  const Component surface;
  const Component patchwork({{"method", std::string("patchwork")}});

  const auto& range = surface.node->recorded.descriptors.at("max_range").floating_point_range;
  ASSERT_EQ(range.size(), 1u);
  EXPECT_EQ(range[0].from_value, 8);
  EXPECT_EQ(range[0].to_value, 200);
  EXPECT_FALSE(surface.node->has_parameter("uprightness.angle"));
  EXPECT_TRUE(patchwork.node->has_parameter("uprightness.angle"));
}

TEST(Component, HasTheTopicsAndQualitiesOfServiceOfTheDeclaration) {
  Component component;
  const auto& subscriptions = component.node->recorded.subscriptions;

  const auto points = subscriptions.at("points").lock();
  EXPECT_FALSE(points->quality.is_reliable);
  EXPECT_EQ(points->quality.depth, 5u);
  EXPECT_EQ(points->options.qos_overriding_options.get_policy_kinds().size(), 3u);
  const auto transforms = subscriptions.at("/tf_static").lock();
  EXPECT_TRUE(transforms->quality.is_reliable);
  EXPECT_TRUE(transforms->quality.is_transient_local);
  EXPECT_EQ(subscriptions.count("imu"), 0u);
  for (const char* output : outputs) {
    const auto& publisher = component.publisher<PointCloud2>(output);
    EXPECT_TRUE(publisher.quality.is_reliable);
    EXPECT_FALSE(publisher.quality.is_transient_local);
    EXPECT_EQ(publisher.options.qos_overriding_options.get_policy_kinds().size(), 3u);
  }
  EXPECT_EQ(component.node->recorded.publishers.count("/diagnostics"), 1u);
}

// Outputs

TEST(Component, PublishesAllThreeOutputs) {
  Component component;
  for (const char* output : outputs) component.subscribe(output);
  const PointCloud2 message = Scene().message();

  component.publish(message);

  const PointCloud2 labelled = component.received("labelled", 1)[0];
  const PointCloud2 ground = component.received("ground", 1)[0];
  const PointCloud2 nonground = component.received("nonground", 1)[0];
  EXPECT_EQ(labelled.width, message.width);
  ASSERT_EQ(labelled.fields.size(), 7u);
  EXPECT_EQ(labelled.fields[5].name, "label");
  EXPECT_EQ(labelled.fields[6].name, "height");
  EXPECT_EQ(ground.width + nonground.width, message.width);
  EXPECT_EQ(ground.fields.size(), 5u);
  for (const PointCloud2& output : {labelled, ground, nonground}) {
    EXPECT_EQ(output.header.frame_id, "lidar");
    EXPECT_EQ(output.header.stamp.sec, 1700000000);
    EXPECT_EQ(output.header.stamp.nanosec, 123456789u);
  }
  for (std::size_t i = 0; i < message.width; ++i) {
    ASSERT_EQ(std::memcmp(&labelled.data[28 * i], &message.data[20 * i], 20), 0);
  }
}

TEST(Component, ComputesOnlyOutputsWithASubscriber) {
  Component component;
  component.publisher<PointCloud2>("nonground").intra_process_subscribers = 1;

  component.publish(Scene().message());

  EXPECT_EQ(component.received("nonground", 1).size(), 1u);
  component.diagnostics_with("clouds", "1");
  EXPECT_TRUE(component.publisher<PointCloud2>("ground").published.empty());
  EXPECT_TRUE(component.publisher<PointCloud2>("labelled").published.empty());
}

TEST(Component, SegmentsWithoutSubscribersOnlyToEstimateThePose) {
  Component idle;
  Component tracking({{"sensor_height", std::string("track")}});

  idle.publish(Scene().message());
  tracking.publish(Scene().message());

  tracking.diagnostics_with("clouds", "1");
  EXPECT_EQ(idle.diagnostics().values.at(1).value, "0");
}

TEST(Component, PublishesFromACloudOfLivoxAPointCloud2) {
  Component component({{"input_type", std::string("livox_ros_driver2/msg/CustomMsg")}});
  component.subscribe("labelled");
  // Little endian CDR: header, timebase, point_num, lidar_id, rsvd[3], points.
  std::vector<std::uint8_t> bytes = {0, 1, 0, 0};
  const auto add = [&](auto value) {
    while ((bytes.size() - 4) % sizeof(value) != 0) bytes.push_back(0);
    std::uint8_t raw[sizeof(value)];
    std::memcpy(raw, &value, sizeof(value));
    bytes.insert(bytes.end(), raw, raw + sizeof(value));
  };
  add(std::int32_t{7});
  add(std::uint32_t{8});
  add(std::uint32_t{6});
  for (const char letter : {'l', 'i', 'v', 'o', 'x', '\0'}) add(static_cast<std::uint8_t>(letter));
  add(std::uint64_t{99});
  add(std::uint32_t{2});
  add(std::uint8_t{1});
  for (int i = 0; i < 3; ++i) add(std::uint8_t{0});
  add(std::uint32_t{2});
  for (const float x : {5.f, 6.f}) {
    add(std::uint32_t{1000});
    add(x);
    add(0.f);
    add(-1.73f);
    for (const int value : {50, 1, 2}) add(static_cast<std::uint8_t>(value));
  }

  component.deliver<std::shared_ptr<rclcpp::SerializedMessage>>(
      "points", std::make_shared<rclcpp::SerializedMessage>(bytes));

  const PointCloud2 labelled = component.received("labelled", 1)[0];
  EXPECT_EQ(component.node->recorded.subscriptions.at("points").lock()->type,
            "livox_ros_driver2/msg/CustomMsg");
  EXPECT_EQ(labelled.header.frame_id, "livox");
  EXPECT_EQ(labelled.header.stamp.sec, 7);
  EXPECT_EQ(labelled.width, 2u);
  EXPECT_EQ(labelled.fields[0].name, "offset_time");
}

// Messages that cannot be segmented

TEST(Component, SkipsMalformedCloudsWithOneLineAndContinues) {
  Component component;
  component.subscribe("labelled");
  PointCloud2 without_fields = Scene().message();
  without_fields.fields.clear();
  PointCloud2 truncated = Scene().message();
  truncated.data.resize(100);
  PointCloud2 huge = Scene().message();
  huge.width = 0xffffffff;
  huge.height = 0xffffffff;

  component.publish(without_fields);
  component.publish(truncated);
  component.publish(huge);
  component.publish(Scene().message());

  EXPECT_EQ(component.received("labelled", 1).size(), 1u);
  EXPECT_THAT(component.log(), ElementsAre(AllOf(StartsWith("points: "), Not(HasSubstr("\n")),
                                                 HasSubstr("; the cloud is skipped"))));
  const auto status = component.diagnostics_with("skipped", "3");
  EXPECT_EQ(status.level, 1);
  EXPECT_THAT(status.message, HasSubstr("3 of 4 clouds skipped: points: "));
}

TEST(Component, AcceptsACloudWithoutPoints) {
  Component component;
  component.subscribe("labelled");
  PointCloud2 empty = Scene().message();
  empty.width = empty.row_step = 0;
  empty.data.clear();

  component.publish(empty);

  EXPECT_EQ(component.received("labelled", 1)[0].width, 0u);
  EXPECT_THAT(component.log(), ElementsAre());
}

TEST(Component, DropsTheOldestCloudsIfItFallsBehind) {
  Component component({{"queue_depth", std::int64_t{1}}});
  component.subscribe("labelled");
  Scene scene;
  for (int i = 0; i < 400'000; ++i) {
    scene.add(0.0001f * static_cast<float>(i), 10, -1.73f);
  }
  const PointCloud2 slow = scene.message();
  PointCloud2 last = Scene().message();
  last.header.frame_id = "last";

  for (int i = 0; i < 20; ++i) component.publish(slow);
  component.publish(last);

  component.wait_for_log("the oldest cloud was dropped");
  while (component.received("labelled", 1).back().header.frame_id != "last") {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_LT(component.received("labelled", 1).size(), 21u);
}

// Frames and gravity

TEST(Component, SkipsCloudsUntilTheTransformToTheSensorIsKnown) {
  Component component({{"sensor_frame", std::string("sensor")}});
  component.subscribe("ground");
  Scene scene;
  scene.move(0, 0, 0, 10);

  component.publish(scene.message());
  component.wait_for_log("no transform from the frame 'lidar' of the cloud to 'sensor'");
  component.deliver_transform("sensor", "lidar", -10);
  component.publish(scene.message());

  EXPECT_GT(component.received("ground", 1)[0].width, scene.ground_count * 95 / 100);
}

TEST(Component, LogsAnInvalidTransform) {
  Component component;
  tf2_msgs::msg::TFMessage message;
  message.transforms.emplace_back().transform.rotation.w = 0;

  component.deliver<const tf2_msgs::msg::TFMessage&>("/tf_static", message);

  EXPECT_THAT(component.log(), ElementsAre(HasSubstr("is not a transform")));
}

TEST(Component, LevelsCloudsWithTheImu) {
  Component component({{"tilt", std::string("imu")}});
  component.subscribe("ground");
  Scene scene;
  scene.move(0.35, 0, 0, 0);
  sensor_msgs::msg::Imu imu;
  imu.header.frame_id = "lidar";
  imu.linear_acceleration.y = -9.81 * std::sin(0.35);
  imu.linear_acceleration.z = 9.81 * std::cos(0.35);

  component.publish(scene.message());
  component.wait_for_log("imu: no acceleration has arrived");
  component.deliver<const sensor_msgs::msg::Imu&>("imu", imu);
  component.publish(scene.message());

  EXPECT_GT(component.received("ground", 1)[0].width, scene.ground_count * 95 / 100);
  component.diagnostics_with("tilt (degrees)", "20.05");
}

TEST(Component, SubscribesToTheImuWhenTiltIsSetToImu) {
  Component component;

  ASSERT_TRUE(component.set({"tilt", std::string("imu")}).successful);
  component.run_timers();
  EXPECT_NE(component.node->recorded.subscriptions["imu"].lock(), nullptr);

  ASSERT_TRUE(component.set({"tilt", std::string("off")}).successful);
  component.run_timers();
  EXPECT_EQ(component.node->recorded.subscriptions["imu"].lock(), nullptr);
  EXPECT_THAT(component.log(), ElementsAre());
}

// Changes of parameters

TEST(Component, UsesAChangedSettingForTheNextCloud) {
  Component component;
  component.subscribe("ground");
  component.publish(Scene().message());
  const auto before = component.received("ground", 1)[0].width;

  ASSERT_TRUE(component.set({"max_range", 10.0}).successful);
  component.publish(Scene().message());

  EXPECT_LT(component.received("ground", 2)[1].width, before / 2);
  EXPECT_EQ(component.node->get_parameter("max_range").as_double(), 10);
}

TEST(Component, RejectsAnInvalidValueWithTheReasonOfFlagstone) {
  Component component;

  const auto height = component.set({"sensor_height", std::string("high")});
  const auto reach = component.set({"mount.reach", 2.0});

  EXPECT_FALSE(height.successful);
  EXPECT_THAT(height.reason, StartsWith("sensor_height: 'high' is not a height"));
  EXPECT_FALSE(reach.successful);
  EXPECT_THAT(reach.reason, HasSubstr("at least 1.5 times ego_radius"));
  EXPECT_EQ(component.node->get_parameter("sensor_height").as_double(), 1.73);
}

TEST(Component, RejectsChangesOfReadOnlyParameters) {
  Component component;

  const auto result = component.set({"method", std::string("patchwork")});

  EXPECT_FALSE(result.successful);
  EXPECT_THAT(result.reason, HasSubstr("read-only"));
}

TEST(Component, ShowsTheValuesThatFollowFromAChange) {
  Component component({{"method", std::string("patchwork")}});

  ASSERT_TRUE(component.set({"sensor", std::string("vlp-16")}).successful);

  const ParameterValues expected =
      SegmenterSettings({{"method", std::string("patchwork")}, {"sensor", std::string("vlp-16")}})
          .values();
  EXPECT_EQ(component.node->get_parameter("sensor_height").as_double(),
            std::get<double>(expected.at("sensor_height")));
  for (const auto& [name, value] : expected) {
    const auto shown = component.node->get_parameter(name);
    if (const auto* number = std::get_if<double>(&value)) {
      EXPECT_EQ(shown.as_double(), *number);
    }
    if (const auto* list = std::get_if<std::vector<double>>(&value)) {
      EXPECT_EQ(shown.as_double_array(), *list);
    }
  }
}

TEST(Component, KeepsGivenValuesWhenOthersFollow) {
  Component component({{"sensor_height", 0.5}});

  ASSERT_TRUE(component.set({"sensor", std::string("vlp-16")}).successful);

  EXPECT_EQ(component.node->get_parameter("sensor_height").as_double(), 0.5);
}

TEST(Component, KeepsItsEstimatesIfOnlyParametersOfTheNodeChange) {
  Component component({{"sensor_height", std::string("estimate")}});
  component.publish(Scene().message());
  component.diagnostics_with("clouds", "1");

  ASSERT_TRUE(component.set({"imu_time_constant", 2.0}).successful);
  component.publish(Scene().message());

  const auto status = component.diagnostics_with("clouds", "2");
  EXPECT_THAT(status.values.back().value, Not(HasSubstr("confidence")));
}

TEST(Component, DoesNotStartWithInvalidParameters) {
  EXPECT_THROW(Component({{"sensor", std::string("unknown-64")}}), std::exception);
  EXPECT_THROW(Component({{"input_type", std::string("std_msgs/msg/String")}}), std::exception);
  EXPECT_THROW(Component({{"max_range", 1000.0}}), std::exception);
  EXPECT_THROW(Component({{"queue_depth", std::int64_t{0}}}), std::exception);
}

TEST(Component, WarnsOfParametersThatItDoesNotHave) {
  Component component(
      {{"point.magrin", 0.2}, {"qos_overrides./points.subscription.depth", std::int64_t{2}}});

  EXPECT_THAT(component.log(), ElementsAre("parameters: 'point.magrin' is not a parameter of this "
                                           "node with method surface"));
}

// Diagnostics

TEST(Component, PublishesDiagnosticsWithItsPeriod) {
  Component component({{"diagnostics_period", 0.5}});
  component.subscribe("labelled");
  component.publish(Scene().message());

  const auto status = component.diagnostics_with("clouds", "1");

  EXPECT_EQ(component.node->recorded.timers.front().lock()->period.count(), 0.5);
  EXPECT_EQ(status.name, "ground_segmentation: ground segmentation");
  EXPECT_EQ(status.level, 0);
  const auto& array = *component.publisher<DiagnosticArray>("/diagnostics").published.back();
  EXPECT_EQ(array.header.stamp.sec, 12);
}

TEST(Component, CountsCloudsThatTheTransportLost) {
  Component component;
  const auto points = component.node->recorded.subscriptions.at("points").lock();
  rclcpp::QOSMessageLostInfo lost{.total_count = 5, .total_count_change = 5};

  points->options.event_callbacks.message_lost_callback(lost);

  component.diagnostics_with("dropped", "5");
  EXPECT_THAT(component.log(), ElementsAre(HasSubstr("the transport lost")));
}

}  // namespace
}  // namespace flagstone_ros
