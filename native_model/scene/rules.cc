#include "native_model/scene/rules.h"

#include <optional>

#include "native_model/scene/reading.h"

namespace rotorub::scene {

Table rule_table() {
  return Table{
      "check",
      "Rules of [`rotorub check`](../../compare/check/README.md).",
      "only the rules of every run",
      nullptr,
      {key<&Rule::metric>("metric", kPure, "", "none",
                          "a summary key, `error.<column>`, `end.<column>`, `largest.<column>`, "
                          "`residual.<name>` or `count.<event>`; with `min`, `max` or both"),
       word<&Rule::engine>("engine",
                           {"native", "native-event", "native-verlet", "mujoco", "mujoco-rigid",
                            "mujoco-coulomb", "mujoco-cone", "mujoco-cone-coulomb"},
                           kStandard, "runs that are checked"),
       key<&Rule::min>("min", kPure, "", "no limit", "limit of a passing value, in SI units"),
       key<&Rule::max>("max", kPure, "", "no limit", "limit of a passing value, in SI units"),
       word<&Rule::expect>("expect", {"pass", "refused"}, kStandard,
                           "the run completes, or is refused or fails with a reason"),
       key<&Rule::why>("why", kPure, "", kRequired, "why the case is hard")}}
      .as_list();
}

std::vector<Rule> read_rules(const Scene& scene) {
  std::vector<Diagnostic> diagnostics;
  std::optional<TomlNode> root = parse_toml(scene.text, scene.name + ".toml", diagnostics);
  if (!root) return {};
  Scene again;
  Reading reading(again, diagnostics);
  reading.read(*root);
  return reading.rules();
}

void check_rules(Reading& check) {
  for (std::size_t i = 0; i < check.rules().size(); ++i) {
    const Rule& rule = check.rules()[i];
    check.at = list_element("check", i);
    const bool metric = check.given(".metric");
    const bool min = check.given(".min"), max = check.given(".max");
    if (metric && rule.expect == Expect::kRefused) {
      check.fail(
          ".metric",
          "needs a run, but `expect` = \"refused\" says that there is none; remove one of them");
    } else if (metric && !min && !max) {
      check.fail(".metric", "has no limit; give `min`, `max` or both");
    }
    if (!metric && (min || max)) {
      check.fail(min ? ".min" : ".max", "has nothing to limit; give a `metric` too");
    }
    if (!metric && !min && !max && !check.given(".expect")) {
      check.fail(check.at, "is empty; give a `metric` with `min` or `max`, or `expect`");
    }
    if (rule.min && rule.max && *rule.min > *rule.max) {
      check.fail(".max", "must not be below `min`");
    }
  }
}

}  // namespace rotorub::scene
