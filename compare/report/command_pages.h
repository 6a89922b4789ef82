// The pages of commands without runs to play: each is one self-contained HTML file, which
// page/still_parts.js lays out from the command's result and JSON.
#pragma once

#include <string>
#include <vector>

#include "compare/bench/scene_bench.h"
#include "compare/bench/soft_contact.h"
#include "compare/modes/rub_branches.h"
#include "compare/modes/rub_key_map.h"
#include "compare/optimise/optimiser.h"
#include "compare/report/rotor_data.h"
#include "native_model/linear/rub_map.h"

namespace rotorub {

// Work-precision plots, errors over the step, stability maps, restitution.
std::string bench_page(const bench::Machine& machine, const std::vector<bench::SceneBench>& benches,
                       const std::vector<bench::RestitutionRow>& restitution);

// Campbell diagram, damping, mode shapes along the shaft, and the figures as tables.
std::string modes_page(const scene::Scene& scene, const Campbell& campbell);

// `rotorub modes --rub-map`: over two keys, which rubs are stable, how fast they decay or grow, and
// their normal force.
std::string rub_map_page(const scene::Scene& scene, const RubKeyMap& map);

// `rotorub modes --feedback-map`: over spin speed and cross-coupled feedback k, how fast the forced
// rub decays and its normal force; and the rule k(Omega) as a table and as keys of a scene.
std::string feedback_map_page(const scene::Scene& scene, const rub::FeedbackMap& map);

// `rotorub modes --periodic --across`: branches of periodic rubs over a key, named points, and
// starts without a periodic rub.
std::string branches_page(const scene::Scene& scene, const RubBranches& all);

// Maps of the evaluated scenes over their keys, and the best scene. best: its text with the best
// values; empty if no best values were found.
std::string optimum_page(const std::string& name, const optimise::Task& task,
                         const optimise::Optimum& optimum, const std::string& best);

}  // namespace rotorub
