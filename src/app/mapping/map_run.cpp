// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/mapping/map_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/config/settings_json.hpp"
#include "app/ground_map_files.hpp"
#include "app/mapping/map_checkpoints.hpp"
#include "app/mapping/map_outputs.hpp"
#include "app/mapping/static_cloud.hpp"
#include "app/output_plan.hpp"
#include "app/run_poses.hpp"
#include "app/scan_files.hpp"
#include "files/io/atomic_file.hpp"
#include "files/io/label_files.hpp"
#include "files/io/load_bytes.hpp"
#include "files/io/map_files.hpp"
#include "files/io/message.hpp"
#include "files/io/npy.hpp"
#include "files/render/ground_map_picture.hpp"
#include "files/render/rendering_available.hpp"
#include "flagstone/version.hpp"
#include "lab/eval/method_runner.hpp"
#include "library/core/stopwatch.hpp"

namespace flagstone::app {
namespace {

namespace fs = std::filesystem;

void throw_unless_ok(const Status& status) {
  if (!status.ok()) throw std::runtime_error(status.message());
}

std::string_view name_of(LabelSource source) noexcept {
  switch (source) {
    case LabelSource::live: return "live";
    case LabelSource::delayed: return "delayed";
    case LabelSource::offline: break;
  }
  return "offline";
}

/// Reads and segments scans, one after another. Not thread-safe.
class ScanSource {
 public:
  explicit ScanSource(const MapRequest& request)
      : request_(request), runner_(request.method.config, request.method.mount) {}

  /// The scan, in its level frame. `pose` of the sensor.
  Status read(const ScanInput& input, const Pose& pose, RunScan& scan) {
    Status status = io::read_cloud(input.file, request_.read, scan.cloud);
    if (!status.ok()) return status;
    runner_.prepare(scan.cloud);
    status = runner_.segment(scan.cloud, scan.result);
    if (!status.ok()) return io::with_path(input.file, status);
    scan.level.set(scan.cloud.view(), runner_.levelled().mount(), pose);
    return status;
  }

 private:
  const MapRequest& request_;
  eval::MethodRunner runner_;
};

/// A scan of the run with its pose and its outcome.
struct Entry {
  ScanInput input;
  std::string name;  ///< of its outputs
  Pose pose{};
  double time = 0;
  bool has_pose = false;
  bool is_used = false;    ///< false: labelled alone
  bool is_misfit = false;  ///< its ground does not fit the map
  bool failed = false;
  Levelling levelling{};
};

/// One line per scan or group of scans that is labelled alone, and per scan that failed.
class Problems {
 public:
  explicit Problems(const RunCallbacks& callbacks) : callbacks_(callbacks) {}

  void add(std::string line) {
    callbacks_.say(line);
    lines_.push_back(std::move(line));
  }
  [[nodiscard]] const std::vector<std::string>& lines() const noexcept { return lines_; }

  /// Replaces the lines, without reporting them again.
  void restore(std::vector<std::string> lines) noexcept { lines_ = std::move(lines); }

 private:
  const RunCallbacks& callbacks_;
  std::vector<std::string> lines_;
};

Pose unknown_pose() noexcept {
  Pose pose;
  pose.rotation.fill(std::numeric_limits<double>::quiet_NaN());
  pose.position.fill(std::numeric_limits<double>::quiet_NaN());
  return pose;
}

class MapJob {
 public:
  MapJob(MapRequest request, const MapCallbacks& callbacks)
      : request_(std::move(request)),
        callbacks_(callbacks),
        problems_(callbacks.run),
        files_{.directory = request_.output},
        checkpoints_(files_.state(), request_.checkpoint_interval),
        static_cloud_(request_.voxel) {}

  void check_request() const;

  MapOutcome run() {
    Stopwatch watch;
    check_request();
    mapper_ = make_mapper();
    list_scans();
    check_outputs();
    find_mount();
    read_poses();
    start_output();
    const std::size_t first = load_checkpoint();
    if (!mapper_->is_finished()) map(first);
    if (!interrupted_) write_labels();
    if (!interrupted_) write_map();
    MapOutcome outcome = summary();
    outcome.seconds = watch.lap() / 1000;
    outcome.problems = problems_.lines();
    return outcome;
  }

 private:
  [[nodiscard]] std::unique_ptr<RunMapper> make_mapper() const;
  void list_scans();
  void check_outputs() const;
  [[nodiscard]] std::vector<ScanInput> inputs() const;
  void find_mount();
  [[nodiscard]] std::vector<double> times_of(const RunPoses& poses);
  void read_poses();
  void choose_part(const PoseChecks& checks);
  [[nodiscard]] nlohmann::ordered_json origin() const;
  void start_output();
  [[nodiscard]] Status read(ScanSource& source, RunScan& scan) const;
  void map(std::size_t first);
  void finish_scan(RunScan& scan);
  void warn_of_misfits();
  void warn_of_sparse_beams();
  void save_checkpoint(std::size_t next);
  std::size_t load_checkpoint();
  void write_labels();
  bool write_scan(ScanSource& source, Entry& entry, std::vector<StaticPoint>& points,
                  std::string& error);
  void write_map();
  void draw(std::span<const render::MapPosition> path);
  void write_description();
  [[nodiscard]] MapOutcome summary() const;

  MapRequest request_;
  const MapCallbacks& callbacks_;
  Problems problems_;
  MapOutputs files_;
  MapCheckpoints checkpoints_;
  std::vector<Entry> entries_;
  std::unique_ptr<RunMapper> mapper_;
  StaticCloud static_cloud_;
  ObjectTable objects_;
  std::size_t moving_points_ = 0;
  bool interrupted_ = false;
};

void MapJob::check_request() const {
  if (request_.method.config.get_if<SurfaceConfig>() == nullptr) {
    throw std::invalid_argument(
        fmt::format("--method: {} computes no heights (expected surface)", request_.method.name));
  }
  const auto check = [](std::string_view option, double value, double low, double high,
                        std::string_view unit) {
    if (value >= low && value <= high) return;  // false for NaN
    throw std::invalid_argument(fmt::format("{}: {} is out of range (expected {} to {} {})", option,
                                            value, low, high, unit));
  };
  check("--delay", request_.delay, 0, 10, "s");
  if (request_.rate) check("--rate", *request_.rate, 0.01, 1000, "scans per second");
  if (request_.voxel != 0) check("--voxel", request_.voxel, 0.01, 10, "m, or 0 for no cloud");
  if (request_.method.mount.tracks()) {
    throw std::invalid_argument(
        "--sensor-height: track is not supported (expected a height or estimate)");
  }
}

std::unique_ptr<RunMapper> MapJob::make_mapper() const {
  RunMapperConfig config{.labels = request_.labels, .delay = request_.delay};
  if (request_.map_memory > 0) {
    config.map.max_memory = request_.map_memory * 1'000'000;
    config.tiles = std::make_shared<io::TileFiles>(files_.state());
  }
  return std::make_unique<RunMapper>(config);
}

// The scans of a directory, and not those of another directory in it.
void MapJob::list_scans() {
  std::error_code ignored;
  if (!fs::is_directory(request_.run, ignored)) {
    throw std::invalid_argument(
        fmt::format("{}: {} (expected the directory of a run)", io::printable(request_.run),
                    fs::exists(request_.run, ignored) ? "is not a directory" : "does not exist"));
  }
  fs::path folder = request_.run;
  if (fs::is_directory(folder / "velodyne", ignored)) folder /= "velodyne";
  std::set<std::string> names;
  for (ScanInput& input : find_scans({folder.string()}, callbacks_.run)) {
    Entry entry;
    entry.name = without_scan_extension(input.file).filename().string();
    entry.input = std::move(input);
    if (!names.insert(entry.name).second) {
      throw std::invalid_argument(
          fmt::format("{}: two scans have this name (expected one directory of scans)",
                      io::printable(entry.input.file)));
    }
    entries_.push_back(std::move(entry));
  }
}

void MapJob::check_outputs() const {
  OutputPlan plan;
  plan.reads(request_.poses);
  for (const fs::path& file : request_.settings_files) plan.reads(file);
  for (const Entry& entry : entries_) {
    plan.reads(entry.input.file);
    plan.writes(files_.labels(entry.name));
    plan.writes(files_.moving(entry.name));
    if (request_.heights) plan.writes(files_.heights(entry.name));
  }
  for (const fs::path& file : {files_.description(), files_.poses(), files_.objects(),
                               files_.picture(), files_.static_cloud()}) {
    plan.writes(file);
  }
  plan.check();
  std::error_code ignored;
  const bool has_files =
      std::ranges::any_of(fs::directory_iterator(request_.output, ignored),
                          [&](const auto& entry) { return entry.path() != files_.input(); });
  if (has_files && !fs::exists(files_.description(), ignored)) {
    throw std::invalid_argument(
        fmt::format("{}: contains other files (expected an empty directory or an earlier map)",
                    io::printable(request_.output)));
  }
}

std::vector<ScanInput> MapJob::inputs() const {
  std::vector<ScanInput> inputs;
  inputs.reserve(entries_.size());
  for (const Entry& entry : entries_) inputs.push_back(entry.input);
  return inputs;
}

void MapJob::find_mount() {
  MountSettings& mount = request_.method.mount;
  if (!mount.estimates()) return;
  const FoundMount found = app::find_mount(inputs(), mount, request_.read, callbacks_.run);
  mount = found.settings;
  if (callbacks_.mount) callbacks_.mount(found);
}

// The times of the scans, in increasing order.
std::vector<double> MapJob::times_of(const RunPoses& poses) {
  std::vector<double> times = poses.times();
  const bool is_known = !times.empty() && std::ranges::all_of(times, [](double time) {
    return std::isfinite(time);
  }) && std::ranges::adjacent_find(times, std::greater_equal<>()) == times.end();
  if (is_known && !request_.rate) return times;
  if (!request_.rate) {
    problems_.add(fmt::format(
        "{}: {}: {} scans per second are assumed (set --rate, or add "
        "times.txt)",
        io::printable(request_.run),
        times.empty() ? "no file contains times" : "the times of the scans do not increase",
        default_rate));
  }
  times.resize(entries_.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    times[i] = static_cast<double>(i) / request_.rate.value_or(default_rate);
  }
  return times;
}

void MapJob::read_poses() {
  const RunPoses poses = read_run_poses(request_.run, inputs(), request_.poses);
  for (const std::string& note : poses.notes) problems_.add(note);
  const std::vector<double> times = times_of(poses);
  std::vector<std::optional<Pose>> found(entries_.size());
  std::vector<std::string> names(entries_.size());
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const std::optional<Pose>& pose = poses.scans[i].pose;
    Entry& entry = entries_[i];
    entry.time = times[i];
    entry.has_pose = pose.has_value();
    if (pose) entry.pose = *pose;
    found[i] = pose;
    names[i] = entry.name;
  }
  const PoseChecks checks = check_poses(found, times, !poses.calibration.empty());
  for (const PoseProblem& problem : checks.problems) {
    problems_.add(fmt::format("{}: {}", io::printable(request_.poses), to_line(problem, names)));
  }
  choose_part(checks);
}

// The longest part of consistent poses.
void MapJob::choose_part(const PoseChecks& checks) {
  std::vector<std::size_t> sizes(checks.parts);
  for (const PoseUse& use : checks.scans) {
    if (use.usable) ++sizes[use.part];
  }
  if (sizes.empty()) {
    problems_.add(fmt::format("{}: no pose is usable: every scan is labelled alone",
                              io::printable(request_.poses)));
    return;
  }
  const auto longest = static_cast<std::size_t>(std::ranges::max_element(sizes) - sizes.begin());
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    entries_[i].is_used = checks.scans[i].usable && checks.scans[i].part == longest;
  }
  if (sizes.size() > 1) {
    problems_.add(fmt::format(
        "{}: the poses fall into {} parts that do not fit together: the longest one, {} scans, is "
        "mapped, and the scans of the others are labelled alone",
        io::printable(request_.poses), sizes.size(), sizes[longest]));
  }
}

nlohmann::ordered_json MapJob::origin() const {
  std::error_code ignored;
  return {{"version", FLAGSTONE_VERSION},
          {"run", fs::weakly_canonical(request_.run, ignored).string()},
          {"poses", fs::weakly_canonical(request_.poses, ignored).string()},
          {"scans", entries_.size()},
          {"method", request_.method.name},
          {"settings", nlohmann::ordered_json::parse(config::to_json(request_.method))},
          {"columns", request_.read.columns},
          {"labels", name_of(request_.labels)},
          {"delay", mapper_->config().delay},
          {"rate", request_.rate ? nlohmann::ordered_json(*request_.rate) : nullptr},
          {"heights", request_.heights},
          {"map_memory", request_.map_memory},
          {"voxel", request_.voxel}};
}

void MapJob::start_output() {
  std::error_code error;
  for (const char* folder : {"labels", "moving", "heights", "state"}) {
    if (!request_.heights && std::string_view(folder) == "heights") continue;
    fs::create_directories(request_.output / folder, error);
    if (error) {
      throw std::runtime_error(fmt::format("{}: cannot be created: {}",
                                           io::printable(request_.output), error.message()));
    }
  }
  if (!fs::exists(files_.description(), error)) {
    write_description();
    return;
  }
  std::vector<std::byte> bytes;
  throw_unless_ok(io::load_bytes(files_.description(), bytes));
  const auto earlier = nlohmann::ordered_json::parse(
      reinterpret_cast<const char*>(bytes.data()),
      reinterpret_cast<const char*>(bytes.data()) + bytes.size(), nullptr, false);
  if (earlier.is_discarded() || !earlier.contains("origin") || earlier["origin"] != origin()) {
    throw std::invalid_argument(
        fmt::format("{}: contains a map of another run or with other options (expected an empty "
                    "directory, or the same options to resume)",
                    io::printable(request_.output)));
  }
}

void MapJob::write_description() {
  const MapOutcome at = summary();
  nlohmann::ordered_json scans = nlohmann::ordered_json::array();
  std::error_code ignored;
  for (const Entry& entry : entries_) {
    scans.push_back(fs::weakly_canonical(entry.input.file, ignored).string());
  }
  const nlohmann::ordered_json text = {{"origin", origin()},
                                       {"result",
                                        {{"mapped", at.mapped},
                                         {"alone", at.alone},
                                         {"failed", at.failed},
                                         {"path", std::round(at.path * 100) / 100},
                                         {"area", at.area},
                                         {"moving_points", at.moving_points},
                                         {"static_points", at.static_points}}},
                                       {"problems", problems_.lines()},
                                       {"scans", scans}};
  using Handler = nlohmann::ordered_json::error_handler_t;
  throw_unless_ok(
      io::write_file(files_.description(), text.dump(1, ' ', false, Handler::replace) + "\n"));
}

// A scan that RunMapper has finished. Its labels are final, except offline.
void MapJob::finish_scan(RunScan& scan) {
  Entry& entry = entries_[scan.index];
  entry.levelling = scan.levelling;
  if (!scan.fits) {
    entry.is_used = false;
    entry.levelling = {};
    entry.is_misfit = true;
    return;  // write_labels() writes it
  }
  moving_points_ += static_cast<std::size_t>(
      std::ranges::count_if(scan.moving.objects_of_points, [](auto k) { return k != 0; }));
  objects_.add(entry.name, scan.moving.objects);
  throw_unless_ok(write_moving(files_.moving(entry.name), scan.moving));
  if (request_.labels != LabelSource::offline) {
    throw_unless_ok(
        io::write_label_file(files_.labels(entry.name), scan.labels, io::LabelMap::flagstone));
  }
}

// One line per group of consecutive scans.
void MapJob::warn_of_misfits() {
  const auto is_end = [](const Entry& entry) { return entry.is_used && !entry.failed; };
  for (auto scan = entries_.begin(); scan != entries_.end(); ++scan) {
    if (!scan->is_misfit) continue;
    const auto end = std::find_if(scan, entries_.end(), is_end);
    const auto count = std::count_if(scan, end, [](const Entry& each) { return each.is_misfit; });
    problems_.add(
        count == 1
            ? fmt::format("{}: the ground does not fit the map: the scan is labelled alone",
                          io::printable(scan->input.file))
            : fmt::format(
                  "{}: the ground does not fit the map in this scan and later ones: {} scans "
                  "are labelled alone",
                  io::printable(scan->input.file), count));
    scan = std::prev(end);
  }
}

void MapJob::warn_of_sparse_beams() {
  constexpr double max_beam_spacing = 1.5;  // degrees
  const double spacing = mapper_->moving().beam_spacing();
  if (spacing <= max_beam_spacing) return;
  problems_.add(fmt::format(
      "{}: {:.1f} degrees between beams: some static points are marked as moving, most of them "
      "among fences and guard rails (expected at most {} degrees)",
      io::printable(request_.run), spacing, max_beam_spacing));
}

Status MapJob::read(ScanSource& source, RunScan& scan) const {
  const Entry& entry = entries_[scan.index];
  scan.time = entry.time;
  return source.read(entry.input, entry.pose, scan);
}

void MapJob::map(std::size_t first) {
  const ProgressMeter meter(entries_.size(), "scans mapped", first);
  ScanSource source(request_);
  const RunMapper::Use finished = [&](RunScan& scan) { finish_scan(scan); };
  callbacks_.run.show(meter.at(first));
  for (std::size_t i = first; i < entries_.size(); ++i) {
    if (callbacks_.run.stopped()) {
      interrupted_ = true;
      if (i > first) save_checkpoint(i);
      return;
    }
    Entry& entry = entries_[i];
    if (entry.is_used) {
      auto scan = std::make_unique<RunScan>();
      scan->index = i;
      const Status status = read(source, *scan);
      if (status.ok()) {
        throw_unless_ok(mapper_->add(std::move(scan), finished));
      } else {
        entry.failed = true;
        problems_.add(status.message());
      }
    }
    if (checkpoints_.is_due()) save_checkpoint(i + 1);
    callbacks_.run.show(meter.at(i + 1));
  }
  throw_unless_ok(mapper_->finish(finished));
  warn_of_misfits();
  warn_of_sparse_beams();
  save_checkpoint(entries_.size());
}

void MapJob::save_checkpoint(std::size_t next) {
  MapProgress progress{.next = next,
                       .scans = {},
                       .moving_points = moving_points_,
                       .objects = objects_.lines(),
                       .problems = problems_.lines()};
  for (const Entry& entry : entries_) {
    progress.scans.push_back(
        {.is_used = entry.is_used, .failed = entry.failed, .levelling = entry.levelling});
  }
  throw_unless_ok(checkpoints_.save(progress, *mapper_));
}

// Returns the index of the first scan to map.
std::size_t MapJob::load_checkpoint() {
  ScanSource source(request_);
  std::optional<MapProgress> progress =
      checkpoints_.load(entries_.size(), *mapper_, [&](RunScan& scan) {
        if (scan.index >= entries_.size()) return Status(StatusCode::bad_file);
        return read(source, scan);
      });
  if (!progress) {
    mapper_ = make_mapper();
    return 0;
  }
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    entries_[i].is_misfit = entries_[i].is_used && !progress->scans[i].is_used;
    entries_[i].is_used = progress->scans[i].is_used;
    entries_[i].failed = progress->scans[i].failed;
    entries_[i].levelling = progress->scans[i].levelling;
  }
  moving_points_ = progress->moving_points;
  objects_.set_lines(std::move(progress->objects));
  problems_.restore(std::move(progress->problems));
  callbacks_.run.say(fmt::format("{}: resumed: {} of {} scans were mapped before",
                                 io::printable(request_.output), progress->next, entries_.size()));
  return progress->next;
}

// Writes the labels of scans that are alone or offline, and collects static points.
bool MapJob::write_scan(ScanSource& source, Entry& entry, std::vector<StaticPoint>& points,
                        std::string& error) {
  RunScan scan;
  Status status = source.read(entry.input, entry.pose, scan);
  scan.fits = entry.is_used;
  scan.levelling = entry.levelling;
  if (status.ok() && entry.is_used) {
    status = read_moving(files_.moving(entry.name), scan.cloud.size(), scan.moving);
  }
  std::vector<Label> labels;
  if (status.ok()) status = mapper_->relabel(scan, labels);
  const bool is_written = entry.is_used && request_.labels != LabelSource::offline;
  if (status.ok() && !is_written) {
    status = io::write_label_file(files_.labels(entry.name), labels, io::LabelMap::flagstone);
  }
  const bool needs_heights = request_.heights || (request_.voxel > 0 && entry.is_used);
  std::vector<float> heights;
  if (status.ok() && needs_heights) status = mapper_->heights(scan, heights);
  if (status.ok() && request_.heights) {
    status = io::write_npy_file(files_.heights(entry.name), heights, std::array{heights.size()});
  }
  if (!status.ok()) {
    error = status.message();
    return false;
  }
  if (request_.voxel == 0 || !entry.is_used) return true;
  const CloudView cloud = scan.level.cloud();
  const auto& [r, t] = scan.level.pose();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const bool is_static = (labels[i] == Label::ground || labels[i] == Label::nonground) &&
                           scan.moving.objects_of_points[i] == 0;
    if (!is_static) continue;
    const Point p = cloud[i];
    const auto axis = [&, &turn = r, &position = t](std::size_t row) {
      return position[row] + turn[3 * row] * double{p.x} + turn[3 * row + 1] * double{p.y} +
             turn[3 * row + 2] * double{p.z};
    };
    const double x = axis(0);
    const double y = axis(1);
    points.push_back({.x = x,
                      .y = y,
                      .z = axis(2) - scan.levelling.at(x, y, t),
                      .height = heights[i],
                      .label = labels[i]});
  }
  return true;
}

void MapJob::write_labels() {
  struct Report {
    std::vector<StaticPoint> points;
    std::string error;
  };
  std::vector<Entry*> open;
  for (Entry& entry : entries_) {
    const bool is_written = entry.is_used && request_.labels != LabelSource::offline;
    if (entry.failed) continue;
    if (!is_written || request_.heights || request_.voxel > 0) open.push_back(&entry);
  }
  const RunOutcome outcome = run_in_order(
      open.size(), request_.threads, "scans labelled", callbacks_.run,
      [&] {
        return [&, source = std::make_shared<ScanSource>(request_)](std::size_t job) {
          Report report;
          if (!write_scan(*source, *open[job], report.points, report.error)) {
            open[job]->failed = true;
          }
          return report;
        };
      },
      [&](std::size_t, Report report) {
        if (!report.error.empty()) problems_.add(report.error);
        static_cloud_.add(report.points);
      });
  interrupted_ = outcome.done < open.size();
}

void MapJob::write_map() {
  std::vector<Pose> poses;
  std::vector<render::MapPosition> path;
  for (const Entry& entry : entries_) {
    poses.push_back(entry.has_pose ? levelled(entry.pose, entry.levelling) : unknown_pose());
    if (entry.is_used) {
      path.push_back({.x = entry.pose.position[0], .y = entry.pose.position[1]});
    }
  }
  throw_unless_ok(write_kitti_poses(files_.poses(), poses));
  throw_unless_ok(objects_.write(files_.objects()));
  throw_unless_ok(GroundMapFiles{files_.ground()}.write(mapper_->map()));
  if (request_.voxel > 0) throw_unless_ok(static_cloud_.write(files_.static_cloud()));
  if (request_.picture) draw(path);
  write_description();
  std::error_code ignored;
  fs::remove_all(files_.state(), ignored);
}

void MapJob::draw(std::span<const render::MapPosition> path) {
  if (const Status rendering = render::rendering_available(); !rendering.ok()) {
    problems_.add(fmt::format("ground.png: not drawn: {}", rendering.message()));
    return;
  }
  if (mapper_->map().cells() == 0) return;
  const HeightGrid grid = height_grid(mapper_->map());
  throw_unless_ok(render::draw_ground_map(
      files_.picture(), grid.view(),
      {.title = fmt::format("Ground of {}", request_.run.filename().string()),
       .subtitle = fmt::format("{} scans, {:.0f} m", path.size(), summary().path),
       .path = path}));
}

MapOutcome MapJob::summary() const {
  MapOutcome outcome{.scans = entries_.size(), .moving_points = moving_points_};
  const Entry* last = nullptr;
  for (const Entry& entry : entries_) {
    outcome.failed += entry.failed ? 1U : 0U;
    outcome.mapped += entry.is_used && !entry.failed ? 1U : 0U;
    outcome.alone += !entry.is_used && !entry.failed ? 1U : 0U;
    if (!entry.is_used) continue;
    if (last != nullptr) {
      const auto& a = last->pose.position;
      const auto& b = entry.pose.position;
      outcome.path += std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    }
    last = &entry;
  }
  const double cell = mapper_->map().config().cell;
  outcome.area = static_cast<double>(mapper_->map().cells()) * cell * cell;
  outcome.map_bytes = mapper_->map().bytes();
  outcome.vote_bytes = mapper_->vote().bytes();
  outcome.static_points = static_cloud_.size();
  outcome.interrupted = interrupted_;
  return outcome;
}

}  // namespace

void check_map_request(const MapRequest& request) { MapJob(request, {}).check_request(); }

MapOutcome map_run(MapRequest request, const MapCallbacks& callbacks) {
  return MapJob(std::move(request), callbacks).run();
}

}  // namespace flagstone::app
