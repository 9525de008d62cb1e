// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flagstone {

/// The instruction sets that this build contains and this machine supports, best first. The last
/// one is "scalar": plain C++ without vectors. On x86: avx3 (AVX-512), avx2, sse4, scalar.
std::vector<std::string> simd_targets();

/// The instruction set in use.
std::string simd_target();

/// Selects an instruction set for all threads and all users of Highway in this process; "" selects
/// the best. For benchmarks and tests. Do not call it while a segmenter is running. Throws
/// std::invalid_argument listing the available instruction sets if `name` is not one of them.
void use_simd_target(std::string_view name);

}  // namespace flagstone
