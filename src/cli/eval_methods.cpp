// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/eval_methods.hpp"

#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <utility>

#include "cli/method_options.hpp"

namespace flagstone::cli {
namespace {

eval::Method labels_made_elsewhere(const std::string& entry, io::LabelMap map) {
  const std::size_t equals = entry.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == entry.size()) {
    throw std::invalid_argument(
        fmt::format("--labels {}: allowed: NAME=DIR, e.g. --labels other=out/other", entry));
  }
  eval::Method method;
  method.name = entry.substr(0, equals);
  method.title = method.name;
  method.labels = entry.substr(equals + 1);
  method.label_map = map;
  if (!std::filesystem::is_directory(method.labels)) {
    throw std::invalid_argument(
        fmt::format("--labels {}: {}: no such folder", entry, method.labels.string()));
  }
  return method;
}

}  // namespace

void EvalMethods::add_to(CLI::App& command) {
  add_methods_options(command, choice);
  command
      .add_option("--labels", labels,
                  "Labels that another program made, scored like a method: NAME.label, NAME.npy or "
                  "NAME.label.npy of each scan, one code a point, 1 for ground; may repeat")
      ->type_name("NAME=DIR")
      ->allow_extra_args(false);
  const std::map<std::string, io::LabelMap> maps = {
      {"flagstone", io::LabelMap::flagstone}, {"semantic-kitti", io::LabelMap::semantic_kitti}};
  command
      .add_option("--label-map", label_map,
                  "Codes in --labels: flagstone (1 is ground), or semantic-kitti (the classes that "
                  "the protocol takes for ground)")
      ->transform(CLI::Transformer(maps).description(""))
      ->transform(CLI::IsMember(maps));
}

std::vector<eval::Method> EvalMethods::resolve() const {
  std::vector<eval::Method> methods;
  for (config::ResolvedMethod& method : config::resolve(choice)) {
    methods.push_back(eval::method_of(method.name, std::move(method.config), method.mount));
  }
  for (const std::string& entry : labels) {
    methods.push_back(labels_made_elsewhere(entry, label_map));
  }
  if (methods.empty())
    throw std::invalid_argument("no method to evaluate; see --methods, --labels");
  std::map<std::string, int> count;
  for (const eval::Method& method : methods) {
    if (++count[method.name] == 2) {
      throw std::invalid_argument(fmt::format("two methods are called {}", method.name));
    }
  }
  return methods;
}

}  // namespace flagstone::cli
