// The native model in a page: takes a scene's text and changes to it, and returns the run in the
// format of the page's scripts. It is compiled to WebAssembly (CMakeLists.txt here) and called by
// page/native.js in the worker page/native_worker.js.

#include <array>
#include <exception>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "compare/report/pack/packed_run.h"
#include "compare/report/run_data.h"
#include "compare/report/whirl_plots.h"
#include "native_model/run/run_native.h"
#include "native_model/scene/reader.h"
#include "renders/playback.h"

namespace rotorub {
namespace {

using nlohmann::json;

Trajectory last;     // for figures()
std::string answer;  // the result of the last call, valid until the next one

json contact_values(const scene::Scene& scene) {
  json all = json::array();
  for (const scene::AuxiliaryBearing& bearing : scene.auxiliary) {
    const scene::Contact contact = bearing.contact.value_or(scene::Contact());
    all.push_back({{"clearance", contact.clearance},
                   {"restitution", contact.restitution},
                   {"friction", contact.friction.sticking()},
                   {"gap_tolerance", gap_tolerance(contact.clearance)}});
  }
  return all;
}

json run(const char* text, const char* name, const std::vector<std::string>& changes) {
  const scene::Scene scene = scene::parse_scene(text, name, changes);
  last = run_native(scene);
  if (last.rows() == 0) return {{"refused", last.message}};
  const renders::Playback playback(last);
  const std::array<const renders::Playback*, 1> runs = {&playback};
  const renders::Machine machine =
      renders::make_machine(scene, runs, playback.start(), playback.end(), std::nullopt);
  return {{"side", run_data(scene, "recomputed", last, nullptr, &machine, spectrum_reach(last))},
          {"contacts", contact_values(scene)}};
}

const char* given(const json& value) {
  answer = value.dump();
  return answer.c_str();
}

}  // namespace
}  // namespace rotorub

// Returns JSON that is valid until the next call: {"side": run_data.h, "contacts": the values of
// each that may have changed}, or {"refused": reason}. changes: one per line,
// "contact.friction=0.2".
extern "C" const char* rotorub_run(const char* text, const char* name, const char* changes) {
  using namespace rotorub;
  std::vector<std::string> lines;
  std::istringstream all(changes);
  for (std::string line; std::getline(all, line);) lines.push_back(line);
  try {
    return given(run(text, name, lines));
  } catch (const std::exception& refused) {
    return given({{"refused", refused.what()}});
  }
}

// The last run, exact to the last bit, for comparison with the program: {"impacts": [[t, normal,
// friction impulse]], "events": [[t, name]], "end": {column: value of the last row}}.
extern "C" const char* rotorub_figures() {
  using namespace rotorub;
  json impacts = json::array(), events = json::array(), end = json::object();
  for (const Impact& i : last.impacts)
    impacts.push_back({i.t, i.normal_impulse, i.friction_impulse});
  for (const Event& e : last.events) events.push_back({e.t, to_string(e.kind)});
  for (const Column& column : last.series) end[column.name] = column.values.back();
  return given({{"impacts", impacts}, {"events", events}, {"end", end}});
}
