// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "files/io/cloud.hpp"
#include "lab/bench/contestant.hpp"
#include "lab/bench/peer_process.hpp"

namespace flagstone::bench {

/// Where other people's programs are found.
struct PeerPlaces {
  std::string python = "python3";  ///< an interpreter that has the packages
  std::string worker = {};         ///< bench/peer_worker.py; empty for that around the command
};

/// A program to compare with.
struct PeerCommand {
  std::string name;
  std::vector<std::string> command;  ///< what starts its worker
  std::string missing;               ///< why it cannot be started, one line; else empty
};

/// The programs there may be: pypatchworkpp's two methods, and the plane RANSACs of Open3D and of
/// PCL. `sensor_height`: metres, for those that ask.
[[nodiscard]] std::vector<PeerCommand> known_peers(const PeerPlaces& places, float sensor_height);

/// A program that times itself on the scans it was sent: bench/peer_worker.py says how they talk.
class Peer final : public Contestant {
 public:
  /// Starts its worker. Throws PeerError.
  explicit Peer(const PeerCommand& peer);

  /// Waits until it is ready and sends it x, y, z and intensity (0 where a scan has none) of every
  /// point. Throws PeerError.
  void take(std::span<const io::Cloud> scans);

  /// Throws PeerError.
  Visit visit(std::size_t scan) override;

 private:
  PeerProcess worker_;
};

}  // namespace flagstone::bench
