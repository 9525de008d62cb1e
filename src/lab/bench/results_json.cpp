// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/bench/results_json.hpp"

#include <optional>
#include <string>

#include "lab/eval/results_export.hpp"

namespace flagstone::bench {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json times_json(const SampleTimes& times) {
  return {{"median_ms", times.median()}, {"p99_ms", times.percentile_99()}};
}

Json segment_json(const Results& results, const Measured& measured) {
  Json json = times_json(measured.times);
  json["points_per_second"] = measured.times.points_per_second(results.points);
  json["ground"] = ground_share(results, measured);
  return json;
}

Json stages_json(const Results& results) {
  Json json = Json::object();
  for (const StageResult& stage : results.stages) {
    Json& entry = json[to_string(stage.stage)];
    entry = times_json(stage.times);
    entry["ratio"] = stage.times.ratio_to(results.floor.times);
  }
  return json;
}

Json peers_json(const Results& results) {
  Json json = Json::object();
  for (const PeerResult& peer : results.peers) {
    Json& entry = json[peer.name];
    if (!peer.left_out.empty()) entry["left_out"] = peer.left_out;
    if (peer.measured.times.count() == 0) continue;
    entry.update(segment_json(results, peer.measured));
    entry["ratio"] = peer.measured.times.ratio_to(results.segment.times);
    entry["samples"] = peer.measured.times.count();
  }
  return json;
}

}  // namespace

Json to_json(const Results& results) {
  Json json;
  json["method"] = results.method;
  json["segment"] = segment_json(results, results.segment);
  json["floor"] = times_json(results.floor.times);
  json["ratio_to_floor"] = results.segment.times.ratio_to(results.floor.times);
  json["scalar"] = segment_json(results, results.scalar);
  json["ratio_to_scalar"] = results.segment.times.ratio_to(results.scalar.times);
  json["stages"] = stages_json(results);
  json["peers"] = peers_json(results);
  json["target"] = results.target;
  json["allocations"] = or_null(results.allocations);
  json["bytes_held"] = or_null(results.bytes_held);
  json["points"] = results.points;
  json["rounds"] = results.rounds;
  json["threads"] = results.threads;
  json["core"] = or_null(results.core);
  json["machine"] = eval::machine_name();
  json["date"] = eval::today();
  return json;
}

}  // namespace flagstone::bench
