// The rows of a scene's own pass rules.

#include "native_model/scene/rules.h"
#include "native_model/scene/schema.h"

namespace rotorub::scene {

Table rule_table() {
  Key min = key<&Rule::min>("min", kPure, "least value that passes, SI").otherwise("no limit");
  Key max = key<&Rule::max>("max", kPure, "largest value that passes, SI").otherwise("no limit");
  return {
      "check",
      true,
      Form::kEither,
      "Rules that `rotorub check` holds the scene's runs to ([compare/check/README.md]"
      "(../compare/check/README.md)); neither model reads them.",
      "the rules of every run alone",
      nullptr,
      {key<&Rule::metric>(
           "metric", kPure,
           "a key of the summary, `error.<column>`, `end.<column>`, "
           "`largest.<column>`, `residual.<name>` or `count.<event>`; with `min`, `max` or both")
           .otherwise("none"),
       word<&Rule::engine>("engine",
                           {"native", "native-event", "native-midpoint", "native-verlet", "mujoco",
                            "mujoco-rigid", "mujoco-coulomb", "mujoco-cone", "mujoco-cone-coulomb"},
                           "whose runs; `native` and `mujoco`: every one of them")
           .optional(),
       min, max,
       word<&Rule::expect>("expect", {"pass", "refused"},
                           "the run comes to its end; it is refused, or ended with a status "
                           "that says why")
           .optional(),
       key<&Rule::why>("why", kPure, "a sentence: why the case is hard")}};
}

}  // namespace rotorub::scene
