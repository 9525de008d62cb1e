// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/map_files.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <span>
#include <vector>

#include "files/io/atomic_file.hpp"
#include "files/io/load_bytes.hpp"
#include "files/io/message.hpp"

namespace flagstone::io {
namespace {

template <class State>
Status save_state(const std::filesystem::path& path, const State& state) {
  return within_memory([&]() -> Status {
    std::vector<std::byte> bytes;
    if (Status status = state.to_bytes(bytes); !status.ok()) return status;
    return write_file(path, bytes);
  });
}

template <class State>
Status load_state(const std::filesystem::path& path, State& state) {
  return within_memory([&]() -> Status {
    std::vector<std::byte> bytes;
    if (Status status = load_bytes(path, bytes); !status.ok()) return status;
    Status status = state.from_bytes(bytes);
    return status.code() == StatusCode::bad_file ? with_path(path, status) : status;
  });
}

}  // namespace

Status save(const std::filesystem::path& path, const GroundMap& map) {
  return save_state(path, map);
}

Status save(const std::filesystem::path& path, const LabelVote& vote) {
  return save_state(path, vote);
}

Status save(const std::filesystem::path& path, const MovingPoints& moving) {
  return save_state(path, moving);
}

Status load(const std::filesystem::path& path, GroundMap& map) { return load_state(path, map); }

Status load(const std::filesystem::path& path, LabelVote& vote) { return load_state(path, vote); }

Status load(const std::filesystem::path& path, MovingPoints& moving) {
  return load_state(path, moving);
}

std::filesystem::path TileFiles::path_of(TileIndex index) const {
  return directory_ / fmt::format("{}_{}.tile", index.x, index.y);
}

Status TileFiles::put(TileIndex index, std::span<const std::byte> bytes) {
  return within_memory([&] { return write_file(path_of(index), bytes); });
}

Status TileFiles::get(TileIndex index, std::vector<std::byte>& bytes) const {
  return within_memory([&] { return load_bytes(path_of(index), bytes); });
}

}  // namespace flagstone::io
