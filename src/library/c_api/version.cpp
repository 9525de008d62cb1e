// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/version.hpp"

#include "flagstone/flagstone.h"

uint32_t flagstone_abi_version(void) { return FLAGSTONE_ABI_VERSION; }

const char* flagstone_version(void) { return FLAGSTONE_VERSION; }
