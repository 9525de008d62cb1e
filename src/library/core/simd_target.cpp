// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/core/simd_target.hpp"

#include <hwy/highway.h>
#include <hwy/targets.h>

#include <cctype>
#include <cstdint>
#include <stdexcept>

namespace flagstone {
namespace {

std::string name_of(std::int64_t target) {
  if (target == HWY_SCALAR || target == HWY_EMU128) return "scalar";
  std::string name = hwy::TargetName(target);
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

/// The targets that this build and this machine support, even if a subset is forced.
std::int64_t supported() {
  static const std::int64_t targets = hwy::SupportedTargets() & HWY_TARGETS;
  return targets;
}

/// Makes the dispatcher choose among `targets`; 0 for all.
void choose_among(std::int64_t targets) {
  hwy::SetSupportedTargetsForTest(targets);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace

std::vector<std::string> simd_targets() {
  std::vector<std::string> names;
  // Better targets have lower bits.
  for (std::int64_t rest = supported(); rest != 0; rest &= rest - 1) {
    names.push_back(name_of(rest & -rest));
  }
  return names;
}

std::string simd_target() {
  const std::int64_t targets = hwy::SupportedTargets() & supported();
  return name_of(targets & -targets);
}

void use_simd_target(std::string_view name) {
  if (name.empty()) return choose_among(0);
  std::string known;
  for (std::int64_t rest = supported(); rest != 0; rest &= rest - 1) {
    const std::int64_t target = rest & -rest;
    if (name == name_of(target)) return choose_among(target);
    known += (known.empty() ? "" : ", ") + name_of(target);
  }
  throw std::invalid_argument("instruction set \"" + std::string(name) +
                              "\" is not available here (available: " + known + ")");
}

}  // namespace flagstone
