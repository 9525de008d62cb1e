// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "transform.hpp"

namespace flagstone_ros {

/// The frames that /tf_static connects. Not thread-safe.
class StaticFrames {
 public:
  /// Adds or replaces the transform of points in the frame `child` to the frame `parent`.
  void set(std::string_view parent, std::string_view child, const Transform& to_parent);

  /// The transform of points in the frame `from` to the frame `to`; nothing if the frames are not
  /// connected. A leading slash of a name is ignored.
  [[nodiscard]] std::optional<Transform> find(std::string_view from, std::string_view to) const;

  /// The names of all frames, in alphabetical order.
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  struct Link {
    std::string parent;
    Transform to_parent;
  };
  std::map<std::string, Link, std::less<>> links_;  // by child
};

/// The name of a frame without a leading slash, which tf2 does not use.
[[nodiscard]] std::string_view frame_name(std::string_view frame) noexcept;

}  // namespace flagstone_ros
