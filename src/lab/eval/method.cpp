// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/method.hpp"

#include <utility>

namespace flagstone::eval {

Method method_of(std::string_view name, MethodConfig config, const MountSettings& mount) {
  return {.name = std::string(name),
          .title = std::string(method_title(name)),
          .config = std::move(config),
          .mount = mount,
          .labels = {},
          .label_map = io::LabelMap::flagstone};
}

}  // namespace flagstone::eval
