// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace flagstone::render {

/// A count with its thousands set apart: "124,668".
std::string grouped(std::size_t count);

/// A share in per cent with one decimal: "53.1 %"; of nothing: "0.0 %". What is not zero never
/// reads as zero: "<0.1 %".
std::string percent(std::size_t part, std::size_t whole);

}  // namespace flagstone::render
