// mjModel determines the motion: an edited value acts as if the scene had it.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "plugin/model/user_data.h"
#include "tests/support/mujoco_document.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/said.h"

namespace rotorub::test {
namespace {

int joint(const mjModel* m, const char* name) { return mj_name2id(m, mjOBJ_JOINT, name); }
int dof_of(const mjModel* m, const char* name) { return m->jnt_dofadr[joint(m, name)]; }
int geom(const mjModel* m, const char* name) { return mj_name2id(m, mjOBJ_GEOM, name); }

constexpr int kRubSteps = 1600;  // 16 ms of bench_ring: impacts, accumulation, lasting rub

// The function that MuJoCo requires after an edit of masses.
void set_constants(mjModel* m) {
  const DataPointer d(mj_makeData(m));
  mj_setConst(m, d.get());
}

class ModelParameters : public HookedTest {
 protected:
  using Edit = std::function<void(mjModel*)>;
  static std::vector<double> edited(const std::vector<std::string>& overrides, const Edit& edit,
                                    int steps = kRubSteps) {
    const ModelPointer m = load(mjcf(shipped("bench_ring", overrides)));
    edit(m.get());
    set_constants(m.get());
    return state_after(m.get(), steps);
  }
  static std::vector<double> said(const std::vector<std::string>& overrides,
                                  int steps = kRubSteps) {
    return state_after(load(mjcf(shipped("bench_ring", overrides))).get(), steps);
  }
  // The error that MuJoCo reports when the edited model is stepped.
  static std::string refusal(const Edit& edit, const std::vector<std::string>& overrides = {}) {
    const ModelPointer m = load(mjcf(shipped("bench_ring", overrides)));
    const DataPointer d = start(m.get());
    for (int k = 0; k < 10; ++k) mj_step(m.get(), d.get());
    edit(m.get());
    set_constants(m.get());
    return message_of([&] { mj_step(m.get(), d.get()); });
  }
  static void expect_near(const std::vector<double>& a, const std::vector<double>& b,
                          double relative) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_NEAR(a[i], b[i], relative * (1e-3 + std::abs(b[i]))) << i;
    }
  }
};

void set_ring_mass(mjModel* m, double kg) {
  m->dof_armature[dof_of(m, "ring_x")] = m->dof_armature[dof_of(m, "ring_y")] = kg;
}

struct Case {
  const char* name;
  std::vector<std::string> scene;
  std::function<void(mjModel*)> edit;
};

std::vector<Case> cases() {
  return {
      {"ring mass", {"stator.mass=0.2"}, [](mjModel* m) { set_ring_mass(m, 0.2); }},
      {"rotor mass",
       {"rotor.modal.mass=[3.0]"},
       [](mjModel* m) {
         m->dof_armature[dof_of(m, "x_1")] = m->dof_armature[dof_of(m, "y_1")] = 3.0;
       }},
      {"inertia",
       {"rotor.modal.inertia=2e-3"},
       [](mjModel* m) { m->dof_armature[dof_of(m, "spin")] = 2e-3; }},
      {"stiffness",
       {"rotor.modal.stiffness=[1.5e5]"},
       [](mjModel* m) {
         m->jnt_stiffness[joint(m, "x_1")] = m->jnt_stiffness[joint(m, "y_1")] = 1.5e5;
       }},
      {"damping",
       {"rotor.modal.damping=[80.0]"},
       [](mjModel* m) {
         m->dof_damping[dof_of(m, "x_1")] = m->dof_damping[dof_of(m, "y_1")] = 80.0;
       }},
      {"one plane of the ring",
       {"stator.stiffness=[1e5, 2e5]"},
       [](mjModel* m) { m->jnt_stiffness[joint(m, "ring_y")] = 2e5; }},
      {"friction", {"contact.friction=0.05"}, [](mjModel* m) { m->pair_friction[0] = 0.05; }},
      {"gravity",
       {"gravity={acceleration=[0.0, -9.81]}"},
       [](mjModel* m) { m->opt.gravity[1] = -9.81; }},
      {"clearance",
       {"contact.clearance=4e-4"},
       [](mjModel* m) { m->geom_size[3 * geom(m, "ring")] = 0.05 + 4e-4; }},
  };
}

// To the bit if the numbers are the same; a clearance is the difference of two radii.
TEST_F(ModelParameters, AnEditedModelMovesAsTheSceneThatSaysSo) {
  for (const char* contact : {"rigid", "coulomb"}) {
    for (Case c : cases()) {
      SCOPED_TRACE(std::string(contact) + ", " + c.name);
      const std::string model = std::string("mujoco.contact=\"") + contact + "\"";
      c.scene.push_back(model);
      const auto wanted = said(c.scene);
      EXPECT_NE(said({model}), wanted) << "the case does not tell";
      expect_near(edited({model}, c.edit), wanted, 1e-6);
      if (std::string(c.name) != "clearance") {
        EXPECT_EQ(edited({model}, c.edit), wanted);
      }
    }
  }
}

TEST_F(ModelParameters, ARingThatTurnsHasTheInertiaAndDragOfItsJoint) {
  for (const char* contact : {"rigid", "coulomb"}) {
    SCOPED_TRACE(contact);
    const std::string model = std::string("mujoco.contact=\"") + contact + "\"";
    const std::string first = "stator.spin={inertia=2e-4,drag=1e-3,speed=30}";
    const auto wanted = said({model, "stator.spin={inertia=3e-4,drag=4e-3,speed=30}"});
    EXPECT_NE(said({model, first}), wanted);
    EXPECT_EQ(edited({model, first},
                     [](mjModel* m) {
                       m->dof_armature[dof_of(m, "ring_spin")] = 3e-4;
                       m->dof_damping[dof_of(m, "ring_spin")] = 4e-3;
                     }),
              wanted);
    // The radius is also R, the lever arm of friction on the ring.
    EXPECT_NE(said({model, first, "contact.radius=0.04"}), said({model, first}));
    expect_near(edited({model, first},
                       [](mjModel* m) {
                         m->geom_size[3 * geom(m, "rotor")] = 0.04;
                         m->geom_size[3 * geom(m, "ring")] = 0.04 + 0.5e-3;
                       }),
                said({model, first, "contact.radius=0.04"}), 1e-6);
  }
}

// Edited during the run, the rest is the run of a scene that starts from there, to the order of a
// step.
TEST_F(ModelParameters, AnEditInMidRunIsTakenAtOnce) {
  const ModelPointer m = load(mjcf(shipped("bench_ring")));
  const DataPointer d = start(m.get());
  for (int k = 0; k < 2000; ++k) mj_step(m.get(), d.get());
  const ModelPointer other = load(mjcf(shipped("bench_ring", {"contact.friction=0.05"})));
  const DataPointer e = start(other.get());
  e->time = d->time;
  mju_copy(e->qpos, d->qpos, m->nq);
  mju_copy(e->qvel, d->qvel, m->nv);
  m->pair_friction[0] = 0.05;
  for (int k = 0; k < 300; ++k) {
    mj_step(m.get(), d.get());
    mj_step(other.get(), e.get());
  }
  EXPECT_NEAR(first_contact(d.get()).friction_force, first_contact(e.get()).friction_force,
              0.02 * std::abs(first_contact(e.get()).friction_force));
  EXPECT_NEAR(d->qpos[0], e->qpos[0], 2e-3 * std::abs(e->qpos[0]));
}

TEST_F(ModelParameters, AnUneditedModelKeepsItsBits) {
  const auto touched = [](mjModel* m) {
    m->pair_friction[0] = 0.3;
    const DataPointer d = start(m);
    for (int k = 0; k < 100; ++k) mj_step(m, d.get());
    m->pair_friction[0] = 0.15;
  };
  EXPECT_EQ(edited({}, touched), said({}));
}

TEST_F(ModelParameters, NumbersThatNoRotorHasAreRefusedByName) {
  const auto expect = [](const char* part, const std::string& whole) {
    EXPECT_TRUE(contains(whole, part));
  };
  expect("ring_x", refusal([](mjModel* m) { m->dof_armature[dof_of(m, "ring_x")] = 0.0; }));
  expect("x_1", refusal([](mjModel* m) { m->jnt_stiffness[joint(m, "x_1")] = -1.0; }));
  expect("friction", refusal([](mjModel* m) { m->pair_friction[0] = -0.1; }));
  expect("depends on the slip",
         refusal([](mjModel* m) { m->pair_friction[0] = 0.1; },
                 {"contact.friction.kinetic=0.1", "contact.friction.stribeck_speed=1.0"}));
  expect("ring", refusal([](mjModel* m) { m->geom_size[3 * geom(m, "ring")] = 0.04; }));
  expect("<body name=\"rotor\">",
         refusal([](mjModel* m) { m->body_mass[mj_name2id(m, mjOBJ_BODY, "rotor")] = 0.3; }));
}

TEST_F(ModelParameters, WhatNoLongerCarriesTheModesIsRefusedAtLoad) {
  const std::string document = mjcf(shipped("paper_sliding", {"rotor.modes=2"}));
  const ModelPointer intact = load(document);  // it must not hide the fault
  const DataPointer d = start(intact.get());
  mj_forward(intact.get(), d.get());
  const auto expect = [&](const char* from, const char* to, const char* named) {
    expect_refused(replaced(document, from, to), named);
  };
  expect("name=\"x_1\" type=\"slide\" axis=\"1 0 0\"", "name=\"x_1\" type=\"slide\" axis=\"0 0 1\"",
         "<joint name=\"x_1\">: axis");
  expect("<body name=\"ring\">", "<body name=\"ring\" pos=\"1e-4 0 0\">",
         "<body name=\"ring\">: pos");
  expect("<body name=\"rotor\">", "<body name=\"rotor\" euler=\"0 0 90\">",
         "<body name=\"rotor\">: quat");
  expect("name=\"actuator_1\" tendon=\"axis_1\"",
         "name=\"actuator_1\" gear=\"2\" tendon=\"axis_1\"", "gear");
  expect("name=\"actuator_1\" tendon=\"axis_1\"", "name=\"actuator_1\" tendon=\"axis_2\"",
         "needs tendon=\"axis_1\"");
  expect("<joint joint=\"ring_x\" coef=\"-0.70", "<joint joint=\"ring_x\" coef=\"0.70",
         "<fixed name=\"axis_2\">");
  expect("mass=\"1e-12\"", "mass=\"0.3\"", "[[rotor.disc]]");
  expect("<geom name=\"rotor_mark\"",
         "<body><geom type=\"sphere\" size=\"0.01\" mass=\"0.3\"/></body>"
         "<geom name=\"rotor_mark\"",
         "[[rotor.disc]]");
}

// The edited model has the names and sizes of an intact one that is already known.
TEST_F(ModelParameters, AKnownModelDoesNotHideWhatIsRefused) {
  const std::string sliding = mjcf(shipped("paper_sliding"));
  const struct {
    std::string document, from, to, named;
  } edits[] = {
      {own_model_example(), "user=\"200\"", "user=\"0\"", "user[0]"},
      {sliding, "name=\"actuator_2\" tendon=\"axis_2\" ctrllimited=\"true\"",
       "name=\"actuator_2\" tendon=\"axis_2\" ctrllimited=\"false\"", "ctrlrange"},
      {sliding, "timestep=\"1e-05\"", "timestep=\"-1e-5\"", "must be > 0"},
  };
  for (const auto& edit : edits) {
    const ModelPointer intact = load(edit.document);
    const DataPointer d = start(intact.get());
    mj_forward(intact.get(), d.get());
    expect_refused(replaced(edit.document, edit.from, edit.to), edit.named);
  }
}

TEST_F(ModelParameters, TheSecondActuatorsLimitsAreRefusedDuringARunToo) {
  const ModelPointer m = load(mjcf(shipped("paper_sliding")));
  const DataPointer d = start(m.get());
  mj_step(m.get(), d.get());
  const int second = mj_name2id(m.get(), mjOBJ_ACTUATOR, mjcf_names::kActuator[1]);
  m->actuator_ctrlrange[2 * second] = -5.0;
  m->actuator_ctrlrange[2 * second + 1] = 5.0;
  EXPECT_TRUE(contains(message_of([&] { mj_step(m.get(), d.get()); }), "actuator_2"));
}

// A mass on the ring is added to the ring, in both planes.
TEST_F(ModelParameters, AMassOnTheRingIsTheRings) {
  std::string document = mjcf(shipped("bench_ring"));
  const std::size_t ring = document.find("<body name=\"ring\">");
  document.replace(document.find("mass=\"1e-12\"", ring), 12, "mass=\"0.5\"");
  expect_near(state_after(load(document).get(), kRubSteps), said({"stator.mass=1.5"}), 1e-9);
}

// A user's motor on a joint of ours acts as a load of the scene.
TEST_F(ModelParameters, OtherActuatorsAct) {
  std::string document = mjcf(shipped("bench_ring"));
  document.insert(document.find("<sensor>"),
                  "<actuator><motor name=\"push\" joint=\"x_1\" gear=\"2\"/></actuator>");
  const ModelPointer m = load(document);
  const DataPointer d = start(m.get());
  const ModelPointer free = load(mjcf(shipped("bench_ring")));
  const DataPointer e = start(free.get());
  for (int k = 0; k < kRubSteps; ++k) {
    d->ctrl[mj_name2id(m.get(), mjOBJ_ACTUATOR, "push")] = 10.0;
    mj_step(m.get(), d.get());
    e->qfrc_applied[0] = 20.0;
    mj_step(free.get(), e.get());
  }
  expect_near(state_of(m.get(), d.get()), state_of(free.get(), e.get()), 1e-9);
}

// Two models that differ only in a geom's size, in one process: 262.08 instead of 284.83 rad/s.
TEST_F(ModelParameters, TheRadiusOfAnOwnModelIsThatOfItsGeom) {
  const auto model = [](double radius) {
    return "<mujoco><option timestep='1e-5' gravity='0 0 0' collision='predefined'/>"
           "<size nuserdata='32'/><worldbody>"
           "<body><joint name='x' type='slide' axis='1 0 0'/><joint name='y' type='slide' "
           "axis='0 1 0'/><joint name='spin' type='hinge' axis='0 0 1'/>"
           "<geom name='disc' type='cylinder' size='" +
           std::to_string(radius) +
           " 0.01' mass='2' contype='0' conaffinity='0'/></body>"
           "<geom name='housing' type='cylinder' size='0.1 0.01' contype='0' conaffinity='0'/>"
           "</worldbody><contact><pair geom1='disc' geom2='housing' condim='1' margin='5e-6' "
           "gap='1'/></contact><custom><text name='rotorub_rotor_geom' data='disc'/>"
           "<text name='rotorub_ring_geom' data='housing'/>"
           "<numeric name='rotorub_clearance' data='5e-4'/>"
           "<numeric name='rotorub_friction' data='0.3'/></custom></mujoco>";
  };
  // The friction of one impact on a disc: -mu m v r / (m r^2 / 2) of spin.
  const auto spin_after = [](const mjModel* m) {
    const DataPointer d(mj_makeData(m));
    d->qvel[0] = 1.0;  // head on, at rest after it
    d->qvel[2] = 300.0;
    for (int k = 0; k < 100 && d->qvel[0] > 0.5; ++k) mj_step(m, d.get());
    return d->qvel[2];
  };
  const auto due = [](double r) { return 300.0 - 0.3 * 1.0 / (0.5 * r); };
  const ModelPointer small = load(model(0.03)), large = load(model(0.05));
  EXPECT_NEAR(spin_after(small.get()), due(0.03), 1e-6);
  EXPECT_NEAR(spin_after(large.get()), due(0.05), 1e-6);
  // A sweep in one mjModel; the inertia stays that of 0.05 m.
  large->geom_size[3 * geom(large.get(), "disc")] = 0.04;
  EXPECT_NEAR(spin_after(large.get()), 300.0 - 0.3 * 0.04 / (0.5 * 0.05 * 0.05), 1e-6);
}

}  // namespace
}  // namespace rotorub::test
