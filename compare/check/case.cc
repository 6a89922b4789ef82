#include "compare/check/case.h"

#include <fmt/format.h>

#include <algorithm>

#include "compare/check/laws.h"
#include "compare/check/metric.h"
#include "compare/metrics/metrics.h"

namespace rotorub::check {
namespace {

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

// Why it did not run to its end; "step_too_large: ..." of a run that has a status.
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
          violated(rule.metric.c_str(), "`event` did not come to the end: nothing to measure by"));
      continue;
    }
    verdicts.push_back(limited(rule.metric, measure(rule.metric, scene, trajectory, reference),
                               rule.min, rule.max));
  }
  return verdicts;
}

// `laws`: how many of the verdicts are of every run.
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

}  // namespace

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
          violated(kRefusal, "it ran to its end, and its file says that it is refused");
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

}  // namespace rotorub::check
