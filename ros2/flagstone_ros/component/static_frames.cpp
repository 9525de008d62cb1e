// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "static_frames.hpp"

#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace flagstone_ros {

std::string_view frame_name(std::string_view frame) noexcept {
  return frame.starts_with('/') ? frame.substr(1) : frame;
}

void StaticFrames::set(std::string_view parent, std::string_view child,
                       const Transform& to_parent) {
  links_.insert_or_assign(std::string(frame_name(child)),
                          Link{std::string(frame_name(parent)), to_parent});
}

std::vector<std::string> StaticFrames::names() const {
  std::set<std::string> names;
  for (const auto& [child, link] : links_) {
    names.insert(child);
    names.insert(link.parent);
  }
  return {names.begin(), names.end()};
}

std::optional<Transform> StaticFrames::find(std::string_view from, std::string_view to) const {
  // The ancestors of a frame, beginning with the frame itself. A cycle, which a faulty publisher
  // can cause, ends at the number of links.
  const auto ancestors = [&](std::string_view frame) {
    std::vector<std::pair<std::string_view, Transform>> chain = {{frame_name(frame), {}}};
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const auto link = links_.find(chain.back().first);
      if (link == links_.end()) break;
      chain.emplace_back(link->second.parent, link->second.to_parent * chain.back().second);
    }
    return chain;
  };
  const auto sources = ancestors(from);
  const auto targets = ancestors(to);
  for (const auto& [source, from_to_common] : sources) {
    for (const auto& [target, to_to_common] : targets) {
      if (source == target) return inverse(to_to_common) * from_to_common;
    }
  }
  return std::nullopt;
}

}  // namespace flagstone_ros
