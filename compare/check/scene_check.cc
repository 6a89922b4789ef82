#include "compare/check/scene_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "compare/bench/engines.h"
#include "compare/bench/reference.h"
#include "compare/check/metric.h"
#include "compare/check/verdict.h"
#include "compare/metrics/metrics.h"
#include "native_model/scene/record.h"

namespace rotorub::check {
namespace {

using scene::RuleEngine;

CheckEngine native(scene::Integrator integrator, RuleEngine word) {
  std::shared_ptr<const Engine> engine = native_engine(integrator);
  return {engine->name(), rotorub::to_string(integrator),          word,
          true,           integrator == scene::Integrator::kEvent, engine};
}

CheckEngine mujoco(scene::ContactModel contact, RuleEngine word) {
  std::shared_ptr<const Engine> engine = mujoco_engine(contact);
  const char* column =
      contact == scene::ContactModel::kConeCoulomb ? "cone-c" : scene::to_string(contact);
  return {engine->name(), column, word, false, false, engine};
}

constexpr const char* kToItsEnd = "runs to its end";
constexpr const char* kRefusal = "refused";

bool is_refusal(Status status) {
  return status == Status::kStepTooLarge || status == Status::kNoSolution ||
         status == Status::kAmbiguous || status == Status::kOutOfRange;
}

bool expects_refusal(const std::vector<scene::Rule>& rules) {
  return std::any_of(rules.begin(), rules.end(), [](const scene::Rule& rule) {
    return rule.expect == scene::Expect::kRefused;
  });
}

// Why the run did not reach its end; "step_too_large: ..." if it has a status.
std::string reason_of(const Attempt& attempt) {
  if (!attempt.trajectory) return attempt.refusal;
  return fmt::format("{}: {}", to_string(attempt.trajectory->status), attempt.trajectory->message);
}

Verdict violated(const char* rule, const std::string& reason) {
  return {Outcome::kViolates, rule, std::nullopt, std::nullopt, reason};
}

Verdict refusal_verdict(const CheckEngine& engine, const std::vector<scene::Rule>& rules,
                        const Attempt& attempt) {
  const bool silent =
      attempt.trajectory ? attempt.trajectory->message.empty() : attempt.refusal.empty();
  if (silent) return violated(kRefusal, reason_of(attempt) + "no reason is given");
  if (expects_refusal(rules)) return {Outcome::kRefused, kRefusal, {}, {}, reason_of(attempt)};
  if (engine.native) return violated(kToItsEnd, reason_of(attempt));
  return {Outcome::kRefused, kToItsEnd, {}, {}, reason_of(attempt)};
}

std::vector<Verdict> measured(const scene::Scene& scene, const std::vector<scene::Rule>& rules,
                              const Trajectory& trajectory, const Trajectory* reference) {
  std::vector<Verdict> verdicts;
  for (const scene::Rule& rule : rules) {
    if (rule.metric.empty()) continue;
    if (needs_reference(rule.metric) && reference == nullptr) {
      verdicts.push_back(
          violated(rule.metric.c_str(),
                   "`event` did not reach the end, so there is nothing to measure against"));
      continue;
    }
    verdicts.push_back(limited(rule.metric, measure(rule.metric, scene, trajectory, reference),
                               rule.min, rule.max));
  }
  return verdicts;
}

// laws: number of leading verdicts that apply to every run.
Verdict deciding(const std::vector<Verdict>& verdicts, std::size_t laws) {
  const auto worst =
      std::max_element(verdicts.begin(), verdicts.end(),
                       [](const Verdict& a, const Verdict& b) { return excess(a) < excess(b); });
  if (worst->outcome == Outcome::kViolates) return *worst;
  const auto refused = std::find_if(verdicts.begin(), verdicts.end(), [](const Verdict& v) {
    return v.outcome == Outcome::kRefused;
  });
  if (refused != verdicts.end()) return *refused;
  return laws < verdicts.size() ? verdicts[laws] : verdicts.front();
}

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

// A run of `event` at the tightest tolerance that round-off permits; empty if it fails.
std::optional<Trajectory> reference_of(const scene::Scene& scene, const RunRequest& request) {
  const auto engine = event_engine(bench::event_parameters(bench::kReferenceTolerance));
  try {
    Trajectory run = engine->run(scene, request);
    if (run.status == Status::kOk) return run;
  } catch (const std::exception&) {
    // `event` fails for the same reason, and its own case reports it.
  }
  return std::nullopt;
}

}  // namespace

const std::vector<CheckEngine>& check_engines() {
  static const std::vector<CheckEngine> all{
      native(scene::Integrator::kEvent, RuleEngine::kNativeEvent),
      native(scene::Integrator::kVerlet, RuleEngine::kNativeVerlet),
      mujoco(scene::ContactModel::kRigid, RuleEngine::kMujocoRigid),
      mujoco(scene::ContactModel::kCoulomb, RuleEngine::kMujocoCoulomb),
      mujoco(scene::ContactModel::kCone, RuleEngine::kMujocoCone),
      mujoco(scene::ContactModel::kConeCoulomb, RuleEngine::kMujocoConeCoulomb)};
  return all;
}

std::vector<scene::Rule> rules_for(const CheckEngine& engine,
                                   const std::vector<scene::Rule>& rules) {
  const auto of = [&](RuleEngine family) {
    std::vector<scene::Rule> own;
    for (const scene::Rule& rule : rules) {
      if (rule.engine == engine.word || rule.engine == family) own.push_back(rule);
    }
    return own;
  };
  const std::vector<scene::Rule> own =
      of(engine.native ? RuleEngine::kNative : RuleEngine::kMujoco);
  return engine.native || !own.empty() ? own : of(RuleEngine::kNative);
}

Case judge(const scene::Scene& scene, const CheckEngine& engine,
           const std::vector<scene::Rule>& rules, const Attempt& attempt,
           const Trajectory* reference) {
  Case result{scene.name, engine.name, engine.native, {}, {}};
  std::vector<Verdict>& verdicts = result.verdicts;
  std::size_t laws = 0;
  const Trajectory* run = attempt.trajectory ? &*attempt.trajectory : nullptr;
  if (run != nullptr && run->status == Status::kOk) {
    verdicts.push_back({Outcome::kPass, kToItsEnd, {}, {}, ""});
    if (expects_refusal(rules)) {
      verdicts.back() =
          violated(kRefusal, "it ran to its end, but its file says that it is refused");
    }
    for (Verdict& v : law_verdicts(*run, contact_facts(scene), engine.exact_rows)) {
      verdicts.push_back(std::move(v));
    }
    laws = verdicts.size();
    for (Verdict& v : measured(scene, rules, *run, reference)) verdicts.push_back(std::move(v));
  } else if (run != nullptr && !is_refusal(run->status)) {
    verdicts = {violated(kToItsEnd, reason_of(attempt)), finite_verdict(*run)};
  } else {
    verdicts.push_back(refusal_verdict(engine, rules, attempt));
    if (run != nullptr) verdicts.push_back(finite_verdict(*run));
    laws = verdicts.size();
  }
  result.deciding = deciding(verdicts, laws);
  return result;
}

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
