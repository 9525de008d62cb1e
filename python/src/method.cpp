// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "method.hpp"

#include <fmt/format.h>
#include <nanobind/stl/string.h>

#include <cstdint>
#include <limits>
#include <stdexcept>

namespace nb = nanobind;

namespace flagstone::python {
namespace {

std::string name_of_type(nb::handle object) {
  return nb::cast<std::string>(nb::str(object.type().attr("__name__")));
}

bool is_boolean(nb::handle object) {
  if (PyBool_Check(object.ptr())) return true;
  const std::string name = name_of_type(object);
  return name == "bool_" || name == "bool";  // of NumPy
}

/// Integers that do not fit are clamped to 64 bits. No setting allows these limits.
std::int64_t clamped_integer(nb::handle object) {
  const nb::object whole = nb::steal(PyNumber_Index(object.ptr()));
  if (!whole.is_valid()) throw nb::python_error();
  int overflow = 0;
  const long long number = PyLong_AsLongLongAndOverflow(whole.ptr(), &overflow);
  if (overflow == 0) return number;
  return overflow > 0 ? std::numeric_limits<std::int64_t>::max()
                      : std::numeric_limits<std::int64_t>::min();
}

config::Value::Table table_of(nb::handle mapping, const std::string& key) {
  config::Value::Table table;
  for (const nb::handle item : nb::list(mapping.attr("items")())) {
    const std::string name = nb::cast<std::string>(nb::str(item[0]));
    table.push_back({name, value_of(item[1], key.empty() ? name : key + "." + name)});
  }
  return table;
}

}  // namespace

config::Value value_of(nb::handle object, const std::string& key) {
  if (is_boolean(object)) return {.held = PyObject_IsTrue(object.ptr()) == 1};
  if (PyLong_Check(object.ptr())) return {.held = clamped_integer(object)};
  if (nb::isinstance<nb::str>(object)) return {.held = nb::cast<std::string>(object)};
  if (nb::hasattr(object, "items")) return {.held = table_of(object, key)};
  const bool is_bytes = PyBytes_Check(object.ptr()) != 0;
  if (!is_bytes && PySequence_Check(object.ptr()) != 0) {
    config::Value::List list;
    for (const nb::handle element : nb::list(nb::borrow(object))) {
      list.push_back(value_of(element, key));
    }
    return {.held = std::move(list)};
  }
  if (PyIndex_Check(object.ptr()) != 0) return {.held = clamped_integer(object)};
  if (nb::hasattr(object, "__float__")) {
    const double number = PyFloat_AsDouble(object.ptr());
    if (number == -1 && PyErr_Occurred() != nullptr) throw nb::python_error();
    return {.held = number};
  }
  throw nb::type_error(fmt::format("{}: {} is not a type of settings (expected a number, boolean, "
                                   "string, list or dict)",
                                   key, name_of_type(object))
                           .c_str());
}

config::MountChoice mount_choice(const Height& sensor_height, const Tilt& tilt) {
  config::MountChoice mount;
  const auto named = [](const char* argument, const auto& read) {
    try {
      read();
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("{}: {}", argument, error.what()));
    }
  };
  if (const auto* metres = std::get_if<float>(&sensor_height)) mount.set_height(*metres);
  if (const auto* word = std::get_if<std::string>(&sensor_height)) {
    named("sensor_height", [&] { mount.set_height(std::string_view(*word)); });
  }
  if (const auto* up = std::get_if<std::array<float, 3>>(&tilt)) mount.set_tilt(*up);
  if (const auto* word = std::get_if<std::string>(&tilt)) {
    named("tilt", [&] { mount.set_tilt(std::string_view(*word)); });
  }
  return mount;
}

}  // namespace flagstone::python
