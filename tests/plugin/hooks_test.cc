// Hooks into MuJoCo's callbacks, and how the plugin reads a model.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "plugin/hooks.h"
#include "plugin/model/config.h"
#include "plugin/model/user_data.h"
#include "tests/plugin/scenes.h"
#include "tests/support/mujoco_document.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/said.h"

namespace rotorub::test {
namespace {

using ConfigTest = HookedTest;

class HooksTest : public MujocoTest {};

int hook_calls = 0;
void count_control(const mjModel*, mjData*) { ++hook_calls; }
TEST_F(HooksTest, InstallsAndRestores) {
  const auto control = mjcb_control, passive = mjcb_passive;
  const auto sensor_before = mjcb_sensor;
  const auto collision = mjCOLLISIONFUNC[mjGEOM_SPHERE][mjGEOM_CAPSULE];
  {
    const plugin::Hooks outer;
    EXPECT_NE(mjcb_control, control);
    EXPECT_NE(mjCOLLISIONFUNC[mjGEOM_SPHERE][mjGEOM_CAPSULE], collision);
    const auto ours = mjcb_control;
    {
      const plugin::Hooks inner;
      EXPECT_EQ(mjcb_control, ours);
    }
    EXPECT_EQ(mjcb_control, ours) << "the last one restores";
    EXPECT_TRUE(plugin::hooks_installed());
  }
  EXPECT_FALSE(plugin::hooks_installed());
  EXPECT_EQ(mjcb_control, control);
  EXPECT_EQ(mjcb_passive, passive);
  EXPECT_EQ(mjcb_sensor, sensor_before);
  EXPECT_EQ(mjCOLLISIONFUNC[mjGEOM_SPHERE][mjGEOM_CAPSULE], collision);
}

// The callbacks are overwritten, taken back, and returned to their writer: none of ours stays, none
// of the user's is lost.
TEST_F(HooksTest, GivesBackToWhoWroteOverThem) {
  const ModelPointer m = load(mjcf(parsed(kAnnularRub)));
  const mjfGeneric writes[] = {count_control, nullptr};
  for (const mjfGeneric write : writes) {
    std::vector<double> plain;
    {
      const plugin::Hooks hooks;
      plain = state_after(m.get(), 300);
      mjcb_control = write;
      hook_calls = 0;
      EXPECT_EQ(state_after(m.get(), 300), plain);
      EXPECT_EQ(hook_calls, write ? 300 : 0);
      EXPECT_NE(mjcb_control, write) << "ours is back, and hook_calls it";
    }
    EXPECT_EQ(mjcb_control, write);
    EXPECT_NE(state_after(m.get(), 300), plain) << "ours is gone";
    mjcb_control = nullptr;
  }
}

// A double pendulum over a floor, with an actuator and MuJoCo's own contacts.
constexpr const char* kForeign = R"(<mujoco>
  <option timestep="0.002"/><size nuserdata="21"/>
  <custom><text name="note" data="another's text"/></custom>
  <worldbody><geom type="plane" size="5 5 1"/>
    <body pos="0 0 0.6"><joint name="a" type="hinge" axis="0 1 0" damping="0.01"/>
      <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.05"/>
      <body pos="0.3 0 0"><joint name="b" type="hinge" axis="0 1 0"/>
        <geom type="sphere" size="0.08" pos="0.3 0 0"/>
        <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.04"/></body></body>
    <body pos="0.4 0 1.5"><freejoint/><geom type="sphere" size="0.1"/></body>
  </worldbody>
  <actuator><motor joint="a" gear="0.5"/></actuator>
</mujoco>)";

TEST_F(HooksTest, ForeignModelRunsBitForBitAsWithout) {
  const ModelPointer m = load(kForeign);
  const std::vector<double> without = state_after(m.get(), 2000);
  const plugin::Hooks hooks;
  EXPECT_EQ(state_after(m.get(), 2000), without);
}

TEST_F(HooksTest, RotorThatNeverTouchesRunsBitForBitAsWithout) {
  // (With `rigid` the native step replaces MuJoCo's, in contact or not.)
  const ModelPointer m = load(mjcf(parsed(kNeverTouches, {"mujoco.contact=coulomb"})));
  const std::vector<double> without = state_after(m.get(), 10000);
  EXPECT_NE(without[0], 1e-3) << "it must have moved";
  const plugin::Hooks hooks;
  EXPECT_EQ(state_after(m.get(), 10000), without);
}

// A new model and its mjData may have the addresses of deleted ones.
TEST_F(HooksTest, AModelAtTheAddressOfAForeignOneIsKnown) {
  const plugin::Hooks hooks;
  const ModelPointer foreign = load(kForeign), own = load(mjcf(parsed(kAnnularRub)));
  const DataPointer of_foreign = start(foreign.get()), of_own = start(own.get());
  mjModel model = *foreign;
  mjData data = *of_foreign;
  mj_forward(&model, &data);
  model = *own;
  data = *of_own;
  mj_forward(&model, &data);
  EXPECT_EQ(sensor(&model, &data, mjcf_names::kActive), 1.0);
}

// ---------------------------------------------------------------- models

TEST_F(ConfigTest, BadSceneTextIsRefusedAtLoadWithElementLineAndKey) {
  const std::string document = mjcf(shipped("bench_ring"));
  EXPECT_TRUE(contains(load_refusal(replaced(document, "clearance = ", "clearanse = ")),
                       {"rotorub_scene", "contact.clearanse"}));
  expect_refused(replaced(document, "[rotor]&#10;", "[rotor&#10;"), "rotorub_scene");
}

TEST_F(ConfigTest, MissingElementsAreNamed) {
  const std::string document = mjcf(shipped("bench_ring"));
  expect_refused(replaced(document, "name=\"spin\"", "name=\"turn\""), "<joint name=\"spin\">");
  const std::size_t begin = document.find("nuserdata=");
  const std::string size = document.substr(begin, document.find('"', begin + 11) + 1 - begin);
  expect_refused(replaced(document, size, "nuserdata=\"3\""), "nuserdata");
  const std::string contact = "name=\"rotorub_contact\" data=\"";
  EXPECT_TRUE(contains(load_refusal(replaced(document, contact + "rigid", contact + "sticky")),
                       {"rotorub_contact", "rigid, coulomb, cone"}));
  const std::string gap =
      "<user name=\"gap\" objtype=\"body\" objname=\"rotor\" datatype=\"real\" "
      "needstage=\"pos\" dim=\"";
  expect_refused(replaced(document, gap + "1", gap + "3"), "<user name=\"gap\">");
}

// Only the contact model is edited, not the <pair> that was written for it.
TEST_F(ConfigTest, AContactModelThatThePairIsNotForIsRefused) {
  const auto edited = [](const std::string& from, const std::string& to) {
    const std::string name = "name=\"rotorub_contact\" data=\"";
    return replaced(mjcf(shipped("bench_ring", {"mujoco.contact=" + from})), name + from + "\"",
                    name + to + "\"");
  };
  expect_refused(edited("rigid", "coulomb"), "gap=\"0\"");
  expect_refused(edited("rigid", "cone"), "gap=\"0\"");
  expect_refused(edited("coulomb", "rigid"), "gap is too small");
  expect_refused(edited("coulomb", "cone"), "condim=\"3\"");
  expect_refused(edited("cone", "rigid"), "gap is too small");
  expect_refused(edited("cone", "coulomb"), "condim=\"1\"");
}

// Sensors are for viewers: a user may remove them, or move the joints.
TEST_F(ConfigTest, OptionalElementsMayGo) {
  std::string document = mjcf(shipped("bench_ring"));
  const std::size_t begin = document.find("<sensor>"), end = document.find("</sensor>") + 9;
  document.erase(begin, end - begin);
  const ModelPointer m = load(document);
  EXPECT_EQ(m->nsensor, 0);
  EXPECT_EQ(state_after(m.get(), 1000), state_after(load(mjcf(shipped("bench_ring"))).get(), 1000));
}

// malloc gives the address of a freed model to the next of the same size.
TEST_F(ConfigTest, ReusedAddressIsNotTheOldModel) {
  const std::string first = mjcf(shipped("bench_ring", {"force[0].amplitude=150.0"}));
  const std::string second = mjcf(shipped("bench_ring", {"force[0].amplitude=250.0"}));
  ModelPointer m = load(second);
  const std::vector<double> wanted = state_after(m.get(), 500);
  const mjModel* address = m.get();
  int reused = 0;
  for (int i = 0; i < 200 && reused < 10; ++i) {
    m.reset();
    m = load(first);
    state_after(m.get(), 500);
    const mjModel* old = m.get();
    m.reset();
    m = load(second);
    if (m.get() == old || m.get() == address) ++reused;
    EXPECT_EQ(state_after(m.get(), 500), wanted);
  }
#ifndef __SANITIZE_ADDRESS__  // which keeps freed memory apart
  EXPECT_GT(reused, 0) << "the case did not arise";
#endif
}

TEST_F(ConfigTest, ModelChangedInPlaceIsNoticed) {
  const ModelPointer m = load(mjcf(shipped("bench_ring", {"force[0].amplitude=150.0"})));
  const ModelPointer other = load(mjcf(shipped("bench_ring", {"force[0].amplitude=250.0"})));
  const DataPointer d = start(m.get());
  mj_step(m.get(), d.get());
  ASSERT_EQ(mj_copyModel(m.get(), other.get()), m.get());
  mj_resetDataKeyframe(m.get(), d.get(), 0);
  for (int k = 0; k < 500; ++k) mj_step(m.get(), d.get());
  EXPECT_EQ(state_of(m.get(), d.get()), state_after(other.get(), 500));
}

// Vectorised randomisation: every model is read once, however many are stepped in turns.
TEST_F(ConfigTest, ModelsInTurnsAreReadOnce) {
  constexpr int kModels = 150;
  const ModelPointer first = load(mjcf(shipped("bench_ring")));
  std::vector<ModelPointer> models;
  std::vector<DataPointer> data;
  for (int i = 0; i < kModels; ++i) {
    models.emplace_back(mj_copyModel(nullptr, first.get()));
    models.back()->dof_damping[0] *= 1.0 + 1e-3 * i;
    data.push_back(start(models.back().get()));
  }
  std::vector<double> marks;
  for (int round = 0; round < 3; ++round) {
    std::vector<double> now;
    for (std::size_t i = 0; i < models.size(); ++i) {
      mj_step(models[i].get(), data[i].get());
      now.push_back(plugin::entries<plugin::ModelEntries>(data[i].get(), 0).config_id);
    }
    if (round > 0) {
      EXPECT_EQ(now, marks);
    }
    marks = now;
  }
  EXPECT_EQ(std::set<double>(marks.begin(), marks.end()).size(), models.size());
}

// A model without our names becomes ours when its names are edited.
TEST_F(ConfigTest, NamesChangedInPlaceAreNoticed) {
  const ModelPointer ours = load(mjcf(shipped("bench_ring")));
  const std::vector<double> wanted = state_after(ours.get(), 500);
  const ModelPointer m(mj_copyModel(nullptr, ours.get()));
  std::vector<char*> marks;
  for (int i = 0; i < m->ntext; ++i) marks.push_back(m->names + m->name_textadr[i]);
  for (char* name : marks) *name = 'x';
  const std::vector<double> foreign = state_after(m.get(), 500);
  EXPECT_NE(foreign, wanted);
  for (char* name : marks) *name = 'r';
  EXPECT_EQ(state_after(m.get(), 500), wanted);
  for (char* name : marks) *name = 'x';
  EXPECT_EQ(state_after(m.get(), 500), foreign);
}

}  // namespace
}  // namespace rotorub::test
