// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/variant.h>
#include <pthread.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "flagstone/gravity_aligned_segmenter.hpp"
#include "library/core/thread_pool.hpp"
#include "library/methods/method.hpp"
#include "library/mount/mount_settings.hpp"
#include "method.hpp"
#include "points.hpp"
#include "result.hpp"

namespace nb = nanobind;

namespace flagstone::python {
namespace {

/// Number of forks of this process and its ancestors.
std::atomic<std::uint32_t> forks = 0;

unsigned checked_threads(std::int64_t threads) {
  if (threads >= 1 && threads <= max_threads) return static_cast<unsigned>(threads);
  throw std::invalid_argument(
      fmt::format("threads: {} is out of range (expected 1 to {})", threads, max_threads));
}

/// Whether more than 90 % of the points are out of range, as in a scan in millimetres. Small clouds
/// are excluded, because all of their points may be far away.
bool mostly_out_of_range(const Segmentation& segmentation) {
  constexpr std::size_t min_points = 1000;
  const std::size_t finite = segmentation.labels().size() - segmentation.count(Label::invalid);
  return finite >= min_points && segmentation.count(Label::out_of_range) > finite / 10 * 9;
}

/// A method with its settings. Thread-safe: calls take turns. After a fork the child may use it
/// too, even if another thread of the parent was segmenting.
class SharedSegmenter {
 public:
  SharedSegmenter(config::ResolvedMethod method, unsigned threads)
      : method_(std::move(method)), threads_(threads) {
    make();
  }

  /// Fast path for rows of float32. Returns nullptr for other objects; use segment() for those.
  std::unique_ptr<Result> segment_rows(nb::handle array) {
    const Rows rows(array);
    return rows.are_points() ? segment_points(rows) : nullptr;
  }

  std::unique_ptr<Result> segment(nb::handle x, nb::handle y, nb::handle z) {
    return segment_points(Points(x, y, z));
  }

  /// The mounting pose that one scan shows: whether the estimate is accepted, the height, the up
  /// direction, and the decision in one sentence. Does not change the state of the segmenter.
  nb::tuple estimate_mount(nb::handle x, nb::handle y, nb::handle z) {
    const Points points(x, y, z);
    std::vector<float> copy;
    MountDecision decision;
    {
      const nb::gil_scoped_release released;
      decision = MountEstimator(method_.mount).estimate(points.view(copy));
    }
    const auto& up = decision.mount.up;
    return nb::make_tuple(decision.accepted(), decision.mount.sensor_height,
                          nb::make_tuple(up[0], up[1], up[2]), to_sentence(decision));
  }

  /// A segmenter with the same settings, except that a height or tilt to be estimated is fixed: at
  /// the given values, otherwise at the configured ones.
  [[nodiscard]] std::unique_ptr<SharedSegmenter> with_fixed_mount(
      const std::optional<std::tuple<float, std::array<float, 3>>>& found) const {
    config::ResolvedMethod method = method_;
    MountSettings& mount = method.mount;
    if (mount.height != HeightSource::fixed) {
      mount.height = HeightSource::fixed;
      if (found) mount.mount.sensor_height = std::get<0>(*found);
    }
    if (mount.tilt == TiltSource::estimate) {
      mount.tilt = TiltSource::fixed;
      if (found) mount.mount.up = std::get<1>(*found);
    }
    return std::make_unique<SharedSegmenter>(std::move(method), threads_);
  }

  void reset() {
    recover_from_fork();
    const nb::gil_scoped_release released;
    const std::scoped_lock lock(*turn_);
    segmenter_->reset();
  }

  [[nodiscard]] const config::ResolvedMethod& method() const { return method_; }

 private:
  void make() {
    const auto& [name, config, mount] = method_;
    segmenter_ = std::make_unique<GravityAlignedSegmenter>(
        config.make(threads_), sensor_height_of(config, mount.mount.sensor_height), mount);
  }

  /// If another thread was segmenting during the fork, the child has its lock and its memory but
  /// not the thread. The lock is never released and the memory is inconsistent, so both are leaked.
  /// The caller holds the GIL, so no other thread of the child runs this function.
  void recover_from_fork() {
    const std::uint32_t now = forks.load(std::memory_order_relaxed);
    if (forks_ == now) return;
    forks_ = now;
    if (turn_->try_lock()) {
      turn_->unlock();
      return;
    }
    static_cast<void>(turn_.release());
    static_cast<void>(segmenter_.release());
    static_cast<void>(copy_.release());
    turn_ = std::make_unique<std::mutex>();
    copy_ = std::make_unique<std::vector<float>>();
    make();
  }

  void warn_if_mostly_out_of_range(const Segmentation& segmentation) {
    if (has_warned_ || !mostly_out_of_range(segmentation)) return;
    has_warned_ = true;
    const std::string message = fmt::format(
        "points: {} of {} points are out of range (expected metres, origin at the sensor; for "
        "millimetres pass mount={{\"scale\": 0.001}}; `flagstone doctor SCAN` finds the cause)",
        segmentation.count(Label::out_of_range), segmentation.labels().size());
    if (PyErr_WarnEx(PyExc_UserWarning, message.c_str(), 2) != 0) throw nb::python_error();
  }

  template <class AnyPoints>
  std::unique_ptr<Result> segment_points(const AnyPoints& points) {
    recover_from_fork();
    Status status;
    std::unique_ptr<Result> result;
    {
      const nb::gil_scoped_release released;
      // Locked after the GIL is released, so that waiting threads do not hold the GIL.
      const std::scoped_lock lock(*turn_);
      std::unique_ptr<Segmentation> segmentation = spare_->take();
      status = segmenter_->segment(points.view(*copy_), *segmentation);
      result = std::make_unique<Result>(std::move(segmentation), spare_, segmenter_->mount(),
                                        segmenter_->decision());
    }
    raise_if_failed(status);
    warn_if_mostly_out_of_range(result->segmentation());
    return result;
  }

  std::unique_ptr<std::mutex> turn_ = std::make_unique<std::mutex>();
  config::ResolvedMethod method_;
  unsigned threads_;
  std::unique_ptr<GravityAlignedSegmenter> segmenter_;
  std::shared_ptr<SpareResults> spare_ = std::make_shared<SpareResults>();
  std::unique_ptr<std::vector<float>> copy_ = std::make_unique<std::vector<float>>();
  std::uint32_t forks_ = forks.load(std::memory_order_relaxed);
  bool has_warned_ = false;
};

/// The shortest decimal number that rounds to a float: 1.73 instead of 1.7300000190734863.
double decimal(float number) { return std::strtod(fmt::format("{}", number).c_str(), nullptr); }

nb::object value_of(const Setting& setting) {
  if (const auto* choice = std::get_if<Choice>(&setting.value)) {
    const std::string_view name = choice->names()[choice->index()];
    return nb::str(name.data(), name.size());
  }
  return std::visit(
      [](const auto& value) -> nb::object {
        if constexpr (std::is_pointer_v<std::remove_cvref_t<decltype(value)>>) {
          using Value = std::remove_cvref_t<decltype(*value)>;
          if constexpr (std::is_same_v<Value, float>) {
            return nb::float_(decimal(*value));
          } else if constexpr (std::is_arithmetic_v<Value>) {
            return nb::cast(*value);
          } else {
            nb::list list;
            for (const float number : *value) list.append(decimal(number));
            return list;
          }
        }
        return nb::none();
      },
      setting.value);
}

void add_settings(const std::vector<Setting>& settings, nb::dict& to) {
  for (const Setting& setting : settings) {
    const std::size_t dot = setting.key.find('.');
    if (dot == std::string_view::npos) {
      to[nb::str(setting.key.data(), setting.key.size())] = value_of(setting);
      continue;
    }
    const nb::str table(setting.key.data(), dot);
    if (!to.contains(table)) to[table] = nb::dict();
    to[table][nb::str(setting.key.data() + dot + 1, setting.key.size() - dot - 1)] =
        value_of(setting);
  }
}

nb::list list_of(const std::vector<Zone>& zones) {
  nb::list list;
  for (const Zone& zone : zones) {
    nb::dict entry;
    nb::list radii;
    for (const float radius : zone.ring_radii) radii.append(decimal(radius));
    entry["ring_radii"] = radii;
    entry["sectors"] = zone.sectors;
    entry["height_margin"] = decimal(zone.height_margin);
    list.append(entry);
  }
  return list;
}

nb::dict settings_dict(const SharedSegmenter& segmenter) {
  auto [name, config, mount] = segmenter.method();
  nb::dict settings;
  add_settings(config.settings(), settings);
  if (const auto* patchwork = config.get_if<PatchworkConfig>()) {
    settings["zones"] = list_of(patchwork->zones);
  }
  add_settings(settings_of(mount), settings);
  return settings;
}

/// Address from which segment_rows() reads the first point; 0 if it does not accept the object.
std::uintptr_t address_of_rows(nb::handle array) {
  const Rows rows(array);
  return rows.are_points() ? reinterpret_cast<std::uintptr_t>(rows.view({}).data()) : 0;
}

/// Address from which segment() reads the x of the first point; 0 if it copies the points.
std::uintptr_t address_of(nb::handle x, nb::handle y, nb::handle z) {
  const Points points(x, y, z);
  if (!points.are_zero_copy()) return 0;
  std::vector<float> none;
  return reinterpret_cast<std::uintptr_t>(points.view(none).data());
}

}  // namespace

void bind_segmenter(nb::module_& module) {
  pthread_atfork(nullptr, nullptr, [] { forks.fetch_add(1, std::memory_order_relaxed); });
  module.def("address_of", &address_of, nb::arg("x"), nb::arg("y"), nb::arg("z"),
             nb::sig("def address_of(x: object, y: object, z: object) -> int"));
  module.def("address_of_rows", &address_of_rows, nb::arg("array").none(),
             nb::sig("def address_of_rows(array: object) -> int"));
  nb::class_<SharedSegmenter>(module, "Segmenter")
      .def(
          "__init__",
          [](SharedSegmenter* self, std::string method, std::string preset, std::string sensor,
             std::string config_file, const Settings& settings, const Height& sensor_height,
             const Tilt& tilt, std::int64_t threads) {
            const unsigned checked = checked_threads(threads);
            const config::MethodChoice choice = {.methods = {std::move(method)},
                                                 .preset = std::move(preset),
                                                 .sensor = std::move(sensor),
                                                 .config_file = std::move(config_file),
                                                 .settings = {{.table = value_of(settings)}},
                                                 .mount = mount_choice(sensor_height, tilt),
                                                 .option_prefix = ""};
            new (self) SharedSegmenter(config::resolve_one(choice), checked);
          },
          nb::kw_only(), nb::arg("method"), nb::arg("preset"), nb::arg("sensor"),
          nb::arg("config_file"), nb::arg("settings"), nb::arg("sensor_height").none(),
          nb::arg("tilt").none(), nb::arg("threads"))
      .def("segment_rows", &SharedSegmenter::segment_rows, nb::arg("array").none(),
           nb::sig("def segment_rows(self, array: object) -> Result | None"))
      .def("segment", &SharedSegmenter::segment, nb::arg("x"), nb::arg("y"), nb::arg("z"),
           nb::sig("def segment(self, x: object, y: object, z: object) -> Result"))
      .def("estimate_mount", &SharedSegmenter::estimate_mount, nb::arg("x"), nb::arg("y"),
           nb::arg("z"),
           nb::sig("def estimate_mount(self, x: object, y: object, z: object) -> tuple[bool, "
                   "float, tuple[float, float, float], str]"))
      .def("with_fixed_mount", &SharedSegmenter::with_fixed_mount, nb::arg("found").none(),
           nb::sig("def with_fixed_mount(self, found: tuple[float, tuple[float, float, float]] | "
                   "None) -> Segmenter"))
      .def("reset", &SharedSegmenter::reset)
      .def("settings", &settings_dict, nb::sig("def settings(self) -> dict[str, typing.Any]"));
}

}  // namespace flagstone::python
