// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/point_kinds.hpp"

#include <array>

namespace flagstone::render {
namespace {

enum Outcome : std::uint8_t {
  true_positive,
  false_negative,
  false_positive,
  true_negative,
  not_scored,
};

Outcome outcome(Label label, Truth truth) noexcept {
  if (truth == Truth::ignored) return not_scored;
  if (truth == Truth::ground) return label == Label::ground ? true_positive : false_negative;
  return label == Label::ground ? false_positive : true_negative;
}

void add_point(PointKinds& points, Label label, std::uint8_t kind) {
  points.of_point.push_back(label == Label::invalid ? PointKinds::nowhere : kind);
  ++points.kinds[kind].count;
}

}  // namespace

PointKinds kinds_by_label(std::span<const Label> labels) {
  PointKinds points;
  // Yellow and cyan as in Fig. 7 of the paper.
  points.kinds = {
      {.name = "ground", .color = {246, 201, 58}, .size = 1, .drawn = true},
      {.name = "non-ground", .color = {58, 196, 226}, .size = 1, .drawn = true},
      {.name = "noise", .color = {214, 104, 158}, .size = 1.3, .drawn = true},
      {.name = "out of range", .color = {112, 121, 133}, .size = 1, .drawn = true},
      {.name = "invalid (hidden)", .color = {112, 121, 133}, .size = 1, .drawn = false},
  };
  points.drawing_order = {3, 0, 1, 2};
  points.of_point.reserve(labels.size());
  constexpr std::array<std::uint8_t, label_count> kind_of_code = {1, 0, 2, 3, 4};
  for (const Label label : labels)
    add_point(points, label, kind_of_code[static_cast<std::size_t>(label)]);
  return points;
}

PointKinds kinds_by_truth(std::span<const Label> labels, std::span<const Truth> reference) {
  PointKinds points;
  // Errors are larger, so that they show among many right points and without telling red from
  // green.
  points.kinds = {
      {.name = "true positive", .color = {44, 166, 96}, .size = 1, .drawn = true},
      {.name = "false negative", .color = {66, 140, 255}, .size = 1.5, .drawn = true},
      {.name = "false positive", .color = {255, 72, 56}, .size = 1.5, .drawn = true},
      {.name = "true negative", .color = {140, 148, 158}, .size = 1, .drawn = true},
      {.name = "not scored", .color = {70, 77, 87}, .size = 1, .drawn = true},
  };
  points.drawing_order = {not_scored, true_positive, true_negative, false_negative, false_positive};
  points.of_point.reserve(reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i)
    add_point(points, labels[i], outcome(labels[i], reference[i]));
  return points;
}

}  // namespace flagstone::render
