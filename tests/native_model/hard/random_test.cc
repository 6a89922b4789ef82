// Whatever users write, results are finite, or a status has a reason; and the laws hold in every
// row.
#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <string>

#include "tests/native_model/hard/random_scenes.h"
#include "tests/native_model/hard/rules.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

// Sliding that pushes itself in needs mu |G_NT| >= G_NN.
bool may_jam(const scene::Scene& s) { return s.first().contact->friction.coefficient > 0.5; }

void expect_event_keeps_every_rule(int count) {
  test::RandomScenes scenes(20);
  int touched = 0;
  for (int k = 0; k < count; ++k) {
    const scene::Scene scene = scenes.next();
    const Trajectory t = test::attempt_event(scene);
    SCOPED_TRACE("scene " + std::to_string(k));
    if (t.status != Status::kOk) {
      EXPECT_TRUE(may_jam(scene) &&
                  (t.status == Status::kNoSolution || t.status == Status::kAmbiguous))
          << t.message;
      test::expect_refused_or_finite(t);
    } else {
      test::expect_sound_event(scene, t);
    }
    touched += t.statistics.first_touch >= 0.0 ? 1 : 0;
  }
  EXPECT_GT(touched, count / 2) << "the scenes must reach the ring";
}

TEST(HardRandom, EventKeepsEveryRule) { expect_event_keeps_every_rule(50); }

TEST(HardRandomNightly, EventKeepsEveryRule) { expect_event_keeps_every_rule(1000); }

// ---------------------------------------------------------------- several contacts
// Shafts in two or three auxiliary bearings, rigid and giving ones together, most of them at
// standstill and in one plane, where friction has nothing to decide and round-off would.

class RandomShafts {
 public:
  explicit RandomShafts(unsigned seed) : random_(seed) {}

  scene::Scene next() {
    scene::Scene s = test::make_scene({.speed = one_of({0.0, 0.0, 0.0, 60.0, -300.0})});
    s.run.end = 0.05;
    s.run.output_step = 1e-3;
    s.rotor.modal = scene::RotorModal{};
    const int modes = random_.chance(0.5) ? 2 : 3;
    for (int i = 0; i < modes; ++i) {
      const double mass = random_.decade(0.5, 5.0), omega = random_.decade(100.0, 1500.0) * (i + 1);
      s.rotor.modal->mass.push_back(mass);
      s.rotor.modal->stiffness.push_back(mass * omega * omega);
      s.rotor.modal->damping.push_back(one_of({0.0, 0.002, 0.02, 0.1}) * mass * omega);
    }
    s.auxiliary.resize(random_.chance(0.7) ? 2 : 3, s.first());
    for (scene::AuxiliaryBearing& bearing : s.auxiliary) add_contact(s, bearing, modes);
    return s;
  }

 private:
  double one_of(std::initializer_list<double> values) {
    const auto n = static_cast<double>(values.size());
    return values.begin()[static_cast<int>(random_.between(0.0, n))];
  }
  void add_contact(scene::Scene& s, scene::AuxiliaryBearing& bearing, int modes) {
    scene::Contact& contact = *bearing.contact;
    contact.clearance = one_of({5e-5, 1e-4, 2e-4});
    contact.friction = one_of({0.0, 0.05, 0.15, 0.3, 0.6});
    contact.restitution = one_of({0.0, 0.0, 0.3, 0.5, 0.8, 1.0});
    contact.shape = {1.0};
    for (int i = 1; i < modes; ++i) contact.shape.push_back(random_.between(-1.2, 1.2));
    if (random_.chance(0.5)) {
      const bool line = random_.chance(0.5);
      // At a tenth of the clearance both are as stiff.
      const double stiffness = s.rotor.modal->stiffness[0] * random_.decade(100.0, 1000.0);
      contact.compliance =
          line ? Compliance{.stiffness = stiffness, .exponent = 1.0}
               : Compliance{.stiffness = stiffness / std::sqrt(0.1 * contact.clearance),
                            .exponent = 1.5};
    }
    if (random_.chance(0.6)) {
      const double mass = one_of({0.3, 1.0, 3.0}), damping = one_of({0.0, 10.0, 200.0, 1200.0}),
                   stiffness = random_.decade(1e5, 3e7);
      bearing.stator = scene::Stator{{mass, mass}, {damping, damping}, {stiffness, stiffness}};
    }
    // Enough to reach the ring, by the first mode.
    const double enough = contact.clearance * s.rotor.modal->stiffness[0];
    test::add_constant_force(
        s, {one_of({0.0, 0.0, 0.5}) * enough, -random_.between(0.3, 3.0) * enough});
    s.forces.back().shape = contact.shape;
    if (random_.chance(0.4)) s.forces.back().off = 0.02;
    if (random_.chance(0.3)) s.forces.back().on = 0.003;
  }

  test::RandomScenes random_;
};

void expect_event_settles(int scenes) {
  RandomShafts shafts(17);
  int touched = 0;
  for (int k = 0; k < scenes; ++k) {
    const scene::Scene s = shafts.next();
    const Trajectory t = test::attempt_event(s);
    SCOPED_TRACE("scene " + std::to_string(k));
    // Some walls are too soft for the load, and some elastic contacts bounce without end; the run
    // reports it.
    const bool through = t.message.find("deep in the ring") != std::string::npos;
    const bool bounces = t.message.find("bounces without end") != std::string::npos;
    EXPECT_TRUE(t.status == Status::kOk || through || bounces) << t.message;
    EXPECT_LT(t.statistics.energy_residual(), 1e-8);
    for (const double y : t.column("rotor_y")) ASSERT_TRUE(std::isfinite(y));
    touched += t.statistics.first_touch >= 0.0 ? 1 : 0;
  }
  EXPECT_GT(touched, scenes / 2) << "the scenes must reach the rings";
}

TEST(HardRandomContactsLong, EventSettlesEveryOne) { expect_event_settles(30); }

// Scene 430 has two contacts: a rigid one sticks while the compliant one begins to slip, against a
// slip of 1.5e-9 of its speed to which it had drifted. Later its wall is too soft for the load.
TEST(HardRandomContacts, ADriftDoesNotStopASlipThatBegins) {
  RandomShafts shafts(17);
  for (int k = 0; k < 430; ++k) shafts.next();
  const Trajectory t = test::attempt_event(shafts.next());
  EXPECT_NE(t.message.find("deep in the ring"), std::string::npos) << t.message;
  EXPECT_GT(t.end, 0.003);
  EXPECT_LT(t.statistics.energy_residual(), 1e-8);
}

TEST(HardRandomContactsNightly, EventSettlesEveryOne) { expect_event_settles(600); }

}  // namespace
}  // namespace rotorub
