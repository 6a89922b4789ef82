// The plots and the player of one scene on a page, in the format of the page's scripts. Its runs
// stand side by side and may come from any source.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/measured/measured_run.h"
#include "compare/run_files/run_directory.h"
#include "compare/study/scene_comparison.h"
#include "renders/machine.h"

namespace rotorub {

// The referenced objects must outlive this.
struct ShownRun {
  // "native", "rigid", "coulomb", "cone", "shadow"; selects its colour in the page.
  std::string label;
  const Trajectory* trajectory = nullptr;
};

struct ShownRuns {
  const scene::Scene* scene = nullptr;
  std::vector<ShownRun> runs;                // the first two are compared initially
  const MeasuredRun* measured = nullptr;     // shown beside them; may be null
  const Trajectory* uncontrolled = nullptr;  // the first run with a passive bearing; may be null
};

ShownRuns shown_runs(const SceneComparison& comparison);
// From a run's folder, including its shadow if there is one.
ShownRuns shown_runs(const StoredRun& run, const std::optional<StoredRun>& shadow);

// For the scripts: runs as tracks (pack/packed_run.h), impacts on their laws, and the
// drawn rig.
nlohmann::json plot_data(const ShownRuns& shown);

// The parts of plot_data.
// The machine and its magnification for the first run with rows; empty if no run has rows.
std::optional<renders::Machine> drawn_machine(const ShownRuns& shown);

// {"magnification", ...}: the members of renders::Machine by their names, with lengths in drawing
// units (`unit` per metre). Parts that the scene lacks are null or [].
nlohmann::json rig_values(const scene::Scene& scene, const renders::Machine& machine);

// For each auxiliary bearing, at least one: "name" ("" if it is the only one), "touches",
// "rubs" (with friction), clearance, restitution and radius (m), its drawn parts, and "actuator",
// its characteristic curves.
nlohmann::json contacts_values(const scene::Scene& scene,
                               const std::optional<renders::Machine>& machine);

// The characteristic curves of actuator and motor, on which a run's own points are drawn (paper,
// Figs. 3 and 6).
// F(s, i) of an axis of a bearing over its current, N over A, at five positions of the ring:
// [{"name", "x", "y"}]; empty without magnets.
nlohmann::json actuator_curves(const scene::Scene& scene, std::size_t bearing);
// The motor's torque between two speeds (rad/s), N m over rpm: {"x", "y"}; null without a motor, or
// if the torque does not depend only on the speed.
nlohmann::json motor_curve(const scene::Scene& scene, double from, double to);

}  // namespace rotorub
