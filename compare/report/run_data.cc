#include "compare/report/run_data.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "compare/base/units.h"
#include "compare/report/pack/packed_run.h"
#include "compare/report/plot_points.h"
#include "compare/report/whirl_plots.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {

namespace {

using nlohmann::json;

// The impacts of one contact. friction: its coefficient mu.
json impact_data(const Trajectory& run, std::size_t contact, double friction) {
  std::vector<double> t, normal, tangential, before, after, slip, share;
  for (const Impact& impact : counted_impacts(run, contact)) {
    if (impact.normal_impulse <= 0.0) continue;
    t.push_back(impact.t);
    normal.push_back(kMilli * impact.normal_impulse);
    tangential.push_back(kMilli * std::abs(impact.friction_impulse));
    before.push_back(impact.gap_rate_before);
    after.push_back(impact.gap_rate_after);
    slip.push_back(impact.slip_after);
    share.push_back(friction > 0.0 ? impact.friction_impulse / (friction * impact.normal_impulse)
                                   : 0.0);
  }
  const auto kept = thin(normal, 0, normal.size(), kPlotBuckets);
  return {{"t", picked(t, kept, 8)},
          {"y", picked(normal, kept, 5)},
          {"friction", picked(tangential, kept, 5)},
          {"before", picked(before, kept, 5)},
          {"after", picked(after, kept, 5)},
          {"slip", picked(slip, kept, 5)},
          {"share", picked(share, kept, 5)}};
}

}  // namespace

json run_data(const scene::Scene& scene, const std::string& label, const Trajectory& run,
              const Trajectory* first, const renders::Machine* machine, double limit) {
  json impacts = json::array();
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    const auto& contact = scene.auxiliary[k].contact;
    impacts.push_back(impact_data(run, k, contact ? contact->friction.sticking() : 0.0));
  }
  const bool soft = !run.is_rigid() && run.contact_model != "compliant" && !scene.is_compliant();
  return {{"label", label},
          {"end", run.end},
          {"status", to_string(run.status)},
          {"engine", run.engine},
          {"integrator", run.integrator},
          {"contact", run.contact_model},
          {"step", run.step},
          {"steps", run.steps},
          {"rows", run.rows()},
          {"impacts_written", run.impacts.size()},
          {"tracks", packed_run_json(machine ? pack_run(scene, *machine, run) : PackedRun())},
          {"whirl", whirl_data(run, first, limit)},
          {"impacts", impacts},
          {"longest_impact", soft ? json(kWindowSteps * run.step) : json()}};
}

}  // namespace rotorub
