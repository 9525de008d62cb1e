// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "app/config/config_toml.hpp"
#include "cloud_properties.hpp"
#include "flagstone/baselines.hpp"
#include "random_cloud.hpp"
#include "text_properties.hpp"

namespace flagstone {
namespace {

/// Whether the method accepts these settings; if not, the reason is one line.
bool is_allowed(const MethodConfig& config) {
  try {
    config.check();
  } catch (const std::invalid_argument& error) {
    fuzz::check_line(error.what());
    return false;
  }
  return true;
}

/// Written settings read back unchanged.
void check_round_trip(std::string_view method, const MethodConfig& config) {
  const std::string text = config::to_toml(config);
  MethodConfig again = default_config(method);
  MountSettings mount;
  config::apply_toml(text, "written", again, mount);
  fuzz::require(config::to_toml(again) == text, "settings read back unchanged");
}

void segment(std::string_view method, const MethodConfig& config) {
  static const std::vector<Point> cloud = tests::random_cloud(300, 1);
  static Segmentation result;
  const std::unique_ptr<Segmenter> segmenter = make_segmenter(method, config);
  const CloudView view = tests::view_of(cloud);
  fuzz::require(segmenter->segment(view, result).ok(), "every accepted setting segments");
  fuzz::require(result.labels().size() == cloud.size(), "every point has a label");
}

}  // namespace
}  // namespace flagstone

// The first byte selects the method, the rest is the text of its settings. They are rejected with
// one line, or the method works with them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flagstone;
  register_baselines();
  if (size == 0) return 0;
  const std::string_view method = method_names()[data[0] % method_names().size()];
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  MethodConfig config = default_config(method);
  try {
    MountSettings mount;
    config::apply_toml(text, "fuzz.toml", config, mount);
  } catch (const std::invalid_argument& error) {
    fuzz::check_line(error.what());
    return 0;
  }
  if (!is_allowed(config)) return 0;
  check_round_trip(method, config);
  segment(method, config);
  return 0;
}
