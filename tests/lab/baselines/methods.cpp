// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "methods.hpp"

#include "flagstone/baselines/cascaded.hpp"
#include "flagstone/baselines/gpf.hpp"
#include "flagstone/baselines/line_fit.hpp"
#include "flagstone/baselines/r_gpf.hpp"
#include "flagstone/baselines/ransac.hpp"
#include "flagstone/patchwork.hpp"
#include "flagstone/surface.hpp"

namespace flagstone::tests {
namespace {

template <class SegmenterType>
std::unique_ptr<Segmenter> make() {
  return std::make_unique<SegmenterType>();
}

std::unique_ptr<Segmenter> make_r_gpf() { return std::make_unique<Patchwork>(r_gpf_config()); }

}  // namespace

std::vector<Method> methods() {
  return {
      {"Ransac", make<Ransac>, {}, 91.1, 93.7},
      {"Gpf", make<Gpf>, 4, 77.6, 79.8},
      {"LineFit", make<LineFit>, 4, 88.1, 91.9},
      {"Cascaded", make<Cascaded>, {}, 81.2, 85.5},
      {"RGpf", make_r_gpf, 4, 82.7, 87.4},
      {"Patchwork", make<Patchwork>, 1, 93.9, 97.6},
      {"Surface", make<Surface>, 0, 95.5, 98.8, false},
  };
}

std::vector<Method> order_free_methods() {
  std::vector<Method> all = methods();
  std::erase_if(all, [](const Method& method) { return !method.order_tolerance; });
  return all;
}

}  // namespace flagstone::tests
