#include "compare/study/mode_json.h"

#include <nlohmann/json.hpp>

#include "compare/run_files/summary.h"

namespace rotorub {
namespace {

using nlohmann::json;

json contact_json(const ContactResult& c) {
  json all = json::object();
  for (const ResyncFigure& f : resync_figures()) all[f.key] = c.*f.value;
  return all;
}

}  // namespace

json shadow_json(const SceneComparison& c) {
  if (!c.shadow.side) return {{"figures", nullptr}, {"reason", c.shadow.absent}};
  json by_figure = json::object();
  for (const JudgedFigure& f : c.shadow.figures) {
    by_figure[f.figure->key] = {{"native", f.native},
                                {"shadow", f.other},
                                {"difference", f.other - f.native},
                                {"deviation", f.is_absent() ? json() : json(f.deviation)}};
  }
  const Side& side = *c.shadow.side;
  return {{"engine", side.engine},
          {"commands_of", c.shadow.driven ? json(c.sides[1].label) : json(nullptr)},
          {"summary", summary_json(c.scene, side.trajectory)},
          {"figures", by_figure}};
}

json resync_json(const Resync& r) {
  json rows = json::object(), onsets = json::array();
  for (const ResyncRow& row : r.rows) {
    rows[row.figure->key] = {{"native", row.native},
                             {"other", row.mujoco},
                             {"relative_to", row.figure->relative_to},
                             {"bias", row.bias},
                             {"median", row.median},
                             {"ninetieth", row.ninetieth},
                             {"worst", row.worst},
                             {"worst_signed", row.worst_signed},
                             {"worst_time", row.worst_time},
                             {"verdict", to_string(row.verdict)},
                             {"within", row.verdict == FigureVerdict::kWithin}};
  }
  for (const PredictedOnset& o : r.onsets) {
    onsets.push_back({{"touch", o.touch},
                      {"closing", o.closing},
                      {"end", o.end},
                      {"lasts", o.lasts},
                      {"status", to_string(o.status)},
                      {"native", contact_json(o.native)},
                      {"other", contact_json(o.mujoco)}});
  }
  return {{"figures", rows},
          {"onsets", onsets},
          {"left_out", r.left_out},
          {"failed", r.failed},
          {"failure", r.failure},
          {"shortest_flight_steps", kShortestFlight},
          {"largest_impact", r.largest_impact}};
}

}  // namespace rotorub
