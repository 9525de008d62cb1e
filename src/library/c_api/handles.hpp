// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "flagstone/flagstone.h"
#include "flagstone/gravity_aligned_segmenter.hpp"
#include "flagstone/make_segmenter.hpp"
#include "flagstone/mount.hpp"
#include "flagstone/segmentation.hpp"
#include "library/core/setting.hpp"
#include "library/mount/mount_settings.hpp"

/// The objects behind the handles of flagstone.h.

struct flagstone_settings {
  explicit flagstone_settings(flagstone::MethodConfig method_config)
      : config(std::move(method_config)), list(config.settings()) {
    std::ranges::move(flagstone::settings_of(mount), std::back_inserter(list));
  }
  flagstone_settings(const flagstone_settings&) = delete;  // `list` points into this object
  flagstone_settings& operator=(const flagstone_settings&) = delete;

  flagstone::MethodConfig config;
  flagstone::MountSettings mount{};
  std::vector<flagstone::Setting> list;
};

struct flagstone_segmenter {
  flagstone::GravityAlignedSegmenter method;
};

struct flagstone_segmentation {
  flagstone::Segmentation value;
};
