// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/ros/coordinates.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "files/io/message.hpp"
#include "files/io/rows.hpp"
#include "files/ros/serialization.hpp"

namespace flagstone::ros {
namespace {

constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};

Status missing(const PointCloud2View& cloud, std::string_view name) {
  constexpr std::size_t most_named = 8;
  std::string names;
  for (std::size_t i = 0; i < std::min(cloud.fields.size(), most_named); ++i) {
    if (i > 0) names += ' ';
    names += io::quote(cloud.fields[i].name);
  }
  if (cloud.fields.size() > most_named) names += " ...";
  return Status(StatusCode::bad_file,
                fmt::format("no field {} (expected x, y and z; the fields are: {})",
                            io::quote(name), names.empty() ? "none" : names));
}

Status find_axis(const PointCloud2View& cloud, std::string_view name, const PointField*& out) {
  out = cloud.find(name);
  if (out == nullptr) return missing(cloud, name);
  if (out->numbers() != 1) {
    return Status(StatusCode::bad_file,
                  fmt::format("field {} has count {} (expected 1)", io::quote(name), out->count));
  }
  if (!number_type(out->type) || out->type == PointFieldType::boolean) {
    return Status(
        StatusCode::bad_file,
        fmt::format("field {} has datatype {} (expected 1 to 10: integers, float32 or float64)",
                    io::quote(name), static_cast<unsigned>(out->type)));
  }
  return {};
}

Status find_axes(const PointCloud2View& cloud, std::array<const PointField*, 3>& out) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (Status status = find_axis(cloud, axes[axis], out[axis]); !status.ok()) return status;
  }
  return {};
}

bool is_native(const PointCloud2View& cloud) noexcept {
  return cloud.is_bigendian == (std::endian::native == std::endian::big);
}

template <class T, bool Swap>
float load_number(const std::byte* from) noexcept {
  if constexpr (Swap && sizeof(T) > 1) {
    std::array<std::byte, sizeof(T)> bytes{};
    std::reverse_copy(from, from + sizeof(T), bytes.begin());
    return static_cast<float>(std::bit_cast<T>(bytes));
  } else {
    return static_cast<float>(io::load<T>(from));
  }
}

/// Converts one coordinate of all points to `to`, in steps of three floats.
template <class T, bool Swap>
void convert_axis(const PointCloud2View& cloud, std::size_t offset, float* to) noexcept {
  const std::size_t stride = cloud.point_stride();
  for (std::size_t row = 0; row < cloud.height; ++row) {
    const std::byte* const from = cloud.data.data() + row * cloud.row_stride() + offset;
    for (std::size_t i = 0; i < cloud.width; ++i, to += 3) {
      *to = load_number<T, Swap>(from + i * stride);
    }
  }
}

/// x of a point that would be transformed to (0, 0, 0), which means a missing return.
constexpr float next_to_origin = 1e-6f;

/// Without branches, so that the compiler can vectorise it.
void transform_point(const Point& p, const RigidTransform& transform, float* to) noexcept {
  const auto& [r, t] = transform;
  const double x = p.x, y = p.y, z = p.z;
  const bool is_missing = (p.x == 0) & (p.y == 0) & (p.z == 0);
  const auto moved_x = static_cast<float>(r[0] * x + r[1] * y + r[2] * z + t[0]);
  const auto moved_y = static_cast<float>(r[3] * x + r[4] * y + r[5] * z + t[1]);
  const auto moved_z = static_cast<float>(r[6] * x + r[7] * y + r[8] * z + t[2]);
  const bool is_at_origin = (moved_x == 0) & (moved_y == 0) & (moved_z == 0);
  to[0] = is_missing ? 0 : is_at_origin ? next_to_origin : moved_x;
  to[1] = is_missing ? 0 : moved_y;
  to[2] = is_missing ? 0 : moved_z;
}

}  // namespace

bool has_native_coordinates(const PointCloud2View& cloud) noexcept {
  return is_native(cloud) && cloud.rows_are_contiguous() &&
         std::ranges::all_of(axes, [&](std::string_view name) {
           const PointField* const field = cloud.find(name);
           return field != nullptr && field->type == PointFieldType::float32;
         });
}

Status view_coordinates(const PointCloud2View& cloud, std::vector<float>& copy, CloudView& out) {
  return io::within_memory([&] {
    std::array<const PointField*, 3> fields{};
    if (Status status = find_axes(cloud, fields); !status.ok()) return status;
    if (cloud.size() == 0) {
      out = CloudView();
    } else if (has_native_coordinates(cloud)) {
      const auto offset = [](const PointField* field) {
        return static_cast<std::ptrdiff_t>(field->offset);
      };
      out = CloudView(cloud.data.data(), cloud.size(),
                      CloudLayout{static_cast<std::ptrdiff_t>(cloud.point_stride()),
                                  offset(fields[0]), offset(fields[1]), offset(fields[2])});
    } else {
      copy.resize(3 * cloud.size());
      for (std::size_t axis = 0; axis < 3; ++axis) {
        io::visit_type(*number_type(fields[axis]->type), [&]<class T>() {
          const auto convert = is_native(cloud) ? convert_axis<T, false> : convert_axis<T, true>;
          convert(cloud, fields[axis]->offset, copy.data() + axis);
        });
      }
      out = CloudView(copy.data(), cloud.size());
    }
    return Status();
  });
}

Status transform_coordinates(const PointCloud2View& cloud, const RigidTransform& transform,
                             std::vector<float>& out) {
  std::vector<float> copy;
  CloudView view;
  if (Status status = view_coordinates(cloud, copy, view); !status.ok()) return status;
  return io::within_memory([&] {
    out.resize(3 * view.size());
    for (std::size_t i = 0; i < view.size(); ++i) {
      transform_point(view[i], transform, out.data() + 3 * i);
    }
    return Status();
  });
}

}  // namespace flagstone::ros
