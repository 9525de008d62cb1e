// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "app/evaluate.hpp"
#include "app/mapping/map_run.hpp"
#include "app/simulate.hpp"
#include "bindings.hpp"
#include "lab/eval/results_export.hpp"
#include "lab/sim/scene.hpp"
#include "library/core/did_you_mean.hpp"
#include "library/core/thread_pool.hpp"
#include "method.hpp"

namespace nb = nanobind;

namespace flagstone::python {
namespace {

/// Function that draws a progress line, None for no progress, and the maximum length of the line.
struct ProgressLine {
  nb::object draw;
  std::size_t columns = 0;
};

/// Runs `work(callbacks)` without the GIL and returns the messages of the run. Signals are handled
/// between jobs on the calling thread, so that Ctrl-C raises KeyboardInterrupt. Errors of reading
/// and writing raise OSError.
template <class Work>
std::vector<std::string> run(const ProgressLine& line, const Work& work) {
  std::vector<std::string> messages;
  const auto caller = std::this_thread::get_id();
  app::RunCallbacks callbacks;
  callbacks.message = [&](const std::string& message) { messages.push_back(message); };
  if (!line.draw.is_none()) {
    callbacks.progress = [&](const app::Progress& progress) {
      const std::string text = app::to_text(progress, line.columns);
      const nb::gil_scoped_acquire locked;
      line.draw(text);
    };
  }
  callbacks.stop = [&] {
    if (std::this_thread::get_id() != caller) return false;
    const nb::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    return false;
  };
  try {
    const nb::gil_scoped_release released;
    work(callbacks);
  } catch (const std::runtime_error& error) {
    PyErr_SetString(PyExc_OSError, error.what());
    throw nb::python_error();
  }
  return messages;
}

/// Checks that an integer of any size is in range, before it is narrowed.
template <class Number>
Number checked(const char* name, nb::int_ value, Number minimum, Number maximum) {
  Number number = 0;
  if (nb::try_cast(value, number) && number >= minimum && number <= maximum) return number;
  throw std::invalid_argument(fmt::format("{}: {} is out of range (expected {} to {})", name,
                                          nb::cast<std::string>(nb::str(value)), minimum, maximum));
}

unsigned checked_threads(const std::optional<nb::int_>& threads) {
  return threads ? checked("threads", *threads, 1U, max_threads) : 0;
}

/// Writes a sequence of simulated scans and returns the number of scans per environment.
std::size_t simulate(const std::string& output, const std::string& scene, const std::string& sensor,
                     std::optional<double> sensor_height, const std::string& tilt,
                     const std::string& noise, const std::vector<std::string>& weather,
                     bool keep_no_returns, nb::int_ frames, double length, bool loop, double rate,
                     double speed, bool distortion, const std::string& pose_noise, nb::int_ seed,
                     const std::string& sequence, const std::optional<nb::int_>& threads,
                     nb::object draw, std::size_t columns) {
  const app::SimulateOptions options{
      .output = output,
      .scene = scene,
      .sensor = sensor,
      .sensor_height = sensor_height,
      .tilt = tilt,
      .noise = noise,
      .weather = weather,
      .keep_no_returns = keep_no_returns,
      .frames = checked<std::size_t>("frames", frames, 1, app::max_frames),
      .length = length,
      .loop = loop,
      .pace = {.rate = rate, .speed = speed, .distortion = distortion},
      .pose_noise = pose_noise,
      .seed = checked<std::uint64_t>("seed", seed, 0, std::numeric_limits<std::uint64_t>::max()),
      .sequence = sequence,
      .threads = checked_threads(threads)};
  app::Simulation simulation;
  run({std::move(draw), columns},
      [&](const app::RunCallbacks& callbacks) { simulation = app::simulate(options, callbacks); });
  return simulation.frames_per_environment;
}

/// Settings of methods and of the mounting pose, by name.
std::vector<config::GivenSettings> settings_of(const nb::dict& settings) {
  std::vector<config::GivenSettings> all;
  for (const auto& [key, own] : settings) {
    const std::string name = nb::cast<std::string>(nb::str(key));
    const std::string source = "settings " + name;
    if (name == "mount") {
      all.push_back(
          {.table = {.held = config::Value::Table{{name, value_of(own, name)}}}, .source = source});
      continue;
    }
    if (std::ranges::find(config::method_names(), name) == config::method_names().end()) {
      std::vector<std::string_view> tables = {"mount"};
      std::ranges::copy(config::method_names(), std::back_inserter(tables));
      throw std::invalid_argument("settings: " + no_such("method", name, tables));
    }
    all.push_back({.method = name, .table = value_of(own, name), .source = source});
  }
  return all;
}

/// The results as JSON and as CSV, and the messages of the run. JSON and CSV are empty if no scan
/// could be read.
nb::typed<nb::tuple, std::string, nb::bytes, std::vector<std::string>> evaluate(
    const std::vector<std::string>& datasets, std::vector<std::string> methods,
    const std::string& protocol, const std::vector<std::string>& sequences, nb::int_ every,
    const std::optional<nb::int_>& columns, const std::string& sensor, const Height& sensor_height,
    const Tilt& tilt, const std::string& preset, const std::string& config,
    const Settings& settings, const std::vector<std::string>& labels, bool labels_are_classes,
    const std::vector<std::string>& moving, const std::optional<nb::int_>& threads, nb::object draw,
    std::size_t terminal_columns) {
  const config::MethodChoice choice{.methods = std::move(methods),
                                    .preset = preset,
                                    .sensor = sensor,
                                    .config_file = config,
                                    .settings = settings_of(settings),
                                    .mount = mount_choice(sensor_height, tilt),
                                    .option_prefix = ""};
  const app::EvaluationOptions options{
      .datasets = datasets,
      .sequences = sequences,
      .every = checked<std::size_t>("every", every, 1, app::max_every),
      .protocol = protocol,
      .columns = columns ? checked("columns", *columns, 3, 1024) : 0,
      .threads = checked_threads(threads)};
  std::string json;
  std::string csv;
  std::vector<std::string> messages =
      run({std::move(draw), terminal_columns}, [&](const app::RunCallbacks& callbacks) {
        app::Evaluation evaluation(
            options,
            app::methods_to_evaluate(
                choice, labels,
                labels_are_classes ? io::LabelMap::semantic_kitti : io::LabelMap::flagstone),
            app::moving_to_evaluate(moving));
        const eval::Results results = evaluation.run(callbacks);
        if (results.scans == 0) return;
        constexpr auto replace = nlohmann::json::error_handler_t::replace;  // not UTF-8
        json = eval::to_json(results).dump(-1, ' ', false, replace);
        csv = eval::to_csv(results);
      });
  return nb::make_tuple(json, nb::bytes(csv.data(), csv.size()), messages);
}

app::LabelSource label_source(const std::string& name) {
  if (name == "live") return app::LabelSource::live;
  if (name == "delayed") return app::LabelSource::delayed;
  if (name == "offline") return app::LabelSource::offline;
  constexpr std::array<std::string_view, 3> known = {"live", "delayed", "offline"};
  throw std::invalid_argument("labels: " + no_such("kind of labels", name, known));
}

/// A run to map. The image of the ground is not drawn: this module does not include Cairo.
app::MapRequest map_request(const std::string& run, const std::string& poses,
                            const std::string& output, const std::string& labels, double delay,
                            bool heights, double voxel, std::optional<double> rate,
                            nb::int_ map_memory, const std::optional<nb::int_>& columns,
                            const std::string& sensor, const Height& sensor_height,
                            const Tilt& tilt, const std::string& config, const Settings& settings,
                            const std::optional<nb::int_>& threads) {
  const config::MethodChoice choice{.sensor = sensor,
                                    .config_file = config,
                                    .settings = {{.table = value_of(settings)}},
                                    .mount = mount_choice(sensor_height, tilt),
                                    .option_prefix = ""};
  constexpr std::size_t most_megabytes = 100'000'000;
  app::MapRequest request{
      .run = run,
      .poses = poses,
      .output = output,
      .method = config::resolve_one(choice),
      .read = {.columns = columns ? checked("columns", *columns, 3, 1024) : 0},
      .labels = label_source(labels),
      .delay = delay,
      .rate = rate,
      .heights = heights,
      .voxel = voxel,
      .map_memory = checked<std::size_t>("map_memory", std::move(map_memory), 0, most_megabytes),
      .threads = checked_threads(threads),
      .picture = false};
  for (const std::string& file : {config, sensor}) {
    if (!file.empty()) request.settings_files.emplace_back(file);
  }
  return request;
}

/// The numbers of app::MapOutcome by name.
nb::typed<nb::dict, std::string, nb::any> map_run(const app::MapRequest& request, nb::object draw,
                                                  std::size_t columns) {
  app::MapOutcome outcome;
  run({std::move(draw), columns}, [&](const app::RunCallbacks& callbacks) {
    outcome = app::map_run(request, {.run = callbacks});
  });
  nb::dict numbers;
  numbers["scans"] = outcome.scans;
  numbers["mapped"] = outcome.mapped;
  numbers["alone"] = outcome.alone;
  numbers["failed"] = outcome.failed;
  numbers["moving_points"] = outcome.moving_points;
  numbers["static_points"] = outcome.static_points;
  numbers["path"] = outcome.path;
  numbers["area"] = outcome.area;
  numbers["map_bytes"] = outcome.map_bytes;
  numbers["vote_bytes"] = outcome.vote_bytes;
  numbers["seconds"] = outcome.seconds;
  return numbers;
}

}  // namespace

void bind_runs(nb::module_& module) {
  module.def("simulate", &simulate, nb::arg("output"), nb::arg("scene"), nb::arg("sensor"),
             nb::arg("sensor_height").none(), nb::arg("tilt"), nb::arg("noise"), nb::arg("weather"),
             nb::arg("keep_no_returns"), nb::arg("frames"), nb::arg("length"), nb::arg("loop"),
             nb::arg("rate"), nb::arg("speed"), nb::arg("distortion"), nb::arg("pose_noise"),
             nb::arg("seed"), nb::arg("sequence"), nb::arg("threads").none(),
             nb::arg("draw").none(), nb::arg("terminal_columns"));
  module.def("evaluate", &evaluate, nb::arg("datasets"), nb::arg("methods"), nb::arg("protocol"),
             nb::arg("sequences"), nb::arg("every"), nb::arg("columns").none(), nb::arg("sensor"),
             nb::arg("sensor_height").none(), nb::arg("tilt").none(), nb::arg("preset"),
             nb::arg("config"), nb::arg("settings"), nb::arg("labels"),
             nb::arg("labels_are_classes"), nb::arg("moving"), nb::arg("threads").none(),
             nb::arg("draw").none(), nb::arg("terminal_columns"));
  [[maybe_unused]] const nb::class_<app::MapRequest> request(module, "MapRequest");
  module.def("map_request", &map_request, nb::arg("run"), nb::arg("poses"), nb::arg("output"),
             nb::arg("labels"), nb::arg("delay"), nb::arg("heights"), nb::arg("voxel"),
             nb::arg("rate").none(), nb::arg("map_memory"), nb::arg("columns").none(),
             nb::arg("sensor"), nb::arg("sensor_height").none(), nb::arg("tilt").none(),
             nb::arg("config"), nb::arg("settings"), nb::arg("threads").none());
  module.def("check_map_request", &app::check_map_request, nb::arg("request"));
  module.def("map_run", &map_run, nb::arg("request"), nb::arg("draw").none(),
             nb::arg("terminal_columns"));
}

}  // namespace flagstone::python
