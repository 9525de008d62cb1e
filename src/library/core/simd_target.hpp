// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flagstone {

/// The instruction sets that this build has code for and this machine can run, best first; the last
/// one is "scalar", plain C++ without vectors. On x86: avx3 (AVX-512), avx2, sse4, scalar.
std::vector<std::string> simd_targets();

/// The one in use.
std::string simd_target();

/// Uses this one from now on, in all threads and for whatever else stands on Highway in this
/// process; "" for the best. For benchmarks and tests; not while a segmenter is at work.
/// Throws std::invalid_argument naming those there are.
void use_simd_target(std::string_view name);

}  // namespace flagstone
