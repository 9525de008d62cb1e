// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

/// Semantic version of the library, "major.minor.patch". The build reads the version from here.
#define FLAGSTONE_VERSION "0.1.0"
