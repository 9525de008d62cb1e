// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/method_runner.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <utility>

namespace flagstone::eval {

MethodRunner::MethodRunner(const MethodConfig& config, const MountSettings& mount) {
  std::unique_ptr<Segmenter> method = config.make();
  field_user_ = dynamic_cast<UsesField*>(method.get());
  levelled_ = std::make_unique<GravityAlignedSegmenter>(
      std::move(method), sensor_height_of(config, mount.mount.sensor_height), mount);
}

void MethodRunner::prepare(const io::Cloud& cloud) {
  if (field_user_ == nullptr) return;
  values_.clear();
  const io::Field* field = cloud.find(field_user_->field());
  for (std::size_t i = 0; field != nullptr && i < cloud.size(); ++i) {
    values_.push_back(cloud.value(i, *field));
  }
  field_user_->set_field(cloud.view(), values_);
}

Status MethodRunner::segment(const io::Cloud& cloud, Segmentation& result) {
  Status status = levelled_->segment(cloud.view(), result);
  if (status.ok() || !status.message().empty()) return status;
  return Status(status.code(), status.code() == StatusCode::out_of_memory
                                   ? fmt::format("not enough memory for {} points", cloud.size())
                                   : fmt::format("cannot segment {} points", cloud.size()));
}

}  // namespace flagstone::eval
