// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// A target needs a source to precompile headers for; the tests use what it precompiles.
