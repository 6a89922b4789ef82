#include "compare/check/scene_check.h"

#include <algorithm>
#include <optional>

#include "compare/bench/engines.h"
#include "compare/bench/reference.h"
#include "compare/check/metric.h"
#include "native_model/scene/record.h"

namespace rotorub::check {
namespace {

[[noreturn]] void refuse_rule(const scene::Scene& scene, std::size_t index,
                              const std::string& reason) {
  const scene::Diagnostic wrong{"", 0, "check[" + std::to_string(index) + "].metric", reason};
  throw scene::SceneError(scene::placed(scene, {wrong}));
}

Attempt attempt(const Engine& engine, const scene::Scene& scene, const RunRequest& request) {
  try {
    return {engine.run(scene, request), ""};
  } catch (const std::exception& error) {
    return {std::nullopt, error.what()};
  }
}

// `event` at the tightest tolerance that round-off leaves a use for. None where it fails.
std::optional<Trajectory> reference_of(const scene::Scene& scene, const RunRequest& request) {
  const auto engine = bench::event_engine(bench::event_parameters(bench::kReferenceTolerance));
  try {
    Trajectory run = engine->run(scene, request);
    if (run.status == Status::kOk) return run;
  } catch (const std::exception&) {
    // What keeps it from running keeps `event` too, whose case says why.
  }
  return std::nullopt;
}

}  // namespace

std::vector<scene::Rule> rules_of(const scene::Scene& scene) {
  std::vector<scene::Rule> rules = scene::read_rules(scene);
  for (std::size_t i = 0; i < rules.size(); ++i) {
    if (rules[i].metric.empty()) continue;
    try {
      check_name(rules[i].metric);
    } catch (const NoSuchMetric& error) {
      refuse_rule(scene, i, error.what());
    }
  }
  return rules;
}

std::vector<Case> check_scene(const scene::Scene& scene, const std::vector<scene::Rule>& rules,
                              const std::function<void(double, const std::string&)>& progress,
                              const std::atomic<bool>* interrupt) {
  RunRequest request;
  request.interrupt = interrupt;
  const bool compares = std::any_of(rules.begin(), rules.end(), [](const scene::Rule& rule) {
    return needs_reference(rule.metric);
  });
  const std::optional<Trajectory> reference =
      compares ? reference_of(scene, request) : std::nullopt;

  std::vector<Case> cases;
  const auto count = static_cast<double>(check_engines().size());
  for (const CheckEngine& engine : check_engines()) {
    if (interrupt != nullptr && interrupt->load()) break;
    request.progress = [&](double share) {
      progress((static_cast<double>(cases.size()) + share) / count, engine.name);
    };
    const Attempt tried = attempt(*engine.engine, scene, request);
    if (tried.trajectory && tried.trajectory->status == Status::kInterrupted) break;
    try {
      cases.push_back(
          judge(scene, engine, rules_for(engine, rules), tried, reference ? &*reference : nullptr));
    } catch (const NoSuchMetric& error) {
      for (std::size_t i = 0; i < rules.size(); ++i) {
        if (std::string(error.what()).find("`" + rules[i].metric + "`") != std::string::npos) {
          refuse_rule(scene, i, error.what());
        }
      }
      throw;
    }
  }
  return cases;
}

std::vector<Case> refused_cases(const scene::Scene& scene, const std::vector<scene::Rule>& rules,
                                const std::string& refusal) {
  std::vector<Case> cases;
  for (const CheckEngine& engine : check_engines()) {
    cases.push_back(
        judge(scene, engine, rules_for(engine, rules), {std::nullopt, refusal}, nullptr));
  }
  return cases;
}

bool holds(const std::vector<Case>& cases) {
  return std::all_of(cases.begin(), cases.end(),
                     [](const Case& c) { return !c.native || c.outcome() != Outcome::kViolates; });
}

}  // namespace rotorub::check
