// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <nanobind/nanobind.h>

#include <array>
#include <string>
#include <variant>

#include "app/config/method_choice.hpp"

namespace flagstone::python {

/// Sensor height: metres, `estimate` or `track`; monostate to use the settings.
using Height = std::variant<std::monostate, float, std::string>;
/// Tilt: up direction, `off` or `estimate`; monostate to use the settings.
using Tilt = std::variant<std::monostate, std::array<float, 3>, std::string>;

/// Settings by name; tables are mappings.
using Settings = nanobind::typed<nanobind::dict, nanobind::str, nanobind::any>;

/// Converts a Python or NumPy object to the value of setting `key`: a number, boolean, string,
/// sequence or mapping. Throws nanobind::type_error with the key for any other object.
config::Value value_of(nanobind::handle object, const std::string& key = "");

/// Converts the arguments `sensor_height` and `tilt`. Throws std::invalid_argument if a word is
/// unknown.
config::MountChoice mount_choice(const Height& sensor_height, const Tilt& tilt);

}  // namespace flagstone::python
