#include "compare/report/modes_page.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "compare/modes/result.h"
#include "compare/report/loop_page.h"
#include "compare/report/page_frame.h"
#include "compare/report/plot_points.h"
#include "compare/report/response_plots.h"
#include "compare/result/result.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"

namespace rotorub {

using nlohmann::json;

Campbell campbell_of(const scene::Scene& scene, RotorAnalysis analysis, std::optional<double> range,
                     const std::function<void(double)>& progress) {
  constexpr int kSpeeds = 161;
  constexpr double kAccuracy = 1e-5;  // relative accuracy of the curves, finer than a line
  const double top = range.value_or(campbell_range(scene, analysis));
  auto branches = whirl_branches(condensed(analysis.system, top, kAccuracy),
                                 even_speeds(top, kSpeeds), progress);
  return {std::move(analysis), top, std::move(branches)};
}

std::string modes_page(const scene::Scene& scene, const Campbell& campbell) {
  const RotorAnalysis& analysis = campbell.analysis;
  const result::Section found = modes_result(scene.name, analysis);
  const json all = json_of(found);
  json judged{{"speed", all.at("speeds")[0]}};
  for (const char* key : {"critical", "unstable_ranges", "stability_bound", "rub_refused"})
    judged[key] = all.at(key);
  json rotor = modes_plots(scene, campbell);
  rotor["stiffness"] = stiffness_data(scene);
  const bool is_sheared =
      scene.rotor.geometry && scene.rotor.geometry->theory == scene::ShaftTheory::kTimoshenko;
  return laid_out_page(
      {scene.name, "whirl of the free rotor",
       "Where does it whirl, and where does it stay stable?"},
      found, "modes",
      {{"rotor", rotor},
       {"loops", loop_plots(analysis)},
       {"judged", judged},
       {"texts", {scene.text}}},
      fmt::format("Scene {}. Limits: {} shaft with rotary inertia, small deflections, no contact.",
                  scene::scene_hash(scene), is_sheared ? "Timoshenko" : "Euler-Bernoulli"));
}

json rotor_section(const scene::Scene& scene) {
  try {
    json data = modes_plots(scene, campbell_of(scene, analyse_free_rotor(scene, {})));
    // The shapes at rest are only on the page of `modes`.
    if (!data["shapes"].is_null()) data["shapes"].erase("modes");
    return data;
  } catch (const std::runtime_error& error) {
    // The page of the run must not depend on its rotor's eigenvalues.
    return {{"refusal", error.what()}};
  }
}

}  // namespace rotorub
