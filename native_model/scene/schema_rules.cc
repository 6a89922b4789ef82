// The rows of a scene's own pass rules.

#include "native_model/scene/rules.h"
#include "native_model/scene/schema.h"

namespace rotorub::scene {

Table rule_table() {
  return Table{
      "check",
      "Rules that `rotorub check` holds the scene's runs to ([compare/check/README.md]"
      "(../compare/check/README.md)); neither model reads them.",
      "the rules of every run alone",
      nullptr,
      {key<&Rule::metric>(
           "metric", kPure, "", "none",
           "a key of the summary, `error.<column>`, `end.<column>`, `largest.<column>`, "
           "`residual.<name>` or `count.<event>`; with `min`, `max` or both"),
       word<&Rule::engine>("engine",
                           {"native", "native-event", "native-midpoint", "native-verlet", "mujoco",
                            "mujoco-rigid", "mujoco-coulomb", "mujoco-cone", "mujoco-cone-coulomb"},
                           kStandard, "whose runs; `native` and `mujoco`: every one of them"),
       key<&Rule::min>("min", kPure, "", "no limit", "least value that passes, SI"),
       key<&Rule::max>("max", kPure, "", "no limit", "largest value that passes, SI"),
       word<&Rule::expect>(
           "expect", {"pass", "refused"}, kStandard,
           "the run comes to its end; it is refused, or ended with a status that says why"),
       key<&Rule::why>("why", kPure, "", kRequired, "a sentence: why the case is hard")}}
      .as_list();
}

}  // namespace rotorub::scene
