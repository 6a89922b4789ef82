// Two auxiliary bearings against a second program (two_rings/README.md), and against closed forms
// for several contacts.

#include <gtest/gtest.h>

#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"
#include "tests/support/two_rings.h"

namespace rotorub {
namespace {

int counted(const Trajectory& t, int contact) {
  return static_cast<int>(std::count_if(t.impacts.begin(), t.impacts.end(), [&](const Impact& i) {
    return i.contact == contact && counts(i);
  }));
}

class TwoRings : public testing::TestWithParam<const char*> {};

// Positions to 5e-13 m and velocities to 5e-11 m/s: a thousandth of what a bounce at the end of an
// accumulation is.
TEST_P(TwoRings, AgreesWithASecondProgram) {
  const nlohmann::json exact = test::two_rings_answer(GetParam());
  const scene::Scene scene = test::two_rings_scene(GetParam());
  const Trajectory t = test::run_event(scene);
  for (const nlohmann::json& row : exact.at("rows")) {
    const std::size_t k = test::row_of(t, row.at("t"));
    ASSERT_LT(k, t.rows());
    for (const auto& [column, value] : row.at("state").items()) {
      const double found = test::state_of(t, scene, column, k);
      const bool rate = column.find("_v") != std::string::npos || column.starts_with("v");
      const double bound = column == "spin_speed" ? 1e-9 : rate ? 5e-11 : 5e-13;
      EXPECT_NEAR(found, value.get<double>(), bound) << column << " at " << row.at("t");
    }
    for (const auto& [column, mode] : row.at("modes").items()) {
      const std::size_t contact = column.starts_with("contact2_") ? 1 : 0;
      if (scene.auxiliary[contact].contact->friction.coefficient == 0.0)
        continue;  // sliding and sticking are one there
      EXPECT_EQ(to_string(static_cast<ContactMode>(static_cast<int>(t.column(column)[k]))), mode)
          << column << " at " << row.at("t");
    }
  }
  const nlohmann::json& figures = exact.at("contacts");
  ASSERT_EQ(t.statistics.contacts.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(counted(t, static_cast<int>(k)), figures.at("impacts")[k]);
    EXPECT_NEAR(t.statistics.contacts[k].impulse_total,
                figures.at("normal_impulse")[k].get<double>(), 1e-9);
    EXPECT_NEAR(t.statistics.contacts[k].friction_impulse,
                figures.at("friction_impulse")[k].get<double>(), 1e-9);
  }
  EXPECT_LT(t.statistics.energy_residual(), 1e-11);
}

INSTANTIATE_TEST_SUITE_P(, TwoRings,
                         testing::Values("drop", "rub", "moving", "rolling", "conical",
                                         "cylindrical"),
                         [](const auto& of) { return std::string(of.param); });

double end_of(const Trajectory& t, const char* column) { return t.column(column).back(); }

TEST(SeveralContacts, ACentralHitIsOneContactWithTheSumOfTheMasses) {
  test::Jeffcott of{.friction = 0.2, .restitution = 0.5, .speed = 100.0};
  scene::Scene two = test::shaft_in_two_rings(3.0, 1.0, -1.0, of), one = test::make_scene(of);
  one.rotor.modal->mass = {3.0};
  for (scene::Scene* s : {&two, &one}) {
    s->initial.vx = {0.3};
    s->run.end = 0.03;
  }
  two.initial.vx = {0.3, 0.0};
  const Trajectory t = test::run_event(two), exact = test::run_event(one);
  ASSERT_GE(exact.impacts.size(), 2u);
  ASSERT_EQ(t.impacts.size(), 2 * exact.impacts.size());
  for (std::size_t k = 0; k < exact.impacts.size(); ++k) {
    const Impact &left = t.impacts[2 * k], &right = t.impacts[2 * k + 1], &whole = exact.impacts[k];
    EXPECT_EQ(left.t, right.t);
    EXPECT_NE(left.contact, right.contact);
    EXPECT_NEAR(left.t, whole.t, 1e-15);
    EXPECT_NEAR(left.normal_impulse, 0.5 * whole.normal_impulse, 1e-14);
    EXPECT_NEAR(right.friction_impulse, 0.5 * whole.friction_impulse, 1e-14);
  }
  EXPECT_NEAR(end_of(t, "rotor_x"), end_of(exact, "rotor_x"), 1e-15);
  EXPECT_NEAR(end_of(t, "contact2_rotor_y"), end_of(exact, "rotor_y"), 1e-15);
}

// 1/m - a b/I = 0: with the modal masses m and I/a^2 and the tilt -b/a.
TEST(SeveralContacts, AtTheCentreOfPercussionTheOtherContactFeelsNothing) {
  scene::Scene s = test::shaft_in_two_rings(2.0, 1.5, -0.75, {.restitution = 0.5});

  // Both ends at the first contact's side: the second one lies on its circle at rest, the first
  // comes.
  const double at_second = 0.5e-3, at_first = 0.4e-3;
  const double tilt = (at_first - at_second) / 1.75;
  s.initial.x = {at_first - tilt, tilt};
  s.initial.vx = {0.75 / 1.75 * 0.1, 0.1 / 1.75};  // 0.1 m/s at the first, 0 at the second
  s.run.end = 2e-3;
  const Trajectory t = test::run_event(s);
  ASSERT_FALSE(t.impacts.empty());
  EXPECT_NEAR(t.impacts.front().t, 1e-3, 1e-15);
  EXPECT_EQ(counted(t, 0), 1);
  EXPECT_EQ(counted(t, 1), 0);
  EXPECT_LT(t.statistics.contacts[1].impulse_total, 1e-15);
  EXPECT_NEAR(end_of(t, "contact2_gap"), 0.0, 1e-16);
}

TEST(SeveralContacts, TwoLikeRingsOfOneKilogramAreOneOfTwo) {
  test::Jeffcott of{.friction = 0.15, .restitution = 0.4, .speed = 80.0};
  scene::Scene two = test::shaft_in_two_rings(3.0, 1.0, -1.0, of), one = test::make_scene(of);
  one.rotor.modal->mass = {3.0};
  test::add_ring(one, 2.0, 60.0, 4e5);
  for (scene::AuxiliaryBearing& bearing : two.auxiliary) {
    bearing.stator = scene::Stator{{1.0, 1.0}, {30.0, 30.0}, {2e5, 2e5}};
  }
  one.initial.vx = {0.3}, one.initial.vy = {0.1}, two.initial.vx = {0.3, 0.0},
  two.initial.vy = {0.1, 0.0};
  one.run.end = two.run.end = 0.02;
  const Trajectory t = test::run_event(two), exact = test::run_event(one);
  EXPECT_GE(exact.impacts.size(), 4u);
  for (const char* column : {"rotor_x", "rotor_y", "stator_x", "stator_y"}) {
    EXPECT_NEAR(end_of(t, column), end_of(exact, column), 1e-12) << column;
    EXPECT_NEAR(end_of(t, (std::string("contact2_") + column).c_str()), end_of(exact, column),
                1e-12)
        << column;
  }
}

// The rates of all gaps count from the first touch of any contact, also where the first contact
// never touches: a free shaft strikes its second ring at u = 0.1 m/s, with 1/m = 1/2 + 0.5^2/8
// there and 1/m' = 1/2 - 0.5/8 across to the first. It then moves at -e u there, and at
// u (1 - (1 + e) m/m') in the first.
TEST(SeveralContacts, TheRatesOfAllGapsCountFromTheFirstTouchOfAny) {
  scene::Scene s = test::shaft_in_two_rings(2.0, 8.0, -0.5, {.friction = 0.0, .restitution = 0.5});
  for (auto* list : {&s.rotor.modal->stiffness, &s.rotor.modal->damping}) *list = {0.0, 0.0};
  s.rotor.speed = 0.0;
  s.initial.x = {0.0, 0.0};
  s.initial.vx = {0.1, 0.0};
  s.auxiliary[0].contact->clearance = 1e-2;
  s.auxiliary[1].contact->clearance = 1e-3;
  s.run.end = 0.025;
  const double mass = 1.0 / (0.5 + 0.25 / 8.0), rate = 0.1 * (1.0 - 1.5 * mass * (0.5 - 0.5 / 8.0));
  const double exact = (rate * rate + 0.05 * 0.05) * 0.015;
  for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    const Trajectory t = test::run_with(s, integrator, 1e-6);
    ASSERT_EQ(counted(t, 0), 0);
    ASSERT_EQ(counted(t, 1), 1);
    EXPECT_NEAR(t.statistics.gap_rate_square, exact, 1e-3 * exact)
        << (integrator == scene::Integrator::kEvent ? "event" : "verlet");
  }
}

}  // namespace
}  // namespace rotorub
