// [base]: rows and cross-checks.

#include "native_model/scene/checker.h"
#include "native_model/scene/schema.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {

Table base_table() {
  return {"base",
          "The base accelerates: an earthquake, a ship. All coordinates are relative to it; every "
          "mass is loaded by minus its acceleration, as by a weight. A table, lines of a spectrum, "
          "or both (Motion of the base).",
          "it rests",
          [](Scene& scene) -> void* { return &scene.base.emplace(); },
          {key<&Base::time>("time", kTime, "", "no table",
                            "times of the samples, ascending, two or more"),
           key<&Base::acceleration_x>("acceleration_x", kAcceleration, "", "0",
                                      "acceleration at each time, linear in between, 0 outside"),
           key<&Base::acceleration_y>("acceleration_y", kAcceleration, "", "0", "likewise"),
           key<&Base::frequency>("frequency", kSpin, ">= 0", "no lines",
                                 "frequency of each line of a spectrum"),
           key<&Base::amplitude>("amplitude", kAcceleration, "", "needed by `frequency`",
                                 "amplitude A of each line, A cos(w t + `phase`), t absolute"),
           key<&Base::phase>("phase", kAngle, "", "all 0", "phase of each line; not beside `seed`"),
           key<&Base::seed>("seed", kPure, ">= 0", "none",
                            "gives the lines random phases, always the same"),
           key<&Base::direction>("direction", kAngle, "", kStandard,
                                 "direction of the lines, from x to y"),
           key<&Base::on>("on", kTime, "", kStandard, "time from which it acts"),
           key<&Base::off>("off", kTime, "", "never", "time up to which it acts, not before `on`"),
           key<&Base::ramp>("ramp", kTime, ">= 0", kStandard,
                            "time in which it rises from 0 after `on`")}};
}

void check_base(const Checker& check) {
  if (!check.scene.base) return;
  const Base& base = *check.scene.base;
  const auto given = [&](const char* key) { return check.given(std::string("base.") + key); };
  // Reports a key that has no effect without another one.
  const auto needs = [&](const char* key, const char* other) {
    if (given(key) && !given(other)) {
      check.fail(std::string("base.") + key, std::string("needs base.") + other);
    }
  };
  if (!given("time") && !given("frequency")) {
    return check.fail("base",
                      "does not move: expected `time` with `acceleration_x` or "
                      "`acceleration_y`, or `frequency` with `amplitude`");
  }
  for (const char* key : {"acceleration_x", "acceleration_y"}) needs(key, "time");
  for (const char* key : {"amplitude", "phase", "seed", "direction"}) needs(key, "frequency");
  needs("frequency", "amplitude");
  if (given("time") && check.sound({"base.time"})) {
    if (base.time.size() < 2) check.fail("base.time", "expected two times or more");
    check.ascending("base.time", base.time);
    if (!given("acceleration_x") && !given("acceleration_y"))
      check.fail("base.time", "needs base.acceleration_x or base.acceleration_y");
    const std::string each = "time of base.time";
    check.list_length("base.acceleration_x", base.acceleration_x, base.time.size(), each);
    check.list_length("base.acceleration_y", base.acceleration_y, base.time.size(), each);
  }
  if (given("frequency") && check.sound({"base.frequency"})) {
    const std::string each = "line of base.frequency";
    check.list_length("base.amplitude", base.amplitude, base.frequency.size(), each);
    check.list_length("base.phase", base.phase, base.frequency.size(), each);
  }
  if (given("phase") && given("seed"))
    check.fail("base.seed", "not beside base.phase; accepted: one of the two");
  if (check.sound({"base.on", "base.off"}) && base.off < base.on)
    check.fail("base.off", "must not be before `on` = " + number_text(base.on) + " s");
}

}  // namespace rotorub::scene
