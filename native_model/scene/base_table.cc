// [base]: rows and cross-checks.

#include "native_model/scene/reading.h"
#include "native_model/scene/schema.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {

Table base_table() {
  return {
      "base",
      "Base acceleration (earthquake): a record, lines, or both.",
      "it rests",
      [](Scene& scene) -> void* { return &scene.base.emplace(); },
      {key<&Base::time>("time", kTime, "", "no table", "ascending sample times, two or more"),
       key<&Base::acceleration_x>("acceleration_x", kAcceleration, "", "0",
                                  "linear in between, 0 outside"),
       key<&Base::acceleration_y>("acceleration_y", kAcceleration, "", "0",
                                  "linear in between, 0 outside"),
       key<&Base::frequency>("frequency", kSpin, ">= 0", "no lines", "of the lines"),
       key<&Base::amplitude>("amplitude", kAcceleration, "", "needed by `frequency`",
                             "A of the lines A cos(w t + `phase`), w = `frequency`"),
       key<&Base::phase>("phase", kAngle, "", "all 0", "of the lines"),
       key<&Base::seed>("seed", kPure, ">= 0", "none", "draws the phases, the same in every run"),
       key<&Base::direction>("direction", kAngle, "", kStandard, "of the lines, from x to y"),
       key<&Base::on>("on", kTime, "", kStandard, "start"),
       key<&Base::off>("off", kTime, "", "never", "end"),
       key<&Base::ramp>("ramp", kTime, ">= 0", kStandard, "linear rise time after `on`")}};
}

void check_base(Reading& check) {
  if (!check.scene.base) return;
  const Base& base = *check.scene.base;
  check.at = "base";
  if (!check.given(".time") && !check.given(".frequency")) {
    return check.fail(
        "base",
        "has no acceleration; give `time` with `acceleration_x` or `acceleration_y`, or "
        "`frequency` with `amplitude`");
  }
  for (const char* key : {".acceleration_x", ".acceleration_y"}) check.needs(key, ".time");
  for (const char* key : {".amplitude", ".phase", ".seed", ".direction"})
    check.needs(key, ".frequency");
  check.needs(".frequency", ".amplitude");
  if (check.given(".time") && check.sound({".time"})) {
    check.abscissae(".time", base.time, "two times");
    if (!check.given(".acceleration_x") && !check.given(".acceleration_y"))
      check.fail(".time", "needs base.acceleration_x or base.acceleration_y");
    for (const char* key : {".acceleration_x", ".acceleration_y"})
      check.list_length(key, base.time.size(), "time of base.time");
  }
  if (check.given(".frequency") && check.sound({".frequency"})) {
    for (const char* key : {".amplitude", ".phase"})
      check.list_length(key, base.frequency.size(), "line of base.frequency");
  }
  check.excludes(".seed", ".phase");
  if (check.sound({".on", ".off"}) && base.off < base.on)
    check.fail(".off", "must not be before `on` = " + number_text(base.on) + " s");
}

}  // namespace rotorub::scene
