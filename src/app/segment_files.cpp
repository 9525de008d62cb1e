// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/segment_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "app/config/method_choice.hpp"
#include "files/io/cloud.hpp"
#include "files/io/message.hpp"
#include "files/render/rendering_available.hpp"
#include "library/core/stopwatch.hpp"

namespace flagstone::app {
namespace {

void check_tint(const ScanJob& job) {
  if (!job.tint_patches || job.config.get_if<PatchworkConfig>() != nullptr) return;
  throw std::invalid_argument(
      fmt::format("--color-patches: method {} has no zones (expected --method patchwork, r_gpf or "
                  "czm+...)",
                  job.method));
}

void check_surface(const ScanJob& job) {
  if (job.config.get_if<SurfaceConfig>() != nullptr) return;
  for (const auto& [asked, option] :
       {std::pair{job.heights, "--heights"}, std::pair{job.surface, "--surface"}}) {
    if (!asked) continue;
    throw std::invalid_argument(fmt::format(
        "{}: method {} computes no surface (expected --method surface)", option, job.method));
  }
}

/// Without rendering, --surface still writes the grid, but not the map.
void check_pictures(const ScanJob& job, const RunCallbacks& callbacks) {
  const Status rendering_available = render::rendering_available();
  if (rendering_available.ok()) return;
  if (job.picture) throw std::invalid_argument("--image: " + rendering_available.message());
  if (job.surface)
    callbacks.say("--surface: writes grids without maps: " + rendering_available.message());
}

void check_label_map(const SegmentRequest& request) {
  const OutputFormat format = request.job.format;
  if (!request.label_map_given || format == OutputFormat::label || format == OutputFormat::u8) {
    return;
  }
  throw std::invalid_argument(
      "--label-map: this format has no codes (expected --format label or u8)");
}

void refuse_to_overwrite(const SegmentRequest& request, std::span<const ScanInput> scans) {
  OutputPlan plan = request.plan;
  for (const ScanInput& scan : scans) {
    plan.reads(scan.file);
    if (!request.job.reference.empty()) plan.reads(reference_file(request.job.reference, scan));
    for (const std::filesystem::path& file : ScanOutputs(request.job, scan).all()) {
      plan.writes(file);
    }
  }
  plan.check();
}

}  // namespace

FoundMount find_mount(std::span<const ScanInput> scans, const MountSettings& settings,
                      const io::ReadOptions& read, const RunCallbacks& callbacks) {
  FoundMount found;
  found.settings = settings;
  found.settings.height = HeightSource::fixed;
  if (settings.tilt == TiltSource::estimate) found.settings.tilt = TiltSource::fixed;
  found.decision.mount = settings.mount;

  MountEstimator estimator(settings);
  io::Cloud cloud;
  for (const ScanInput& input : scans.first(std::min(scans.size(), most_scans_asked))) {
    if (callbacks.stopped()) break;
    if (!io::read_cloud(input.file, read, cloud).ok()) continue;  // reported when it is segmented
    found.decision = estimator.estimate(cloud.view());
    found.scan = input.file;
    ++found.asked;
    if (!found.decision.accepted()) continue;
    const Mount& estimate = found.decision.mount;
    if (settings.height != HeightSource::fixed) {
      found.settings.mount.sensor_height = estimate.sensor_height;
    }
    if (settings.tilt == TiltSource::estimate) found.settings.mount.up = estimate.up;
    break;
  }
  return found;
}

std::string to_text(const FoundMount& found) {
  if (found.decision.accepted()) {
    return fmt::format("mount: {} (estimated from {})", to_sentence(found.decision),
                       io::printable(found.scan));
  }
  MountDecision given;
  given.mount = found.settings.mount;
  if (found.scan.empty()) {
    return fmt::format("mount: {} (no scan could be read to estimate it)", to_sentence(given));
  }
  return fmt::format("mount: {} (the first {} scans do not determine it; {}: {})",
                     to_sentence(given), found.asked, io::printable(found.scan),
                     to_sentence(found.decision));
}

bool SegmentOutcome::ok() const {
  return reports.size() == scans && std::ranges::none_of(reports, [](const ScanReport& report) {
           return report.error.has_value();
         });
}

SegmentOutcome segment_files(SegmentRequest request, const SegmentCallbacks& callbacks) {
  ScanJob& job = request.job;
  config::check_threads(job.mount, request.threads);
  check_label_map(request);
  check_tint(job);
  check_surface(job);
  check_pictures(job, callbacks.run);
  const std::vector<ScanInput> scans = list_scans(request.scans, callbacks.run);
  refuse_to_overwrite(request, scans);

  const unsigned threads = threads_or_cores(job.mount.tracks() ? 1 : request.threads);
  if (job.mount.estimates() && !job.mount.tracks()) {
    const FoundMount found = find_mount(scans, job.mount, job.read, callbacks.run);
    job.mount = found.settings;
    job.told = found.decision;
    if (callbacks.mount) callbacks.mount(found);
  }
  SegmentOutcome outcome{.scans = scans.size(), .reports = {}, .time = {}};
  Stopwatch watch;
  const RunOutcome run = run_in_order(
      scans.size(), threads, "scans", callbacks.run,
      [&] {
        return [&, worker = ScanWorker(job)](std::size_t index) mutable {
          const std::size_t later = index + threads;  // one scan ahead per worker
          return worker.run(scans[index], later < scans.size() ? &scans[later] : nullptr);
        };
      },
      [&](std::size_t, ScanReport report) {
        if (callbacks.report) callbacks.report(report);
        outcome.reports.push_back(std::move(report));
      });
  outcome.time = {.seconds = watch.lap() / 1000, .workers = run.workers};
  return outcome;
}

}  // namespace flagstone::app
