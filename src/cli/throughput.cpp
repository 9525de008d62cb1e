// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/throughput.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace flagstone::cli {

std::string throughput_text(std::span<const ScanReport> reports, const CrewTime& time) {
  double scans = 0;
  double bytes = 0;
  double read_ms = 0;
  double segment_ms = 0;
  double write_ms = 0;
  for (const ScanReport& report : reports) {
    if (report.error) continue;
    scans += 1;
    bytes += static_cast<double>(report.file_size);
    read_ms += report.read_ms;
    segment_ms += report.segment_ms;
    write_ms += report.write_ms;
  }
  if (scans == 0 || time.seconds <= 0) return {};

  const double all_ms = 1000 * time.seconds * static_cast<double>(time.workers);
  const double files_ms = read_ms + write_ms;
  const double other_ms = std::max(0.0, all_ms - files_ms - segment_ms);
  const char* const what_binds = other_ms > std::max(files_ms, segment_ms) ? "neither binds"
                                 : files_ms > segment_ms ? "reading and writing bind"
                                                         : "segmenting binds";
  return fmt::format(
      "{:.1f} scans a second, {:.1f} MB/s read; time of {} {}: {:.0f} % reading, {:.0f} % "
      "segmenting, {:.0f} % writing, {:.0f} % other; {}: {:.3f} ms of files, {:.3f} ms of "
      "segmenting a scan\n",
      scans / time.seconds, bytes / 1e6 / time.seconds, time.workers,
      time.workers == 1 ? "worker" : "workers", 100 * read_ms / all_ms, 100 * segment_ms / all_ms,
      100 * write_ms / all_ms, 100 * other_ms / all_ms, what_binds, files_ms / scans,
      segment_ms / scans);
}

}  // namespace flagstone::cli
