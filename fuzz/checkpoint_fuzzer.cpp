// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "cloud_properties.hpp"
#include "files/io/file_contents.hpp"
#include "lab/eval/checkpoint.hpp"
#include "text_properties.hpp"

namespace {

constexpr const char* evaluation = "fuzzed";

}  // namespace

// The first byte selects the numbers of methods and of sources of moving points, and whether the
// rest follows the heading of a checkpoint or is the whole file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flagstone;
  if (size == 0) return 0;
  static const fuzz::ScratchFile file("checkpoint");
  const eval::OutcomeCounts counts{.methods = data[0] % 4U, .moving = data[0] / 4 % 4U};
  std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] < 128) text.insert(0, "{\"flagstone-checkpoint\":\"fuzzed\"}\n");
  file.put(text);

  eval::Checkpoint checkpoint;
  std::map<std::string, eval::ScanOutcome> finished;
  const Status status = checkpoint.resume(file.path(), evaluation, counts, finished);
  if (!status.ok()) {
    fuzz::check_line(status.message());
    fuzz::require(finished.empty(), "nothing is read from a rejected checkpoint");
    fuzz::require(io::contents_of(file.path()) == text, "a rejected checkpoint is unchanged");
    return 0;
  }
  for (const auto& [scan, outcome] : finished) {
    fuzz::require(outcome.methods.size() == counts.methods, "an outcome has every method");
    fuzz::require(outcome.moving.size() == counts.moving, "an outcome has all moving points");
  }

  eval::Checkpoint again;
  std::map<std::string, eval::ScanOutcome> kept;
  fuzz::require(again.resume(file.path(), evaluation, counts, kept).ok(),
                "it can be resumed again");
  fuzz::require(kept.size() == finished.size(), "finished scans are kept");
  return 0;
}
