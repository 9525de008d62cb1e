// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "flagstone/make_segmenter.hpp"
#include "flagstone/sensor.hpp"

namespace flagstone::config {

/// Settings for a sensor at the height that they end up with: `settings_at` makes them for a sensor
/// and lays over them whatever the user sets; where that sets another height above the ground,
/// they are made once more for it.
MethodConfig settings_at_own_height(Sensor sensor,
                                    const std::function<MethodConfig(const Sensor&)>& settings_at);

}  // namespace flagstone::config
