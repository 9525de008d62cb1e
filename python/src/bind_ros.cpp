// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "files/ros/coordinates.hpp"
#include "files/ros/derived_cloud.hpp"
#include "files/ros/field_convention.hpp"
#include "files/ros/livox_message.hpp"
#include "files/ros/point_cloud2.hpp"

namespace nb = nanobind;

namespace flagstone::python {
namespace {

using Bytes =
    nb::ndarray<nb::numpy, const std::uint8_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
/// Name, offset, datatype and count of a field.
using FieldTuple = std::tuple<std::string, std::uint32_t, std::uint8_t, std::uint32_t>;
/// Name, datatype and values of a field to add.
using AddedTuple = std::tuple<std::string, std::uint8_t, Bytes>;
/// Sequence number, seconds, nanoseconds and frame.
using HeaderTuple = std::tuple<std::uint32_t, std::int64_t, std::uint32_t, std::string>;

ros::Encoding encoding_named(const std::string& name) {
  if (name == "cdr") return ros::Encoding::cdr;
  if (name == "ros1") return ros::Encoding::ros1;
  throw std::invalid_argument(
      fmt::format("encoding: '{}' is not an encoding (expected cdr or ros1)", name));
}

std::span<const std::byte> bytes_of(const Bytes& array) {
  return {reinterpret_cast<const std::byte*>(array.data()), array.size()};
}

/// Text of a message, which may have any bytes.
nb::object text(std::string_view bytes) {
  return nb::steal(
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "replace"));
}

nb::object name_of(const ros::PointField* field) {
  return field == nullptr ? nb::none() : text(field->name);
}

/// New bytes, whose contents are not yet written.
nb::object new_bytes(std::size_t size) {
  nb::object bytes = nb::steal(PyBytes_FromStringAndSize(nullptr, static_cast<Py_ssize_t>(size)));
  if (!bytes.is_valid()) throw nb::python_error();
  return bytes;
}

std::span<std::byte> contents_of(const nb::object& bytes, std::size_t size) {
  return {reinterpret_cast<std::byte*>(PyBytes_AsString(bytes.ptr())), size};
}

/// A message in the memory of a Python object that supports the buffer protocol. Keeps the buffer
/// valid for its own lifetime. Does not change after its construction, so threads may share it.
class Message {
 public:
  Message(nb::handle object, const std::string& encoding, bool is_livox) {
    const ros::Encoding known = encoding_named(encoding);
    if (PyObject_GetBuffer(object.ptr(), &buffer_, PyBUF_SIMPLE) != 0) throw nb::python_error();
    const std::span bytes(static_cast<const std::byte*>(buffer_.buf),
                          static_cast<std::size_t>(buffer_.len));
    const Status status = is_livox ? ros::parse_livox(bytes, known, cloud_, livox_)
                                   : ros::parse(bytes, known, cloud_);
    if (status.ok()) return;
    PyBuffer_Release(&buffer_);
    raise_if_failed(status);
  }
  ~Message() { PyBuffer_Release(&buffer_); }
  Message(const Message&) = delete;
  Message& operator=(const Message&) = delete;
  Message(Message&&) = delete;
  Message& operator=(Message&&) = delete;

  [[nodiscard]] nb::tuple header() const {
    const ros::Header& header = cloud_.header;
    return nb::make_tuple(header.seq, header.sec, header.nanosec, text(header.frame_id));
  }

  [[nodiscard]] nb::list fields() const {
    nb::list list;
    for (const ros::PointField& field : cloud_.fields) {
      list.append(nb::make_tuple(text(field.name), field.offset, static_cast<unsigned>(field.type),
                                 field.count));
    }
    return list;
  }

  /// Offset of the data in the message, distance between rows, distance between points.
  [[nodiscard]] nb::tuple data_layout() const {
    const auto* const begin = static_cast<const std::byte*>(buffer_.buf);
    const std::size_t offset =
        cloud_.data.empty() ? 0 : static_cast<std::size_t>(cloud_.data.data() - begin);
    return nb::make_tuple(offset, cloud_.row_stride(), cloud_.point_stride());
  }

  /// Offset of x in a point and the distance between x, y and z, if they are zero-copy and evenly
  /// spaced; otherwise nothing.
  [[nodiscard]] nb::object zero_copy_layout() const {
    std::vector<float> none;
    if (!ros::has_native_coordinates(cloud_)) return nb::none();
    CloudView view;
    raise_if_failed(ros::view_coordinates(cloud_, none, view));
    const CloudLayout& layout = view.layout();
    if (layout.y - layout.x != layout.z - layout.y) return nb::none();
    return nb::make_tuple(layout.x, layout.y - layout.x);
  }

  /// A copy of x, y and z of every point.
  [[nodiscard]] nb::ndarray<nb::numpy, float, nb::ndim<2>> copied_coordinates() const {
    auto* const memory = new std::vector<float>();
    const nb::capsule owner(
        memory, [](void* kept) noexcept { delete static_cast<std::vector<float>*>(kept); });
    Status status;
    {
      const nb::gil_scoped_release released;
      CloudView view;
      status = ros::view_coordinates(cloud_, *memory, view);
      if (status.ok() && memory->empty()) {
        memory->reserve(3 * view.size());
        for (std::size_t i = 0; i < view.size(); ++i) {
          const Point point = view[i];
          memory->insert(memory->end(), {point.x, point.y, point.z});
        }
      }
    }
    raise_if_failed(status);
    return {memory->data(), {cloud_.size(), 3}, owner};
  }

  /// x, y and z of every point in another frame.
  [[nodiscard]] nb::ndarray<nb::numpy, float, nb::ndim<2>> transformed_coordinates(
      const std::array<double, 9>& rotation, const std::array<double, 3>& translation) const {
    auto* const memory = new std::vector<float>();
    const nb::capsule owner(
        memory, [](void* kept) noexcept { delete static_cast<std::vector<float>*>(kept); });
    Status status;
    {
      const nb::gil_scoped_release released;
      status = ros::transform_coordinates(
          cloud_, {.rotation = rotation, .translation = translation}, *memory);
    }
    raise_if_failed(status);
    return {memory->data(), {cloud_.size(), 3}, owner};
  }

  [[nodiscard]] nb::object append(const std::vector<AddedTuple>& added) const {
    return derive(added, [](ros::DerivedCloud& derived, const ros::PointCloud2View& cloud,
                            std::span<const ros::AddedField> fields) {
      return derived.append(cloud, fields);
    });
  }

  [[nodiscard]] nb::object select(const Bytes& mask, const std::vector<AddedTuple>& added) const {
    return derive(added, [&](ros::DerivedCloud& derived, const ros::PointCloud2View& cloud,
                             std::span<const ros::AddedField> fields) {
      return derived.select(cloud, ros::Selection({mask.data(), mask.size()}), fields);
    });
  }

  [[nodiscard]] nb::tuple convention() const {
    const ros::FieldConvention found = ros::recognize(cloud_.fields);
    const bool is_absolute = found.time_reference == ros::TimeReference::clock;
    return nb::make_tuple(to_string(found.convention), name_of(found.time), found.seconds_per_unit,
                          is_absolute ? "clock" : "header_stamp", name_of(found.ring),
                          name_of(found.intensity));
  }

  [[nodiscard]] const ros::PointCloud2View& cloud() const { return cloud_; }
  [[nodiscard]] const ros::LivoxMessage& livox() const { return livox_; }

 private:
  template <class Plan>
  nb::object derive(const std::vector<AddedTuple>& added, const Plan& plan) const {
    std::vector<ros::AddedField> fields;
    fields.reserve(added.size());
    for (const auto& [name, type, values] : added) {
      fields.push_back({name, static_cast<ros::PointFieldType>(type), bytes_of(values)});
    }
    ros::DerivedCloud derived;
    Status status;
    std::size_t size = 0;
    {
      const nb::gil_scoped_release released;
      status = plan(derived, cloud_, fields);
      if (status.ok()) size = derived.message_size();
    }
    raise_if_failed(status);
    nb::object message = new_bytes(size);
    const std::span<std::byte> contents = contents_of(message, size);
    {
      const nb::gil_scoped_release released;
      derived.write_message(contents);
    }
    return message;
  }

  Py_buffer buffer_{};
  ros::PointCloud2View cloud_;
  ros::LivoxMessage livox_;
};

nb::object serialize_cloud(const std::string& encoding, const HeaderTuple& header,
                           std::uint32_t height, std::uint32_t width,
                           const std::vector<FieldTuple>& fields, std::uint32_t point_step,
                           bool is_dense, const Bytes& data) {
  ros::PointCloud2View cloud;
  cloud.format.encoding = encoding_named(encoding);
  const auto& [seq, sec, nanosec, frame_id] = header;
  cloud.header = {.seq = seq, .sec = sec, .nanosec = nanosec, .frame_id = frame_id};
  cloud.height = height;
  cloud.width = width;
  for (const auto& [name, offset, type, count] : fields) {
    cloud.fields.push_back({name, offset, static_cast<ros::PointFieldType>(type), count});
  }
  cloud.point_step = point_step;
  cloud.row_step = width * point_step;
  cloud.is_dense = is_dense;
  cloud.data = bytes_of(data);
  raise_if_failed(ros::check(cloud));
  const std::size_t size = ros::serialized_size(cloud, cloud.data.size());
  nb::object message = new_bytes(size);
  const std::span<std::byte> contents = contents_of(message, size);
  {
    const nb::gil_scoped_release released;
    const std::span<std::byte> to = ros::serialize_around(cloud, cloud.data.size(), contents);
    std::ranges::copy(cloud.data, to.begin());
  }
  return message;
}

template <auto Member>
auto member(const Message& message) {
  return message.cloud().*Member;
}

}  // namespace

void bind_ros(nb::module_& module) {
  using ros::PointCloud2View;
  nb::class_<Message>(module, "RosMessage")
      .def(nb::init<nb::handle, const std::string&, bool>(), nb::arg("message"),
           nb::arg("encoding"), nb::arg("is_livox"),
           nb::sig("def __init__(self, message: object, encoding: str, is_livox: bool) -> None"))
      .def("header", &Message::header, nb::sig("def header(self) -> tuple[int, int, int, str]"))
      .def("fields", &Message::fields,
           nb::sig("def fields(self) -> list[tuple[str, int, int, int]]"))
      .def_prop_ro("height", member<&PointCloud2View::height>)
      .def_prop_ro("width", member<&PointCloud2View::width>)
      .def_prop_ro("point_step", member<&PointCloud2View::point_step>)
      .def_prop_ro("row_step", member<&PointCloud2View::row_step>)
      .def_prop_ro("is_bigendian", member<&PointCloud2View::is_bigendian>)
      .def_prop_ro("is_dense", member<&PointCloud2View::is_dense>)
      .def_prop_ro("timebase", [](const Message& message) { return message.livox().timebase; })
      .def_prop_ro("lidar_id", [](const Message& message) { return message.livox().lidar_id; })
      .def("data_layout", &Message::data_layout,
           nb::sig("def data_layout(self) -> tuple[int, int, int]"))
      .def("zero_copy_layout", &Message::zero_copy_layout,
           nb::sig("def zero_copy_layout(self) -> tuple[int, int] | None"))
      .def("copied_coordinates", &Message::copied_coordinates,
           nb::sig("def copied_coordinates(self) -> numpy.typing.NDArray[numpy.float32]"))
      .def("transformed_coordinates", &Message::transformed_coordinates, nb::arg("rotation"),
           nb::arg("translation"),
           nb::sig("def transformed_coordinates(self, rotation: list[float], translation: "
                   "list[float]) -> numpy.typing.NDArray[numpy.float32]"))
      .def("convention", &Message::convention,
           nb::sig("def convention(self) -> tuple[str, str | None, float, str, str | None, "
                   "str | None]"))
      .def("append", &Message::append, nb::arg("added"),
           nb::sig("def append(self, added: list[tuple[str, int, "
                   "numpy.typing.NDArray[numpy.uint8]]]) -> bytes"))
      .def("select", &Message::select, nb::arg("mask"), nb::arg("added"),
           nb::sig("def select(self, mask: numpy.typing.NDArray[numpy.uint8], added: "
                   "list[tuple[str, int, numpy.typing.NDArray[numpy.uint8]]]) -> bytes"));
  module.def(
      "serialize_cloud", &serialize_cloud, nb::arg("encoding"), nb::arg("header"),
      nb::arg("height"), nb::arg("width"), nb::arg("fields"), nb::arg("point_step"),
      nb::arg("is_dense"), nb::arg("data"),
      nb::sig("def serialize_cloud(encoding: str, header: tuple[int, int, int, str], height: int, "
              "width: int, fields: list[tuple[str, int, int, int]], point_step: int, is_dense: "
              "bool, data: numpy.typing.NDArray[numpy.uint8]) -> bytes"));
}

}  // namespace flagstone::python
