#include "native_model/scene/rules.h"

#include <optional>
#include <utility>

#include "native_model/scene/table_reader.h"

namespace rotorub::scene {

Table rule_table() {
  return Table{
      "check",
      "Rules that `rotorub check` applies to the scene's runs "
      "([compare/check/README.md](../../compare/check/README.md)).",
      "only the rules of every run",
      nullptr,
      {key<&Rule::metric>("metric", kPure, "", "none",
                          "a summary key, `error.<column>`, `end.<column>`, `largest.<column>`, "
                          "`residual.<name>` or `count.<event>`; with `min`, `max` or both"),
       word<&Rule::engine>("engine",
                           {"native", "native-event", "native-verlet", "mujoco", "mujoco-rigid",
                            "mujoco-coulomb", "mujoco-cone", "mujoco-cone-coulomb"},
                           kStandard, "whose runs; `native`, `mujoco`: all of them"),
       key<&Rule::min>("min", kPure, "", "no limit", "smallest passing value, SI"),
       key<&Rule::max>("max", kPure, "", "no limit", "largest passing value, SI"),
       word<&Rule::expect>(
           "expect", {"pass", "refused"}, kStandard,
           "the run completes, or it is refused or ends with a status that says why"),
       key<&Rule::why>("why", kPure, "", kRequired, "why the case is hard, in a sentence")}}
      .as_list();
}

std::vector<Rule> read_rules(const Scene& scene) {
  std::vector<Diagnostic> diagnostics;
  const std::optional<TomlNode> root = parse_toml(scene.text, scene.name + ".toml", diagnostics);
  if (!root) return {};
  // The text has been read as a scene before, so everything except the rules is known to be sound.
  Scene again;
  TableReader reader(again, diagnostics);
  reader.read(*root);
  return reader.rules();
}

void check_rules(const std::vector<Rule>& rules, const Record& record,
                 std::vector<Diagnostic>& diagnostics) {
  for (std::size_t i = 0; i < rules.size(); ++i) {
    const Rule& rule = rules[i];
    const std::string path = "check[" + std::to_string(i) + "]";
    const bool metric = record.given(path + ".metric");
    const bool min = record.given(path + ".min"), max = record.given(path + ".max");
    const auto fail = [&](const std::string& key, std::string reason) {
      diagnostics.push_back(record.diagnostic(path + key, std::move(reason)));
    };
    if (metric && rule.expect == Expect::kRefused) {
      fail(".metric", "belongs to a run, and `expect` = \"refused\" says that there is none");
    } else if (metric && !min && !max) {
      fail(".metric", "has no limit: expected `min`, `max` or both");
    }
    if (!metric && (min || max)) {
      fail(min ? ".min" : ".max", "limits nothing: expected a `metric` beside it");
    }
    if (!metric && !min && !max && !record.given(path + ".expect")) {
      fail("", "says nothing: expected `metric` with `min` or `max`, or `expect`");
    }
    if (rule.min && rule.max && *rule.min > *rule.max) {
      fail(".max", "must not be below `min`");
    }
  }
}

}  // namespace rotorub::scene
