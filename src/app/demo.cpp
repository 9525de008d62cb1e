// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/demo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "files/io/cloud.hpp"
#include "files/io/label_files.hpp"
#include "files/io/message.hpp"
#include "files/io/write_cloud.hpp"
#include "files/render/birds_eye.hpp"
#include "files/render/rendering_available.hpp"
#include "files/render/surface_picture.hpp"
#include "flagstone/surface.hpp"
#include "lab/eval/protocol.hpp"
#include "lab/eval/score.hpp"
#include "lab/sim/drive.hpp"
#include "library/core/statistics.hpp"
#include "library/core/stopwatch.hpp"

namespace flagstone::app {
namespace fs = std::filesystem;

namespace {

constexpr float picture_range = 50;  // metres to each side; the same in all images

/// The files of the demo, in the layout of a SemanticKITTI sequence.
struct DemoFiles {
  explicit DemoFiles(const fs::path& folder)
      : scan(folder / "velodyne" / "000000.bin"),
        truth(folder / "labels" / "000000.label"),
        labels(folder / "predictions" / "000000.label"),
        picture(folder / "000000.png"),
        comparison(folder / "000000-compared.png"),
        surface(folder / "000000-surface.png") {}

  fs::path scan, truth, labels, picture, comparison, surface;
};

void must(const Status& status) {
  if (!status.ok()) throw std::runtime_error(status.message());
}

/// Median time of segmenting the scan, milliseconds.
double median_time(Segmenter& method, CloudView cloud, Segmentation& result) {
  std::vector<double> times(21);
  for (double& time : times) {
    Stopwatch watch;
    must(method.segment(cloud, result));
    time = watch.lap();
  }
  return median(times);
}

void write_files(const DemoFiles& files, const sim::SimulatedScan& scan, const io::Cloud& cloud,
                 const Segmentation& result) {
  std::error_code error;
  if (fs::exists(files.scan, error) && !fs::exists(files.labels, error)) {
    throw std::invalid_argument(fmt::format(
        "{}: was not written by a demo and would be overwritten (choose another --output)",
        io::printable(files.scan)));
  }
  for (const fs::path& file : {files.scan, files.truth, files.labels}) {
    fs::create_directories(file.parent_path(), error);
    if (error) {
      throw std::runtime_error(
          fmt::format("{}: cannot be created: {}", file.parent_path().string(), error.message()));
    }
  }
  must(io::write_cloud(files.scan, cloud));
  must(io::write_class_file(files.truth, scan.classes));
  must(io::write_label_file(files.labels, result.labels(), io::LabelMap::flagstone));
}

void draw_pictures(const DemoFiles& files, const io::Cloud& cloud, const Segmentation& result,
                   std::span<const Truth> truth, const std::string& scores,
                   const std::string& heights) {
  render::BirdsEye options;
  options.title = "Simulated street, 64 beams";
  options.subtitle = scores;
  options.range = picture_range;
  must(render::draw_birds_eye(files.picture, cloud.view(), result, options));
  options.reference = truth;
  must(render::draw_birds_eye(files.comparison, cloud.view(), result, options));
  must(render::draw_surface(
      files.surface, result.surface(),
      {.title = "Simulated street, ground surface", .subtitle = heights, .range = picture_range}));
}

}  // namespace

std::string run_demo(const DemoRequest& request) {
  const sim::SimulatedScan scan =
      sim::simulate_street(request.seed, std::max(1u, std::thread::hardware_concurrency()));
  io::Cloud cloud;
  must(io::Cloud::from_floats(scan.xyzi, 4, cloud));

  Surface surface;
  Segmentation result;
  const double ms = median_time(surface, cloud.view(), result);

  const std::vector<Truth> truth =
      eval::truth_of(eval::simulation_protocol(), cloud.view(), scan.classes);
  const eval::Confusion score = eval::compare(result.labels(), truth);
  const eval::HeightErrors heights =
      eval::score_heights(cloud.view(), truth, sim::street_ground(request.seed, scan.xyzi),
                          result.heights())
          .ground.by_range[0];
  const auto ground_patches = std::ranges::count_if(result.patches(), &Patch::is_ground);
  const std::string scores = eval::scores_text(score);

  const DemoFiles files(request.output);
  write_files(files, scan, cloud, result);
  const Status rendering_available = render::rendering_available();
  if (rendering_available.ok()) {
    draw_pictures(
        files, cloud, result, truth, scores,
        fmt::format("median error {:.1f} cm at ground points within 20 m", 100 * heights.median));
  }

  const double share =
      static_cast<double>(result.count(Label::ground)) / static_cast<double>(cloud.size());
  std::string text;
  const auto print = [&]<class... Values>(fmt::format_string<Values...> format,
                                          Values&&... values) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
  };
  print("  points       {}\n", cloud.size());
  print("  ground       {:.1f} %\n", 100 * share);
  print("  patches      {}, {} of them ground\n", result.patches().size(), ground_patches);
  print("  precision    {:.2f} %\n", 100 * score.precision());
  print("  recall       {:.2f} %\n", 100 * score.recall());
  print("  F1           {:.2f} %   (all points, against the simulated ground truth)\n",
        100 * score.f1());
  print(
      "  heights      {:.1f} cm   (median error at ground points within 20 m; 95 % below {:.1f} "
      "cm)\n",
      100 * heights.median, 100 * heights.percentile95);
  print("  time         {:.2f} ms  (one core, median of 21 runs)\n\n", ms);
  if (rendering_available.ok()) {
    print("  image        {}\n", io::printable(files.picture));
    print("  compared     {}\n", io::printable(files.comparison));
    print("  surface      {}\n", io::printable(files.surface));
  } else {
    print("  images       none: {}\n", rendering_available.message());
  }
  print("  labels       {}\n", io::printable(files.labels));
  print("  input        {}, {}\n", io::printable(files.scan), io::printable(files.truth));
  return text;
}

}  // namespace flagstone::app
