// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "app/config/same_config.hpp"
#include "app/evaluate.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"
#include "flagstone/baselines.hpp"
#include "library/core/setting.hpp"

namespace flagstone::cli {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> names_of(const std::vector<eval::Method>& methods) {
  std::vector<std::string> names;
  for (const eval::Method& method : methods) names.push_back(method.name);
  return names;
}

const eval::Method& named(const std::vector<eval::Method>& methods, const std::string& name) {
  return *std::ranges::find(methods, name, &eval::Method::name);
}

const PatchworkConfig& patchwork_of(const eval::Method& method) {
  return *method.config->get_if<PatchworkConfig>();
}

/// Options as the user writes them.
struct Options {
  std::vector<std::string> names = {"surface", "patchwork"};
  std::string preset = "default";
  std::string sensor{};
  std::string config_file{};
  std::vector<std::string> settings{};
  config::MountChoice mount{};
  std::vector<std::string> labels{};
  io::LabelMap label_map = io::LabelMap::flagstone;

  [[nodiscard]] std::vector<eval::Method> resolve() const {
    config::MethodChoice choice{.methods = names,
                                .preset = preset,
                                .sensor = sensor,
                                .config_file = config_file,
                                .mount = mount};
    for (const std::string& setting : settings) {
      choice.settings.push_back(config::parse_setting_of_method(setting));
    }
    return app::methods_to_evaluate(choice, labels, label_map);
  }
};

/// The error message for `options`; "no error" if they are valid.
std::string error_of(const Options& options) {
  try {
    static_cast<void>(options.resolve());
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(EvalMethods, Table1ListsTheNineRowsOfThePaperInOrder) {
  std::vector<std::string> titles;
  for (const eval::Method& method : Options{.names = {"table1"}}.resolve()) {
    titles.push_back(method.title);
  }

  EXPECT_THAT(titles, ElementsAre("RANSAC", "GPF", "LineFit", "CascadedSeg", "R-GPF", "R-GPF + U",
                                  "CZM + U", "CZM + U + E", "CZM + U + E + F"));
}

TEST(EvalMethods, AllListsEveryMethod) {
  const auto all = config::method_names();

  EXPECT_EQ(names_of(Options{.names = {"all"}}.resolve()),
            std::vector<std::string>(all.begin(), all.end()));
}

TEST(EvalMethods, AreListedInTheGivenOrderAndOnce) {
  EXPECT_THAT(names_of(Options{.names = {"gpf", "patchwork", "ransac", "gpf"}}.resolve()),
              ElementsAre("gpf", "patchwork", "ransac"));
  const auto names = names_of(Options{.names = {"patchwork", "table1", "gpf"}}.resolve());
  EXPECT_EQ(names.size(), 10U);
  EXPECT_EQ(names.front(), "patchwork");
}

TEST(EvalMethods, SettingsApplyOnlyToTheirMethod) {
  const auto methods =
      Options{.names = {"all"}, .settings = {"gpf.segments=5", "czm+u.seed_count=7"}}.resolve();

  EXPECT_EQ(named(methods, "gpf").config->get_if<GpfConfig>()->segments, 5);
  EXPECT_EQ(patchwork_of(named(methods, "czm+u")).seed_count, 7);
  EXPECT_EQ(patchwork_of(named(methods, "czm+u+e")).seed_count, PatchworkConfig{}.seed_count);
  EXPECT_EQ(patchwork_of(named(methods, "patchwork")).seed_count, PatchworkConfig{}.seed_count);
}

TEST(EvalMethods, SettingsOfPatchworkApplyToTheAblationButNotToRGpf) {
  const auto methods =
      Options{.names = {"all"}, .settings = {"patchwork.distance_margin=0.31"}}.resolve();

  for (const char* name : {"patchwork", "czm+u", "czm+u+e", "czm+u+e+f"}) {
    EXPECT_EQ(patchwork_of(named(methods, name)).distance_margin, 0.31f) << name;
  }
  EXPECT_TRUE(is_same(patchwork_of(named(methods, "r_gpf")), r_gpf_config()));
  EXPECT_NE(patchwork_of(named(methods, "r_gpf+u")).distance_margin, 0.31f);
}

TEST(EvalMethods, PresetAndFileApplyToPatchworkAndTheAblation) {
  const io::TemporaryFolder folder;
  io::put_file(folder / "mine.toml", "seed_count = 11\n");

  const auto methods = Options{.names = {"patchwork", "czm+u"},
                               .preset = "paper",
                               .config_file = (folder / "mine.toml").string()}
                           .resolve();

  for (const eval::Method& method : methods) {
    EXPECT_EQ(patchwork_of(method).seed_count, 11) << method.name;
    EXPECT_EQ(patchwork_of(method).distance_margin,
              PatchworkConfig::preset("paper").distance_margin);
  }
}

TEST(EvalMethods, AblationEnablesTheTermsInItsName) {
  const auto methods =
      Options{.names = {"all"}, .settings = {"patchwork.elevation.enabled=false"}}.resolve();

  EXPECT_FALSE(patchwork_of(named(methods, "patchwork")).elevation.enabled);
  EXPECT_FALSE(patchwork_of(named(methods, "czm+u")).elevation.enabled);
  EXPECT_TRUE(patchwork_of(named(methods, "czm+u+e")).elevation.enabled);
  EXPECT_FALSE(patchwork_of(named(methods, "czm+u+e")).flatness.enabled);
  EXPECT_TRUE(patchwork_of(named(methods, "czm+u+e+f")).flatness.enabled);
}

TEST(EvalMethods, SensorHeightAppliesToEveryMethodThatHasIt) {
  std::vector<std::string> without;
  for (eval::Method& method :
       Options{.names = {"all"}, .mount = {.sensor_height = 1.25f}}.resolve()) {
    const auto settings = method.config.value().settings();
    const auto height = std::ranges::find(settings, "sensor_height", &Setting::key);
    if (height == settings.end()) {
      without.push_back(method.name);
    } else {
      EXPECT_EQ(*std::get<float*>(height->value), 1.25f) << method.name;
    }
  }
  EXPECT_THAT(without, ElementsAre("ransac"));
}

TEST(EvalMethods, LabelsOfOtherProgramsFollowUnderTheirNames) {
  const io::TemporaryFolder folder;
  const std::string other = folder.path().string();

  const auto methods = Options{.names = {"gpf"},
                               .labels = {"peer=" + other, "second=" + other},
                               .label_map = io::LabelMap::semantic_kitti}
                           .resolve();

  ASSERT_THAT(names_of(methods), ElementsAre("gpf", "peer", "second"));
  EXPECT_FALSE(methods[1].config);
  EXPECT_EQ(methods[1].title, "peer");
  EXPECT_EQ(methods[1].labels, folder.path());
  EXPECT_EQ(methods[1].label_map, io::LabelMap::semantic_kitti);
}

TEST(EvalMethods, NoneKeepsOnlyLabelsOfOtherPrograms) {
  const io::TemporaryFolder folder;

  EXPECT_THAT(
      names_of(Options{.names = {"none"}, .labels = {"peer=" + folder.path().string()}}.resolve()),
      ElementsAre("peer"));
}

TEST(EvalMethods, ErrorsNameTheAllowedValues) {
  EXPECT_THAT(error_of({.names = {"magic"}}), AllOf(HasSubstr("magic"), HasSubstr("czm+u+e+f")));
  EXPECT_THAT(error_of({.settings = {"segments=5"}}),
              AllOf(HasSubstr("--set segments=5"), HasSubstr("gpf.segments=5")));
  EXPECT_THAT(error_of({.settings = {"magic.power=5"}}),
              AllOf(HasSubstr("--set magic.power=5"), HasSubstr("line_fit")));
  EXPECT_THAT(error_of({.names = {"gpf"}, .settings = {"gpf.segmentz=5"}}),
              AllOf(HasSubstr("--set gpf.segmentz=5"),
                    HasSubstr("no setting 'segmentz' (did you mean 'segments'?)")));
  EXPECT_THAT(error_of({.names = {"gpf"}, .settings = {"gpf.segments=many"}}),
              HasSubstr("--set gpf.segments=many"));
}

TEST(EvalMethods, RejectsASettingOfAMethodThatIsNotEvaluated) {
  EXPECT_THAT(
      error_of({.names = {"ransac"}, .settings = {"gpf.segments=5"}}),
      AllOf(HasSubstr("--set gpf.segments=5"), HasSubstr("not one of the methods in --methods")));
}

TEST(EvalMethods, RejectsAPresetWithoutAMethodThatHasPresets) {
  EXPECT_THAT(
      error_of({.names = {"surface", "gpf"}, .preset = "paper"}),
      HasSubstr(
          "--preset paper: surface, gpf have no presets (expected --method patchwork or czm+...)"));
  EXPECT_EQ(error_of({.names = {"surface", "czm+u"}, .preset = "paper"}), "no error");
}

TEST(EvalMethods, RejectsSettingsOfPatchworkWithoutPatchwork) {
  EXPECT_THAT(
      error_of({.names = {"surface"}, .settings = {"patchwork.seed_count=5"}}),
      HasSubstr("--set patchwork.seed_count=5: patchwork is not one of the methods in --methods"));
  EXPECT_EQ(error_of({.names = {"czm+u"}, .settings = {"patchwork.seed_count=5"}}), "no error");
}

TEST(EvalMethods, FileAppliesToEveryMethodThatHasAllItsSettings) {
  const io::TemporaryFolder folder;
  io::put_file(folder / "mine.toml", "noise_depth = 3\n[mount]\nscale = 0.5\n");

  const auto methods =
      Options{.names = {"all"}, .config_file = (folder / "mine.toml").string()}.resolve();

  EXPECT_EQ(named(methods, "surface").config->get_if<SurfaceConfig>()->noise_depth, 3);
  EXPECT_EQ(patchwork_of(named(methods, "patchwork")).noise_depth, 3);
  EXPECT_EQ(patchwork_of(named(methods, "czm+u")).noise_depth, 3);
  EXPECT_TRUE(is_same(patchwork_of(named(methods, "r_gpf")), r_gpf_config()));
  for (const eval::Method& method : methods) EXPECT_EQ(method.mount.mount.scale, 0.5f);
}

TEST(EvalMethods, RejectsAFileThatAppliesToNoMethod) {
  const io::TemporaryFolder folder;
  io::put_file(folder / "mine.toml", "seed_count = 11\nmax_range = 50\n");

  EXPECT_THAT(
      error_of({.names = {"surface", "gpf"}, .config_file = (folder / "mine.toml").string()}),
      AllOf(HasSubstr("mine.toml: line 1"), HasSubstr("seed_count")));
}

TEST(EvalMethods, LabelsNeedANameAndAnExistingDirectory) {
  const io::TemporaryFolder folder;
  const std::string there = folder.path().string();
  for (const std::string& wrong : {std::string("peer"), std::string("peer="), "=" + there}) {
    EXPECT_THAT(error_of({.labels = {wrong}}),
                AllOf(HasSubstr("--labels " + wrong), HasSubstr("NAME=DIR")));
  }
  EXPECT_THAT(error_of({.labels = {"peer=" + there + "/gone"}}),
              HasSubstr("/gone is not a directory"));
  EXPECT_THAT(error_of({.names = {"gpf"}, .labels = {"gpf=" + there}}),
              HasSubstr("gpf: two methods have this name"));
}

TEST(EvalMethods, SensorDeterminesTheSettingsOfAllMethods) {
  Sensor sensor = Sensor::named("vlp-16");
  sensor.height = 1.5;
  const auto methods = Options{.names = {"all"},
                               .sensor = "vlp-16",
                               .settings = {"patchwork.iterations=5", "gpf.segments=7"},
                               .mount = {.sensor_height = 1.5f}}
                           .resolve();
  PatchworkConfig expected = PatchworkConfig::for_sensor(sensor);
  expected.iterations = 5;

  EXPECT_TRUE(is_same(patchwork_of(named(methods, "patchwork")), expected));
  EXPECT_EQ(patchwork_of(named(methods, "czm+u")).min_range, expected.min_range);
  EXPECT_EQ(named(methods, "gpf").config->get_if<GpfConfig>()->segments, 7);
  EXPECT_EQ(named(methods, "gpf").config->get_if<GpfConfig>()->sensor_height, 1.5f);
  EXPECT_EQ(named(methods, "surface").config->get_if<SurfaceConfig>()->max_range, 100);
}

TEST(EvalMethods, RejectsASensorWithAPreset) {
  EXPECT_THAT(error_of({.names = {"patchwork"}, .preset = "paper", .sensor = "vlp-16"}),
              HasSubstr("--sensor: cannot be combined with --preset paper"));
}

}  // namespace
}  // namespace flagstone::cli
