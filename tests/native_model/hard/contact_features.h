// What a contact can do: overrides of the modal base (tests/support/pair_parts.h), each with a
// predicate on the reference that says that it was done.
#pragma once

#include <string>
#include <vector>

#include "native_model/trajectory/trajectory.h"

namespace rotorub::test {

struct ContactFeature {
  std::string name;
  std::vector<std::string> overrides;  // of the modal form
  bool (*shown)(const Trajectory&);
};

inline bool has_event(const Trajectory& t, EventKind kind, EventKind then) {
  bool first = false;
  for (const Event& e : t.events) {
    if (first && e.kind == then) return true;
    if (e.kind == kind) first = true;
  }
  return first && kind == then;
}

inline bool slip_reverses(const Trajectory& t) {
  const std::vector<double>&slip = t.column("slip"), &mode = t.column("mode");
  for (std::size_t k = 1; k < t.rows(); ++k) {
    const bool slides = mode[k] == 1.0 && mode[k - 1] == 1.0;
    if (slides && slip[k] * slip[k - 1] < 0.0) return true;
  }
  return false;
}

inline std::vector<ContactFeature> contact_features() {
  return {
      {"restitution_0",
       {"contact.restitution=0.0"},
       [](const Trajectory& t) { return has_event(t, EventKind::kSlide, EventKind::kSlide); }},
      {"elastic",
       {"contact.restitution=1.0"},
       [](const Trajectory& t) { return t.impacts.size() > 2; }},
      {"tangential_restitution",
       {"contact.tangential_restitution=0.7", "contact.friction=0.9", "rotor.speed=4.0"},
       // Some impact threw the slip back.
       [](const Trajectory& t) {
         for (const Impact& i : t.impacts) {
           if (counts(i) && i.slip_before * i.slip_after < 0.0) return true;
         }
         return false;
       }},
      {"sticking",
       {"contact.friction=1.2", "contact.restitution=0.0", "rotor.speed=0.0",
        "force[0].frequency=20.0", "force[0].amplitude=300.0"},
       [](const Trajectory& t) { return has_event(t, EventKind::kStick, EventKind::kStick); }},
      {"lift_off",
       {"contact.restitution=0.0", "force[0].off=5.4321e-3", "run.end=0.025"},
       [](const Trajectory& t) { return has_event(t, EventKind::kLiftOff, EventKind::kImpact); }},
      // A pendulum on the ring whose weight along it is far more than friction holds.
      {"reversal",
       {"contact.restitution=0.0", "contact.friction=0.03", "rotor.speed=0.0",
        "force[0].frequency=0.0", "force[0].phase=0.2", "force[0].amplitude=300.0",
        "initial.vx=[0.1]", "initial.vy=[0.25]"},
       slip_reverses},
  };
}

}  // namespace rotorub::test
