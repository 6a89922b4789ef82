// Every pair of a machine's parts, by every fixed-step scheme against `event`: the error must fall
// with the step at the scheme's order. Terms that each work alone and go wrong together (unbalance,
// gyroscopics and a free spin, say) show as an order lost.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/native_model/hard/orders.h"

namespace rotorub::test {
namespace {

class LongPairs : public ::testing::TestWithParam<std::string> {
 protected:
  std::vector<Pair> pairs() const { return pairs_from(GetParam(), Pairs::kEveryEighth); }
};

TEST_P(LongPairs, VerletIsOfSecondOrder) {
  expect_order(pairs(), Integrator::kVerlet, kVerletOrder);
}

class NightlyPairs : public ::testing::TestWithParam<std::string> {
 protected:
  std::vector<Pair> pairs() const { return pairs_from(GetParam(), Pairs::kAll); }
};

TEST_P(NightlyPairs, VerletIsOfSecondOrder) {
  expect_order(pairs(), Integrator::kVerlet, kVerletOrder);
}

INSTANTIATE_TEST_SUITE_P(From, NightlyPairs, ::testing::ValuesIn(part_names()),
                         [](const auto& part) { return part.param; });
INSTANTIATE_TEST_SUITE_P(From, LongPairs, ::testing::ValuesIn(part_names()),
                         [](const auto& part) { return part.param; });

// ---------------------------------------------------------------- triples
// Three parts of a machine at a time, by `verlet` against `event`.

// Spin and bending share a mass matrix that turns, with every other part; slow enough for an
// eccentricity that couples them strongly.
std::vector<Pair> coupled(const std::string& drive) {
  Part unbalance, driven;
  std::vector<Pair> out;
  for (const Part& part : pair_parts()) {
    if (part.name == "unbalance") unbalance = part;
    if (part.name == drive) driven = part;
  }
  unbalance.name = "coupled";
  unbalance.geometry = {"rotor.disc[0].eccentricity=4e-3", "rotor.disc[0].phase=0.7",
                        "rotor.speed=150.0"};
  for (const Part& part : pair_parts()) {
    if (part.group == "drive" || part.name == "unbalance" || part.geometry.empty()) continue;
    out.push_back({Form::kGeometry, {unbalance, driven, part}});
  }
  return out;
}

TEST(LongTriple, UnbalanceOnAFreeSpin) {
  expect_order(coupled("free_spin"), Integrator::kVerlet, kVerletOrder);
}
TEST(LongTriple, UnbalanceOnAMotor) {
  expect_order(coupled("kloss_drive"), Integrator::kVerlet, kVerletOrder);
}

// ---------------------------------------------------------------- features of the contact
// Rebound, stick, separation and reversal of a contact, by the fixed-step schemes against `event`.

// Overrides of the modal base (tests/support/pair_parts.h), each with a condition that the
// reference run must meet.
struct ContactFeature {
  std::string name;
  std::vector<std::string> overrides;  // of the modal form
  bool (*shown)(const Trajectory&);
};

bool has_event(const Trajectory& t, EventKind kind, EventKind then) {
  bool first = false;
  for (const Event& e : t.events) {
    if (first && e.kind == then) return true;
    if (e.kind == kind) first = true;
  }
  return first && kind == then;
}

bool slip_reverses(const Trajectory& t) {
  const std::vector<double>&slip = t.column("slip"), &mode = t.column("mode");
  for (std::size_t k = 1; k < t.rows(); ++k) {
    const bool slides = mode[k] == 1.0 && mode[k - 1] == 1.0;
    if (slides && slip[k] * slip[k - 1] < 0.0) return true;
  }
  return false;
}

std::vector<ContactFeature> contact_features() {
  return {
      {"restitution_0",
       {"contact.restitution=0.0"},
       [](const Trajectory& t) { return has_event(t, EventKind::kSlide, EventKind::kSlide); }},
      {"elastic",
       {"contact.restitution=1.0"},
       [](const Trajectory& t) { return t.impacts.size() > 2; }},
      {"tangential_restitution",
       {"contact.tangential_restitution=0.7", "contact.friction=0.9", "rotor.speed=4.0"},
       // Some impact reversed the slip.
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

class LongFeature : public ::testing::TestWithParam<std::string> {
 protected:
  static ContactFeature feature() {
    for (const ContactFeature& f : contact_features()) {
      if (f.name == GetParam()) return f;
    }
    return {};
  }
  // Alone, and with the parts that affect a contact.
  static std::vector<scene::Scene> scenes() {
    std::vector<scene::Scene> out;
    out.push_back(scene_of(Form::kModal, {}, feature().overrides));
    for (const Part& part : pair_parts()) {
      for (const char* name : {"gyroscopics", "torsion", "free_spin", "anisotropic_rotor",
                               "anisotropic_ring", "continuous_support", "gravity"}) {
        if (part.name != name) continue;
        out.push_back(scene_of(Form::kModal, {part}, feature().overrides));
      }
    }
    return out;
  }
  static void expect_order(Integrator integrator, double least) {
    Table table;
    for (const scene::Scene& scene : scenes()) {
      const Trajectory exact = reference(scene);
      EXPECT_TRUE(feature().shown(exact)) << scene.name << " does not show " << GetParam();
      table.judge(scene.name, converge(scene, integrator, exact), least);
    }
    EXPECT_FALSE(table.short_of_order) << "least order " << least << '\n' << table.text;
  }
};

TEST_P(LongFeature, VerletIsOfSecondOrder) {
  // The force jumps within the step of a reversal, and of the first sticking, which is located
  // within the step.
  const bool jumps = std::string(GetParam()) == "reversal" || std::string(GetParam()) == "sticking";
  expect_order(Integrator::kVerlet, jumps ? 1.5 : kVerletOrder);
}

std::vector<std::string> feature_names() {
  std::vector<std::string> names;
  for (const ContactFeature& f : contact_features()) names.push_back(f.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Of, LongFeature, ::testing::ValuesIn(feature_names()),
                         [](const auto& feature) { return feature.param; });

}  // namespace
}  // namespace rotorub::test
