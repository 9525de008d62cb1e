// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <nanobind/nanobind.h>

#include <array>
#include <string>
#include <variant>

#include "app/config/method_choice.hpp"

namespace flagstone::python {

/// Metres, `estimate` or `track`; none as the settings have it.
using Height = std::variant<std::monostate, float, std::string>;
/// Where up is, `off` or `estimate`; none as the settings have it.
using Tilt = std::variant<std::monostate, std::array<float, 3>, std::string>;

/// Settings by name; a table is a mapping.
using Settings = nanobind::typed<nanobind::dict, nanobind::str, nanobind::any>;

/// A Python object as the value of setting `key`: numbers, truth values, texts, sequences and
/// mappings, those of NumPy too. Throws nanobind::type_error naming the key for anything else.
config::Value value_of(nanobind::handle object, const std::string& key = "");

/// Throws std::invalid_argument.
config::MountChoice mount_choice(const Height& sensor_height, const Tilt& tilt);

}  // namespace flagstone::python
