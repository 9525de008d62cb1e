// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

/// Skips a test of something that Windows does not have: FLAGSTONE_SKIP_ON_WINDOWS("fork()"). The
/// test must still compile, so the functions that it calls exist on Windows but do nothing.
#ifdef _WIN32
#define FLAGSTONE_SKIP_ON_WINDOWS(what) GTEST_SKIP() << "Windows does not have " what
#else
#define FLAGSTONE_SKIP_ON_WINDOWS(what) static_cast<void>(0)
#endif
