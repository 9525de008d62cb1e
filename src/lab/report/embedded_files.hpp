// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

/// Files embedded in the library: the files of the directory page/, and Chart.js.
namespace flagstone::report::embedded {

extern const std::string_view chart_js;
extern const std::string_view page_html;
extern const std::string_view style_css;
extern const std::string_view plots_js;
extern const std::string_view eval_html;
extern const std::string_view eval_js;
extern const std::string_view sweep_html;
extern const std::string_view sweep_js;

}  // namespace flagstone::report::embedded
