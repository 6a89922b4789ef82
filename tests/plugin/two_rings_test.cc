// Several contacts on MuJoCo's modal chain, against a second program
// (tests/native_model/event/two_rings) and against the native event by event.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "native_model/model/dynamics.h"
#include "native_model/prepare/prepare.h"
#include "plugin/contact/contact_memory.h"
#include "plugin/contact/verlet.h"
#include "plugin/make_config.h"
#include "plugin/model/generated_rotor.h"
#include "plugin/model/mujoco_versions.h"
#include "tests/support/mujoco_document.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/native_run.h"
#include "tests/support/two_rings.h"

namespace rotorub::test {
namespace {

namespace names = mjcf_names;

scene::Scene two_rings(const std::string& name, const std::string& contact, double step,
                       const std::string& more = {}) {
  const std::vector<std::string> overrides{"mujoco.contact=\"" + contact + "\"",
                                           "run.step=" + std::to_string(1e6 * step) + "e-6"};
  const scene::Scene scene = scene::read_scene(two_rings_file(name + ".toml"), overrides);
  return more.empty() ? scene : scene::parse_scene(scene.text + more, name);
}

// Modal coordinates at the requested times, and of each ring the impulses to the end, N s.
struct Outcome {
  std::vector<Eigen::VectorXd> rows;
  std::array<double, 2> normal{}, friction{};
};

Outcome in_mujoco(const scene::Scene& scene) {
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  const plugin::Config config = plugin::make_config(m.get());
  const double h = scene.run.step;
  const auto step_at = [h](double time) { return std::llround(time / h); };
  Outcome run;
  for (long long k = 0; k <= step_at(scene.run.end); ++k) {
    if (run.rows.size() < scene.run.output_times.size() &&
        k == step_at(scene.run.output_times[run.rows.size()])) {
      const plugin::Coordinates state(config, d.get());
      run.rows.emplace_back(Eigen::Map<const Eigen::VectorXd>(state.q(), config.model.nq()));
    }
    mj_step(m.get(), d.get());
    EXPECT_EQ(sensor(m.get(), d.get(), names::kActive), 1.0);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto sensed = [&](const char* name) {
        return sensor(m.get(), d.get(), names::of_bearing(i, name).c_str());
      };
      run.normal[i] += h * sensed(names::kNormalForce);
      run.friction[i] += h * sensed(names::kFrictionForce);
    }
  }
  return run;
}

// The largest of a position at the rows, over the clearance of the first ring; of the impulses of a
// ring, over its normal impulse.
struct Errors {
  double place = 0.0, impulse = 0.0;
};

Errors errors(const std::string& name, const std::string& contact, double step) {
  const scene::Scene scene = two_rings(name, contact, step);
  const nlohmann::json exact = two_rings_answer(name);
  const Outcome run = in_mujoco(scene);
  Errors e;
  EXPECT_EQ(run.rows.size(), exact.at("rows").size());
  for (std::size_t k = 0; k < run.rows.size(); ++k) {
    const nlohmann::json& due = exact.at("rows")[k].at("state");
    const Layout l = prepare(scene).layout;
    for (int mode = 0; mode < l.modes; ++mode) {
      const std::string number = std::to_string(mode + 1);
      const double x = due.at("x_" + number), y = due.at("y_" + number);
      const double off = std::hypot(run.rows[k][l.x() + mode] - x, run.rows[k][l.y() + mode] - y);
      e.place = std::max(e.place, off / scene.first().contact->clearance);
    }
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const nlohmann::json& due = exact.at("contacts");
    const double normal = due.at("normal_impulse")[i], friction = due.at("friction_impulse")[i];
    e.impulse = std::max({e.impulse, std::abs(run.normal[i] - normal) / normal,
                          std::abs(run.friction[i] - friction) / normal});
  }
  return e;
}

class TwoRingsInMujoco : public HookedTest, public testing::WithParamInterface<const char*> {};
class TwoRingsInMujocoLong : public TwoRingsInMujoco {};

TEST_P(TwoRingsInMujoco, RigidAgreesToTheOrderOfTheStep) {
  const Errors coarse = errors(GetParam(), "rigid", 5e-5), fine = errors(GetParam(), "rigid", 5e-6);
  std::printf("%s: place %.1e, %.1e; impulses %.1e, %.1e\n", GetParam(), coarse.place, fine.place,
              coarse.impulse, fine.impulse);
  EXPECT_LT(fine.place, 5e-3);
  EXPECT_LT(fine.place, 0.3 * coarse.place);
  EXPECT_LT(coarse.impulse, 5e-3);
  EXPECT_LT(fine.impulse, 5e-4);
}

// MuJoCo's softness for the impacts, as stiff as the step allows.
TEST_P(TwoRingsInMujocoLong, CoulombAgreesAsASoftContactDoes) {
  const Errors e = errors(GetParam(), "coulomb", 2e-6);
  std::printf("%s: place %.1e; impulses %.1e\n", GetParam(), e.place, e.impulse);
  EXPECT_LT(e.place, 0.05);
  EXPECT_LT(e.impulse, 5e-3);
}

constexpr auto kCases = {"drop", "rub", "moving", "rolling", "conical", "cylindrical"};
std::string case_name(const testing::TestParamInfo<const char*>& of) { return of.param; }
INSTANTIATE_TEST_SUITE_P(, TwoRingsInMujoco, testing::ValuesIn(kCases), case_name);
INSTANTIATE_TEST_SUITE_P(, TwoRingsInMujocoLong, testing::ValuesIn(kCases), case_name);

using SeveralOnTheChain = HookedTest;

// Only the force of the other contact may hold one closed.
TEST_F(SeveralOnTheChain, OnePressesTheOther) {
  for (const char* contact : {"rigid", "coulomb"}) {
    const std::vector<std::string> overrides{std::string("mujoco.contact=\"") + contact + "\""};
    const ModelPointer m = load(mjcf(lever_in_two_rings(overrides)));
    const DataPointer d = start(m.get());
    const auto force = [&](std::size_t i) {
      return sensor(m.get(), d.get(), names::of_bearing(i, names::kNormalForce).c_str());
    };
    while (d->time < 0.02) {
      mj_step(m.get(), d.get());
      if (d->time < 0.018) continue;
      ASSERT_NEAR(force(0), 30.0, 0.03) << contact << " " << d->time;
      ASSERT_NEAR(force(1), 10.0, 0.03) << contact << " " << d->time;
    }
  }
}

// A spin that unbalance couples with the bending: the native model's mass matrix, not MuJoCo's.
TEST_F(SeveralOnTheChain, KnowTheUnbalanceOfAFreeSpin) {
  const std::string unbalance =
      "\n[[force]]\nkind = \"unbalance\"\nstatic_moment = 0.004\nshape = [1.0, 0.2]\n";
  const Trajectory exact = run_event(two_rings("rolling", "rigid", 5e-6, unbalance));
  const Trajectory without = run_event(two_rings("rolling", "rigid", 5e-6));
  for (const char* contact : {"rigid", "coulomb"}) {
    const Outcome run = in_mujoco(two_rings("rolling", contact, 5e-6, unbalance));
    for (std::size_t i = 0; i < 2; ++i) {
      const double due = exact.statistics.contacts[i].friction_impulse;
      const double other = without.statistics.contacts[i].friction_impulse;
      std::printf("%s: friction %.6g, %.6g without unbalance, %.6g found\n", contact, due, other,
                  run.friction[i]);
      EXPECT_NEAR(run.friction[i], due, 0.02 * std::abs(due - other)) << contact << " " << i;
      EXPECT_NEAR(run.normal[i], exact.statistics.contacts[i].impulse_total,
                  1e-3 * exact.statistics.contacts[i].impulse_total)
          << contact << " " << i;
    }
  }
}

// The plugin puts the geoms of the second contact where the modes move the rotor, a step late.
TEST_F(SeveralOnTheChain, HaveTheirGeomsWhereTheModesAre) {
  const ModelPointer m = load(mjcf(two_rings("conical", "rigid", 1e-5)));
  const DataPointer d = start(m.get());
  const plugin::Config config = plugin::make_config(m.get());
  const int geom =
      mj_name2id(m.get(), mjOBJ_GEOM, names::of_bearing(1, names::kRotorContact).c_str());
  Eigen::Vector2d before(0.0, 0.0);
  for (int k = 0; k < 2000; ++k) {
    const plugin::Coordinates state(config, d.get());
    const Eigen::Vector2d now = rotor_point(config.model, state.q(), 1);
    mj_step(m.get(), d.get());
    if (k > 0) {
      EXPECT_EQ(d->geom_xpos[3 * geom], before.x());
      EXPECT_EQ(d->geom_xpos[3 * geom + 1], before.y());
    }
    before = now;
  }
  EXPECT_GT(before.norm(), 1e-4);
}

// A gap of 0 would let MuJoCo's solver act on the ring of the second contact as well. Files for a
// MuJoCo before 3.9 have this effect since then.
TEST_F(SeveralOnTheChain, AreKeptFromMujocosSolverWithoutAGap) {
  const std::string document = mjcf(two_rings("moving", "coulomb", 1e-5));
  const ModelPointer plain = load(document), edited = load(document);
  const int pair = plugin::make_config(edited.get()).pairs[1].pair;
  edited->pair_margin[pair] = plugin::detected_below(edited.get(), pair);
  edited->pair_gap[pair] = 0.0;
  const DataPointer d = start(plain.get()), other = start(edited.get());
  const std::string force = names::of_bearing(1, names::kNormalForce);
  double largest = 0.0;
  while (d->time < 0.02) {
    mj_step(plain.get(), d.get());
    mj_step(edited.get(), other.get());
    largest = std::max(largest, sensor(plain.get(), d.get(), force.c_str()));
    ASSERT_EQ(state_of(edited.get(), other.get()), state_of(plain.get(), d.get())) << d->time;
  }
  EXPECT_GT(largest, 0.0);
}

// The scene of one mode in two rings at one place, so that their order has no effect.
scene::Scene in_rings(const char* first, const char* second) {
  std::string text = R"([run]
end = 0.01
step = 1e-5
[rotor]
speed = 100.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [40.0]
[initial]
vx = [1e-4]
)";
  for (const char* clearance : {first, second}) {
    text +=
        std::string("[[contact]]\nradius = 0.05\nfriction = 0.1\nrestitution = 0.5\nclearance = ") +
        clearance + "\n";
  }
  return parsed(text);
}

// A written state differs from the expected one by more than a millionth of the smallest clearance.
TEST_F(SeveralOnTheChain, NoticeAWrittenStateInAnyOrder) {
  for (const auto& [first, second] :
       {std::pair{"\"10 mm\"", "\"10 um\""}, std::pair{"\"10 um\"", "\"10 mm\""}}) {
    const ModelPointer m = load(mjcf(in_rings(first, second)));
    const DataPointer d = start(m.get());
    const plugin::Config config = plugin::make_config(m.get());
    for (int k = 0; k < 10; ++k) mj_step(m.get(), d.get());
    EXPECT_FALSE(plugin::begins_anew(config, m.get(), d.get())) << first;
    d->qpos[config.qpos_address[0]] += 1e-9;
    EXPECT_TRUE(plugin::begins_anew(config, m.get(), d.get())) << first;
  }
}

// At 1e6 s the round-off of the time is larger than a millionth of the step.
TEST_F(SeveralOnTheChain, KnowTheNextStepAtLargeTimes) {
  const ModelPointer m = load(mjcf(in_rings("\"10 mm\"", "\"10 um\"")));
  const DataPointer d = start(m.get());
  const plugin::Config config = plugin::make_config(m.get());
  d->time = 1e6;
  for (int k = 0; k < 10; ++k) {
    mj_step(m.get(), d.get());
    if (k == 0) continue;
    EXPECT_FALSE(plugin::begins_anew(config, m.get(), d.get())) << k;
  }
}

// The force sensors need the normal and the axial friction of every contact of the pass
// (load_cells.h), whatever the place of the contact's entries in userdata.
TEST_F(SeveralOnTheChain, EachKeepsItsNotedResults) {
  for (int modes = 1; modes <= 16; ++modes) {
    std::string values;
    for (int i = 0; i < modes; ++i) values += i == 0 ? "[1.0" : ", 1.0";
    values += "]";
    const ModelPointer m =
        load(mjcf(parsed(in_rings("\"10 mm\"", "\"10 um\"").text,
                         {"rotor.modal.mass=" + values, "rotor.modal.stiffness=" + values,
                          "rotor.modal.damping=" + values, "initial.vx=" + values})));
    const DataPointer d = start(m.get()), other = start(m.get());
    const plugin::Config config = plugin::make_config(m.get());
    ASSERT_EQ(config.pairs.size(), 2u);
    const int first = config.pairs[0].userdata, second = config.pairs[1].userdata;
    plugin::note_contact(d.get(), first, {1.0, 0.0}, 10.0);
    plugin::note_contact(d.get(), second, {0.0, 1.0}, 20.0);
    plugin::note_contact(other.get(), first, {0.0, -1.0}, 30.0);
    EXPECT_EQ(plugin::noted_contact(d.get(), first)->axial, 10.0) << modes;
    EXPECT_EQ(plugin::noted_contact(d.get(), second)->axial, 20.0) << modes;
    EXPECT_EQ(plugin::noted_contact(other.get(), first)->axial, 30.0) << modes;
  }
}

// A contact that is noted again stays when a thread notes more contacts than it can keep.
TEST_F(SeveralOnTheChain, TheContactNotedLeastRecentlyIsForgotten) {
  const ModelPointer m = load(mjcf(in_rings("\"10 mm\"", "\"10 um\"")));
  std::vector<DataPointer> data;
  for (int i = 0; i < 50; ++i) data.push_back(start(m.get()));
  for (std::size_t i = 1; i < data.size(); ++i) {
    plugin::note_contact(data[0].get(), 0, {1.0, 0.0}, 10.0);
    plugin::note_contact(data[i].get(), 0, {1.0, 0.0}, 20.0);
    const plugin::NotedContact* again = plugin::noted_contact(data[0].get(), 0);
    ASSERT_NE(again, nullptr) << i;
    EXPECT_EQ(again->axial, 10.0) << i;
  }
  EXPECT_EQ(plugin::noted_contact(data[1].get(), 0), nullptr);
}

// The place of every ring is that of the scene.
TEST_F(SeveralOnTheChain, AreRefusedWithARingOutOfPlace) {
  const std::string document = mjcf(in_rings("\"10 mm\"", "\"10 um\""));
  const ModelPointer intact = load(document);  // it must not hide the fault
  const DataPointer d = start(intact.get());
  mj_forward(intact.get(), d.get());
  for (const std::string ring : {"<body name=\"ring", "<body name=\"ring_2"}) {
    expect_refused(replaced(document, ring + "\">", ring + "\" pos=\"1e-4 0 0\">"),
                   ring + "\">: pos");
  }
}

TEST_F(SeveralOnTheChain, AreRefusedWhereTheirRowsAreNotKnown) {
  const std::string document = mjcf(two_rings("conical", "rigid", 1e-5));
  load(document);
  const std::string contact = "name=\"rotorub_contact\" data=\"";
  expect_refused(replaced(document, contact + "rigid", contact + "cone"),
                 "mujoco.rotor = \"segments\"");
  expect_refused(replaced(document, "<joint name=\"x_1\"",
                          "<joint limited=\"true\" range=\"-1 1\" name=\"x_1\""),
                 "<joint name=\"x_1\" limited>");
  const auto welded = [&](const std::string& body) {
    const std::string free = "\"><geom size=\"0.01\" contype=\"0\"/></body>";
    return replaced(replaced(document, "<worldbody>",
                             "<worldbody><body name=\"a" + free + "<body name=\"b" + free),
                    "</mujoco>",
                    "<equality><weld body1=\"a\" body2=\"" + body + "\"/></equality></mujoco>");
  };
  load(welded("b"));
  expect_refused(welded("rotor"), "<equality name=\"\">");
  const std::string rotor = "<body name=\"rotor_2\"";
  expect_refused(replaced(document, rotor + " mocap=\"true\"", rotor), "mocap=\"true\"");
}

}  // namespace
}  // namespace rotorub::test
