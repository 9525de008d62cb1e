# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT

# cmake -D name=NAME -D file=FILE -D source=SOURCE -P embed.cmake
# writes the C++ file SOURCE, which defines embedded::NAME as the text of FILE. The standard does
# not require compilers to accept such long literals, hence the warning; GCC and clang accept them.
file(READ ${file} text)
file(WRITE ${source} "// Generated from ${file} by embed.cmake.
#include \"lab/report/embedded_files.hpp\"

#pragma GCC diagnostic ignored \"-Woverlength-strings\"

namespace flagstone::report::embedded {
namespace {
constexpr char text[] = R\"embedded(${text})embedded\";
}  // namespace

constinit const std::string_view ${name}(text, sizeof(text) - 1);
}  // namespace flagstone::report::embedded
")
