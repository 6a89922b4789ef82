#include "compare/report/shown_runs.h"

#include <algorithm>

namespace rotorub {

ShownRuns shown_runs(const SceneComparison& comparison) {
  ShownRuns shown{&comparison.scene, {}, nullptr, nullptr};
  for (const Side& side : comparison.sides) shown.runs.push_back({side.label, &side.trajectory});
  if (comparison.measured) shown.measured = &*comparison.measured;
  if (comparison.uncontrolled) shown.uncontrolled = &*comparison.uncontrolled;
  return shown;
}

ShownRuns shown_runs(const StoredRun& run, const std::optional<StoredRun>& shadow) {
  const Trajectory& t = run.trajectory;
  ShownRuns shown{
      &run.scene, {{t.engine == "mujoco" ? t.contact_model : "native", &t}}, nullptr, nullptr};
  if (shadow) shown.runs.push_back({"shadow", &shadow->trajectory});
  return shown;
}

std::optional<double> first_touch(const Trajectory& trajectory) {
  if (trajectory.statistics.first_touch >= 0.0) return trajectory.statistics.first_touch;
  // A run that was read from its folder has no statistics.
  std::optional<double> first;
  if (!trajectory.impacts.empty()) first = trajectory.impacts.front().t;
  if (!trajectory.has("normal_force")) return first;
  const auto& force = trajectory.column("normal_force");
  const auto row = std::find_if(force.begin(), force.end(), [](double f) { return f > 0.0; });
  if (row == force.end()) return first;
  const double t = trajectory.column("t")[static_cast<std::size_t>(row - force.begin())];
  return first ? std::min(*first, t) : t;
}

}  // namespace rotorub
