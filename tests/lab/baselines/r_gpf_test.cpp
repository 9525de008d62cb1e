// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/baselines/r_gpf.hpp"

#include <gtest/gtest.h>

namespace flagstone {
namespace {

TEST(RGpf, HasAUniformGridOf3240Bins) {
  const PatchworkConfig config = r_gpf_config();

  ASSERT_EQ(config.zones.size(), 1u);
  EXPECT_EQ(config.zones[0].ring_radii.size() * static_cast<std::size_t>(config.zones[0].sectors),
            3240u);
  EXPECT_NO_THROW(config.check());
}

}  // namespace
}  // namespace flagstone
