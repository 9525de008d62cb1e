// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// The target that precompiles headers for the tests needs a source file.
