#include "compare/report/run_data.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "compare/base/plot_points.h"
#include "compare/report/pack/packed_run.h"
#include "compare/report/whirl_plots.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {

namespace {

using nlohmann::json;

// The impacts of one contact, fewer than all if there are many.
json impact_data(const Trajectory& run, std::size_t contact) {
  std::vector<Impact> impacts = counted_impacts(run, contact);
  std::erase_if(impacts, [](const Impact& impact) { return impact.normal_impulse <= 0.0; });
  std::vector<double> normal;
  for (const Impact& impact : impacts) normal.push_back(impact.normal_impulse);
  const auto kept = thin(normal, 0, normal.size(), kPlotBuckets);
  const auto of_each = [&](double Impact::*member) {
    return list_of(kept, [&](std::size_t k) { return impacts[k].*member; });
  };
  return {{"t", of_each(&Impact::t)},
          {"normal", of_each(&Impact::normal_impulse)},
          {"friction", of_each(&Impact::friction_impulse)},
          {"before", of_each(&Impact::gap_rate_before)},
          {"after", of_each(&Impact::gap_rate_after)},
          {"slip", of_each(&Impact::slip_after)}};
}

}  // namespace

json run_data(const scene::Scene& scene, const std::string& label, const Trajectory& run,
              const Trajectory* first, const renders::Machine* machine, double limit) {
  json impacts = json::array();
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    impacts.push_back(impact_data(run, k));
  }
  const bool soft = !run.is_rigid() && run.contact_model != "compliant" && !scene.is_compliant();
  return {{"label", label},
          {"end", run.end},
          {"status", to_string(run.status)},
          {"message", run.message},
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
