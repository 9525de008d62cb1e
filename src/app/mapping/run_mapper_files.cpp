// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// The files of a RunMapper.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "app/mapping/run_mapper.hpp"
#include "files/io/atomic_file.hpp"
#include "files/io/load_bytes.hpp"
#include "files/io/map_files.hpp"
#include "files/io/message.hpp"
#include "library/ground_map/state_bytes.hpp"

namespace flagstone::app {
namespace {

constexpr std::string_view magic = "fsmapr01";

/// The files of a state.
struct StateFiles {
  std::filesystem::path directory;

  [[nodiscard]] std::filesystem::path scans() const { return directory / "scans.bin"; }
  [[nodiscard]] std::filesystem::path map() const { return directory / "map.bin"; }
  [[nodiscard]] std::filesystem::path votes() const { return directory / "votes.bin"; }
  [[nodiscard]] std::filesystem::path moving() const { return directory / "moving.bin"; }
};

void write(const Levelling& levelling, StateWriter& writer) {
  writer.add(std::uint8_t{levelling.applied});
  writer.add(std::uint64_t{levelling.cells});
  writer.add(levelling.offset);
  writer.add(levelling.slope_x);
  writer.add(levelling.slope_y);
}

/// False if a number is not possible.
bool read(StateReader& reader, Levelling& levelling) {
  const auto applied = reader.read<std::uint8_t>();
  levelling.applied = applied != 0;
  levelling.cells = static_cast<std::size_t>(reader.read<std::uint64_t>());
  levelling.offset = reader.read<double>();
  levelling.slope_x = reader.read<double>();
  levelling.slope_y = reader.read<double>();
  return applied <= 1 && std::isfinite(levelling.offset) && std::isfinite(levelling.slope_x) &&
         std::isfinite(levelling.slope_y) && !reader.failed();
}

/// The scans of a RunMapper that later results depend on.
struct SavedScans {
  struct Open {
    std::size_t index = 0;
    bool fits = true;
    Levelling levelling;
  };

  bool is_finished = false;
  LevellingJudge::State judge;
  std::vector<Open> open;
};

std::vector<std::byte> to_bytes(const SavedScans& scans) {
  std::vector<std::byte> bytes;
  StateWriter writer(bytes);
  writer.start(magic);
  writer.add(std::uint8_t{scans.is_finished});
  for (const std::deque<Levelling>* kind : {&scans.judge.fitting, &scans.judge.misfits}) {
    writer.add(std::uint64_t{kind->size()});
    for (const Levelling& levelling : *kind) write(levelling, writer);
  }
  writer.add(std::uint64_t{scans.open.size()});
  for (const SavedScans::Open& scan : scans.open) {
    writer.add(std::uint64_t{scan.index});
    writer.add(std::uint8_t{scan.fits});
    write(scan.levelling, writer);
  }
  writer.finish();
  return bytes;
}

Status from_bytes(const std::vector<std::byte>& bytes, SavedScans& scans) {
  StateReader reader(bytes);
  if (Status status = reader.open(magic, "the state of a mapped run"); !status.ok()) return status;
  const auto impossible = [&] {
    return bad_state(reader.offset(), "an impossible number", "the bytes as they were saved");
  };
  scans.is_finished = reader.read<std::uint8_t>() != 0;
  for (std::deque<Levelling>* kind : {&scans.judge.fitting, &scans.judge.misfits}) {
    const auto count = reader.read<std::uint64_t>();
    for (std::uint64_t k = 0; k < count; ++k) {
      if (!read(reader, kind->emplace_back())) return impossible();
    }
  }
  const auto open = reader.read<std::uint64_t>();
  for (std::uint64_t k = 0; k < open; ++k) {
    SavedScans::Open& scan = scans.open.emplace_back();
    scan.index = static_cast<std::size_t>(reader.read<std::uint64_t>());
    scan.fits = reader.read<std::uint8_t>() != 0;
    if (!read(reader, scan.levelling)) return impossible();
  }
  return reader.failed() || reader.left() > 0 ? impossible() : Status();
}

}  // namespace

Status RunMapper::save(const std::filesystem::path& directory) const {
  const StateFiles files{.directory = directory};
  Status status = io::within_memory([&] {
    SavedScans scans{.is_finished = is_finished_, .judge = judge_.state(), .open = {}};
    for (const auto& scan : open_) {
      scans.open.push_back(
          {.index = scan->index, .fits = scan->fits, .levelling = scan->levelling});
    }
    return io::write_file(files.scans(), to_bytes(scans));
  });
  if (status.ok()) status = io::save(files.map(), map_);
  if (status.ok()) status = io::save(files.votes(), vote_);
  if (status.ok() && !is_finished_) status = io::save(files.moving(), moving_);
  return status;
}

Status RunMapper::load(const std::filesystem::path& directory, const Reread& reread) {
  const StateFiles files{.directory = directory};
  SavedScans scans;
  Status status = io::within_memory([&] {
    std::vector<std::byte> bytes;
    Status read = io::load_bytes(files.scans(), bytes);
    if (read.ok()) read = io::with_path(files.scans(), from_bytes(bytes, scans));
    return read;
  });
  if (status.ok()) status = io::load(files.map(), map_);
  if (status.ok()) status = io::load(files.votes(), vote_);
  if (status.ok() && !scans.is_finished) status = io::load(files.moving(), moving_);
  if (!status.ok()) return status;
  is_finished_ = scans.is_finished;
  judge_ = LevellingJudge(std::move(scans.judge));
  open_.clear();
  for (const SavedScans::Open& saved : scans.open) {
    auto scan = std::make_unique<RunScan>();
    scan->index = saved.index;
    if (status = reread(*scan); !status.ok()) return status;
    scan->levelling = saved.levelling;
    scan->fits = saved.fits;
    open_.push_back(std::move(scan));
  }
  return status;
}

}  // namespace flagstone::app
