// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Measures the codec for PointCloud2 messages: messages of 120,000 points, as drivers publish them,
// are parsed, viewed, labelled and divided. Prints Markdown.

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "files/ros/coordinates.hpp"
#include "files/ros/derived_cloud.hpp"
#include "files/ros/point_cloud2.hpp"
#include "library/core/random.hpp"
#include "timing.hpp"

namespace flagstone::performance {
namespace {

using Message = std::vector<std::byte>;

constexpr std::uint32_t points = 120000;

// Messages take turns, so that none is still in the cache from its last turn.
constexpr std::size_t turns = 32;

struct Layout {
  std::string_view name;
  std::uint32_t point_step;
  ros::PointFieldType coordinates;
  bool is_bigendian;
};

constexpr std::array layouts{
    Layout{"x, y, z, intensity", 16, ros::PointFieldType::float32, false},
    Layout{"Velodyne", 22, ros::PointFieldType::float32, false},
    Layout{"Hesai, Livox", 26, ros::PointFieldType::float32, false},
    Layout{"PCL, padded", 32, ros::PointFieldType::float32, false},
    Layout{"Ouster", 48, ros::PointFieldType::float32, false},
    Layout{"big-endian", 16, ros::PointFieldType::float32, true},
    Layout{"float64", 32, ros::PointFieldType::float64, false},
};

void require_ok(const Status& status) {
  if (!status.ok()) throw std::runtime_error(status.message());
}

Message message_of(const Layout& layout) {
  ros::PointCloud2View cloud;
  cloud.height = 1;
  cloud.width = points;
  const auto size = static_cast<std::uint32_t>(ros::size_of(layout.coordinates));
  cloud.fields = {{"x", 0, layout.coordinates, 1},
                  {"y", size, layout.coordinates, 1},
                  {"z", 2 * size, layout.coordinates, 1}};
  cloud.is_bigendian = layout.is_bigendian;
  cloud.point_step = layout.point_step;
  cloud.row_step = points * layout.point_step;
  const std::vector<std::byte> data(cloud.row_step, std::byte{1});
  cloud.data = data;
  Message message;
  require_ok(ros::serialize(cloud, message));
  return message;
}

/// Labels in runs of random lengths, as scans along a beam have them; 60 % ground.
std::vector<Label> labels_in_runs() {
  std::vector<Label> labels;
  Random random(1);
  while (labels.size() < points) {
    const Label label = random.uniform() < 0.6 ? Label::ground : Label::nonground;
    labels.insert(labels.end(), 1 + static_cast<std::size_t>(random.uniform() * 20), label);
  }
  labels.resize(points);
  return labels;
}

/// The steps for one layout, each with a message that is not in the cache.
class Steps {
 public:
  explicit Steps(const Layout& layout) : messages_(turns, message_of(layout)) {}

  void view() {
    CloudView out;
    parse_next();
    require_ok(ros::view_coordinates(cloud_, copy_, out));
  }

  void append() {
    const std::array added{ros::label_field(labels_), ros::height_field(heights_)};
    parse_next();
    require_ok(derived_.append(cloud_, added));
    require_ok(derived_.write_message(out_));
  }

  void divide() {
    parse_next();
    require_ok(derived_.select(cloud_, ros::Selection(labels_, {Label::ground})));
    require_ok(derived_.write_message(out_));
    require_ok(derived_.select(cloud_, ros::Selection(labels_, {Label::nonground})));
    require_ok(derived_.write_message(other_));
  }

  void copy() {
    const Message& message = next();
    out_.resize(message.size());
    std::memcpy(out_.data(), message.data(), message.size());
  }

 private:
  const Message& next() { return messages_[turn_++ % turns]; }
  void parse_next() { require_ok(ros::parse(next(), ros::Encoding::cdr, cloud_)); }

  std::vector<Message> messages_;
  std::size_t turn_ = 0;
  std::vector<Label> labels_ = labels_in_runs();
  std::vector<float> heights_ = std::vector<float>(points, 0.5F);
  ros::PointCloud2View cloud_;
  std::vector<float> copy_;
  ros::DerivedCloud derived_;
  Message out_, other_;
};

void print_row(const Layout& layout) {
  Steps steps(layout);
  const double view = time_of([&] { steps.view(); }).median;
  const double append = time_of([&] { steps.append(); }).median;
  const double divide = time_of([&] { steps.divide(); }).median;
  const double copy = time_of([&] { steps.copy(); }).median;
  fmt::print("| {} | {} | {:.1f} | {:.2f} | {:.2f} | {:.2f} |\n", layout.name, layout.point_step,
             1000 * view, append, divide, copy);
  std::fflush(stdout);
}

}  // namespace
}  // namespace flagstone::performance

int main() {
  using namespace flagstone::performance;
  try {
    fmt::print(
        "Time per message of {} points, median:\n\n"
        "| fields | bytes per point | view, µs | append label and height, ms | ground and "
        "non-ground, ms | "
        "memcpy, ms |\n|---|--:|--:|--:|--:|--:|\n",
        points);
    for (const Layout& layout : layouts) print_row(layout);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "codec: %s\n", error.what());
    return 1;
  }
  return 0;
}
