// [base]: rows and cross-checks.

#include "native_model/scene/checker.h"
#include "native_model/scene/schema.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {

Table base_table() {
  return {
      "base",
      "Acceleration of the base, for example by an earthquake: a sampled record, lines of a "
      "spectrum, or both. All coordinates are relative to the base.",
      "it rests",
      [](Scene& scene) -> void* { return &scene.base.emplace(); },
      {key<&Base::time>("time", kTime, "", "no table", "sample times, ascending, two or more"),
       key<&Base::acceleration_x>("acceleration_x", kAcceleration, "", "0",
                                  "samples, linear in between, 0 outside"),
       key<&Base::acceleration_y>("acceleration_y", kAcceleration, "", "0", "samples in y"),
       key<&Base::frequency>("frequency", kSpin, ">= 0", "no lines", "frequencies of the lines"),
       key<&Base::amplitude>("amplitude", kAcceleration, "", "needed by `frequency`",
                             "amplitudes A of the lines A cos(w t + `phase`)"),
       key<&Base::phase>("phase", kAngle, "", "all 0", "phases of the lines; not beside `seed`"),
       key<&Base::seed>("seed", kPure, ">= 0", "none",
                        "draws random phases, the same in every run"),
       key<&Base::direction>("direction", kAngle, "", kStandard,
                             "direction of the lines, from x to y"),
       key<&Base::on>("on", kTime, "", kStandard, "start"),
       key<&Base::off>("off", kTime, "", "never", "end, not before `on`"),
       key<&Base::ramp>("ramp", kTime, ">= 0", kStandard, "rise time after `on`")}};
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
