// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "flagstone/ground_map.hpp"
#include "flagstone/label_vote.hpp"
#include "flagstone/moving_points.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

/// Writes the state of a map or of votes to a file, atomically; see write_file() and to_bytes().
/// Never throws.
Status save(const std::filesystem::path& path, const GroundMap& map);
/// As above, for votes.
Status save(const std::filesystem::path& path, const LabelVote& vote);
/// As above, for the scans and static objects that find moving points.
Status save(const std::filesystem::path& path, const MovingPoints& moving);

/// Replaces the state of a map or of votes by a saved one; see load_bytes() and from_bytes(). The
/// message begins with the path. On failure the state is as before. Never throws.
Status load(const std::filesystem::path& path, GroundMap& map);
/// As above, for votes.
Status load(const std::filesystem::path& path, LabelVote& vote);
/// As above, for the scans and static objects that find moving points.
Status load(const std::filesystem::path& path, MovingPoints& moving);

/// Keeps the tiles of a map as files in a directory, X_Y.tile, which must exist. The files belong
/// to one map and can be removed after it. Errors are those of write_file() and load_bytes().
class TileFiles : public TileStore {
 public:
  explicit TileFiles(std::filesystem::path directory) : directory_(std::move(directory)) {}

  Status put(TileIndex index, std::span<const std::byte> bytes) override;
  Status get(TileIndex index, std::vector<std::byte>& bytes) const override;

 private:
  [[nodiscard]] std::filesystem::path path_of(TileIndex index) const;

  std::filesystem::path directory_;
};

}  // namespace flagstone::io
