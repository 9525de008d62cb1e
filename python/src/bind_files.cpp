// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "files/io/cloud.hpp"
#include "files/io/label_files.hpp"
#include "files/io/read_cloud.hpp"
#include "files/io/write_cloud.hpp"
#include "library/core/did_you_mean.hpp"

namespace nb = nanobind;

namespace flagstone::python {
namespace {

template <class Number>
using Row = nb::ndarray<nb::numpy, Number, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
/// Name, type, count and byte offset of a field.
using FieldTuple = std::tuple<std::string, std::string, std::size_t, std::size_t>;

io::FieldType type_named(const std::string& name) {
  for (auto type = io::FieldType::int8; type <= io::FieldType::float64;
       type = static_cast<io::FieldType>(static_cast<int>(type) + 1)) {
    if (name == to_string(type)) return type;
  }
  throw nb::type_error(
      fmt::format("points: dtype {} cannot be written (expected integers of 8 to 64 bits, float32 "
                  "or float64)",
                  name)
          .c_str());
}

io::CloudFormat format_named(const std::string& name) {
  if (name == "raw") return io::CloudFormat::raw;
  if (name == "pcd") return io::CloudFormat::pcd;
  if (name == "ply") return io::CloudFormat::ply;
  if (name == "npy") return io::CloudFormat::npy;
  constexpr std::array<std::string_view, 4> names = {"raw", "pcd", "ply", "npy"};
  throw std::invalid_argument("format: " + no_such("format", name, names));
}

/// Moves the rows of a cloud to Python. Returns the bytes of the rows, the fields and the stride.
nb::tuple rows_of(io::Cloud cloud) {
  nb::list fields;
  for (const io::Field& field : cloud.fields()) {
    fields.append(nb::make_tuple(field.name, to_string(field.type), field.count, field.offset));
  }
  const std::size_t stride = cloud.stride();
  auto* const rows = new std::vector<std::byte>(cloud.release_rows());
  const nb::capsule owner(
      rows, [](void* memory) noexcept { delete static_cast<std::vector<std::byte>*>(memory); });
  return nb::make_tuple(
      Row<std::uint8_t>(reinterpret_cast<std::uint8_t*>(rows->data()), {rows->size()}, owner),
      fields, stride);
}

nb::tuple read_cloud(const std::string& path, int columns) {
  io::Cloud cloud;
  Status status;
  {
    const nb::gil_scoped_release released;
    status = io::read_cloud(path, {.columns = columns}, cloud);
  }
  raise_if_failed(status);
  return rows_of(std::move(cloud));
}

nb::tuple parse_cloud(const Row<const std::uint8_t>& bytes, const std::string& format,
                      std::size_t columns) {
  const io::CloudFormat known = format_named(format);
  io::Cloud cloud;
  Status status;
  {
    const nb::gil_scoped_release released;
    status = io::parse_cloud({reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()},
                             known, columns, cloud);
  }
  raise_if_failed(status);
  return rows_of(std::move(cloud));
}

void write_cloud(const std::string& path, const Row<const std::uint8_t>& rows,
                 const std::vector<FieldTuple>& tuples) {
  std::vector<io::Field> fields;
  fields.reserve(tuples.size());
  for (const auto& [name, type, count, offset] : tuples) {
    fields.push_back({.name = name, .type = type_named(type), .count = count, .offset = offset});
  }
  Status status;
  {
    const nb::gil_scoped_release released;
    const auto* const begin = reinterpret_cast<const std::byte*>(rows.data());
    io::Cloud cloud;
    status = io::Cloud::from_rows(std::move(fields), {begin, begin + rows.size()}, cloud);
    if (status.ok()) status = io::write_cloud(path, cloud);
  }
  raise_if_failed(status);
}

Row<std::uint32_t> read_classes(const std::string& path, std::size_t points) {
  auto classes = std::make_unique<std::vector<std::uint32_t>>();
  Status status;
  {
    const nb::gil_scoped_release released;
    status = io::read_reference(path, points, *classes);
  }
  raise_if_failed(status);
  auto* const kept = classes.release();
  const nb::capsule owner(
      kept, [](void* memory) noexcept { delete static_cast<std::vector<std::uint32_t>*>(memory); });
  return Row<std::uint32_t>(kept->data(), {kept->size()}, owner);
}

void write_labels(const std::string& path, const Row<const std::uint8_t>& labels,
                  bool semantic_kitti, bool npy) {
  Status status;
  {
    const nb::gil_scoped_release released;
    io::LabelWriter writer(semantic_kitti ? io::LabelMap::semantic_kitti : io::LabelMap::flagstone);
    const std::span<const Label> codes(reinterpret_cast<const Label*>(labels.data()),
                                       labels.size());
    status = npy ? writer.write_label_npy(path, codes) : writer.write_label_file(path, codes);
  }
  raise_if_failed(status);
}

nb::object format_of(const std::string& path) {
  const std::optional<io::CloudFormat> format = io::format_of(path);
  if (!format) return nb::none();
  switch (*format) {
    case io::CloudFormat::raw: return nb::str("raw");
    case io::CloudFormat::pcd: return nb::str("pcd");
    case io::CloudFormat::ply: return nb::str("ply");
    case io::CloudFormat::npy: return nb::str("npy");
  }
  return nb::none();
}

}  // namespace

void bind_files(nb::module_& module) {
  module.def("read_cloud", &read_cloud, nb::arg("path"), nb::arg("columns"),
             nb::sig("def read_cloud(path: str, columns: int) -> "
                     "tuple[numpy.typing.NDArray[numpy.uint8], list[tuple[str, str, int, int]], "
                     "int]"));
  module.def("parse_cloud", &parse_cloud, nb::arg("bytes"), nb::arg("format"), nb::arg("columns"),
             nb::sig("def parse_cloud(bytes: numpy.typing.NDArray[numpy.uint8], format: str, "
                     "columns: int) -> tuple[numpy.typing.NDArray[numpy.uint8], "
                     "list[tuple[str, str, int, int]], int]"));
  module.def("write_cloud", &write_cloud, nb::arg("path"), nb::arg("rows"), nb::arg("fields"),
             nb::sig("def write_cloud(path: str, rows: numpy.typing.NDArray[numpy.uint8], fields: "
                     "list[tuple[str, str, int, int]]) -> None"));
  module.def("read_classes", &read_classes, nb::arg("path"), nb::arg("points"),
             nb::sig("def read_classes(path: str, points: int) -> "
                     "numpy.typing.NDArray[numpy.uint32]"));
  module.def("write_labels", &write_labels, nb::arg("path"), nb::arg("labels"),
             nb::arg("semantic_kitti"), nb::arg("npy"),
             nb::sig("def write_labels(path: str, labels: numpy.typing.NDArray[numpy.uint8], "
                     "semantic_kitti: bool, npy: bool) -> None"));
  module.def("format_of", &format_of, nb::arg("path"),
             nb::sig("def format_of(path: str) -> str | None"));
  module.def(
      "is_scan_name", [](const std::string& path) { return io::is_scan_name(path); },
      nb::arg("path"));
}

}  // namespace flagstone::python
