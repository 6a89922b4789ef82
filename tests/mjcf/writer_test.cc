#include "mjcf/writer.h"
#include "native_model/prepare/prepare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <regex>
#include <sstream>
#include <utility>

#include "mjcf/bodies.h"
#include "mjcf/names.h"
#include "native_model/model/dynamics.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/rules.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/said.h"

namespace rotorub::test {
namespace {

namespace names = mjcf_names;

// A link of the chain weighs 1e-12 kg and 1e-12 kg m^2 (mjcf/bodies.cc).
constexpr double kLink = 1e-12;

class Writer : public MujocoTest {};
class ShippedScene : public MujocoTest, public ::testing::WithParamInterface<std::string> {};
// The shipped scenes whose rotor has the native model's own coordinates in MuJoCo, and not
// segments.
class ShippedChain : public ShippedScene {};
std::vector<std::string> shipped_chains() {
  std::vector<std::string> names = shipped_names();
  std::erase_if(names, [](const std::string& name) {
    return shipped(name).mujoco.rotor == scene::MujocoRotor::kSegments;
  });
  return names;
}

TEST_P(ShippedScene, CommittedFileIsTheWritersOwn) {
  const std::filesystem::path file =
      std::filesystem::path(ROTORUB_MJCF_DIR) / (GetParam() + ".xml");
  std::ifstream in(file, std::ios::binary);
  ASSERT_TRUE(in) << file << " is missing: rotorub mjcf mjcf/" << GetParam() << ".toml";
  std::stringstream committed;
  committed << in.rdbuf();
  EXPECT_EQ(committed.str(), mjcf(shipped(GetParam()), MujocoVersion{2, 2, 2}))
      << "write it anew: rotorub mjcf mjcf/" << GetParam() << ".toml";
}

TEST_P(ShippedChain, HasTheNativeModelsMassesStiffnessesAndStart) {
  const scene::Scene scene = shipped(GetParam());
  const Model model = prepare(scene);
  const ModelPointer m = load(mjcf(scene));
  ASSERT_EQ(m->nv, model.nq());
  ASSERT_EQ(m->nq, model.nq());
  const DataPointer d = start(m.get());
  mj_forward(m.get(), d.get());
  const std::vector<int> order = joint_order(model);
  std::vector<double> full(static_cast<std::size_t>(m->nv * m->nv));
  mj_fullM(m.get(), full.data(), d->qM);
  for (int j = 0; j < m->nv; ++j) {
    const int i = order[static_cast<std::size_t>(j)];
    // A coordinate carries the links beyond it, the disc's point among them, and round-off.
    EXPECT_NEAR(full[static_cast<std::size_t>(j * m->nv + j)], model.mass[i],
                kLink * (m->nv + 2) + 1e-15 * model.mass[i]);
    EXPECT_DOUBLE_EQ(m->jnt_stiffness[j], model.stiffness[i]);
    EXPECT_DOUBLE_EQ(m->dof_damping[j], model.damping[i]);
    EXPECT_EQ(d->qpos[j], model.q0[i]);
    EXPECT_EQ(d->qvel[j], model.v0[i]);
  }
}

// `shadow` adds sensors, ghosts that do not collide and memory, but nothing that moves.
TEST_P(ShippedChain, ShadowAddsSensorsAndGhosts) {
  const ModelPointer without = load(mjcf(shipped(GetParam())));
  if (shipped(GetParam()).is_compliant()) {  // the shadow's contact is rigid
    EXPECT_THROW(mjcf(shipped(GetParam(), {"mujoco.shadow=true"})), scene::SceneError);
    return;
  }
  const ModelPointer with = load(mjcf(shipped(GetParam(), {"mujoco.shadow=true"})));
  const bool ring = prepare(shipped(GetParam())).layout.stator > 0;
  for (const char* name : {names::kRotorPosition, names::kShadowRotor, names::kShadowGap,
                           names::kShadowNormalForce, names::kShadowFrictionForce}) {
    EXPECT_GE(mj_name2id(with.get(), mjOBJ_SENSOR, name), 0) << name;
    EXPECT_LT(mj_name2id(without.get(), mjOBJ_SENSOR, name), 0) << name;
  }
  EXPECT_EQ(mj_name2id(with.get(), mjOBJ_SENSOR, names::kShadowStator) >= 0, ring);
  EXPECT_EQ(with->nmocap, ring ? 2 : 1);
  EXPECT_EQ(with->nv, without->nv);
  EXPECT_GT(with->nuserdata, without->nuserdata);
  const int ghost = mj_name2id(with.get(), mjOBJ_GEOM, names::kGhostRotor);
  ASSERT_GE(ghost, 0);
  EXPECT_EQ(with->geom_contype[ghost] | with->geom_conaffinity[ghost], 0);
  EXPECT_EQ(with->body_mass[with->geom_bodyid[ghost]], 0.0);
}

TEST_P(ShippedScene, CarriesItsWholeText) {
  const scene::Scene scene = shipped(GetParam());
  const ModelPointer m = load(mjcf(scene));
  const int id = mj_name2id(m.get(), mjOBJ_TEXT, names::kSceneText);
  ASSERT_GE(id, 0);
  EXPECT_EQ(std::string(m->text_data + m->text_adr[id]), scene.text);
}

// Without the plugin MuJoCo must find no contact of its own, however deep the disc is in the ring.
TEST_P(ShippedScene, DoesNotCollideWithoutThePlugin) {
  const ModelPointer m = load(mjcf(shipped(GetParam())));
  const DataPointer d = start(m.get());
  for (const double x : {0.0, 1e-3, 0.02, 0.1, 1.0}) {
    d->qpos[0] = x;
    mj_forward(m.get(), d.get());
    EXPECT_EQ(d->ncon, 0) << x;
    EXPECT_EQ(sensor(m.get(), d.get(), names::kActive), 0.0);
  }
}

TEST_P(ShippedScene, NamesCamerasKeysAndSensors) {
  const ModelPointer m = load(mjcf(shipped(GetParam())));
  for (const char* camera : {names::kContactCamera, names::kObliqueCamera, names::kSideCamera}) {
    EXPECT_GE(mj_name2id(m.get(), mjOBJ_CAMERA, camera), 0) << camera;
  }
  for (const char* key : {names::kStartKey, names::kTestKey}) {
    EXPECT_GE(mj_name2id(m.get(), mjOBJ_KEY, key), 0) << key;
  }
  for (const char* user : {names::kActive, names::kGap, names::kGapRate, names::kSlip,
                           names::kNormalForce, names::kFrictionForce}) {
    EXPECT_GE(mj_name2id(m.get(), mjOBJ_SENSOR, user), 0) << user;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScene, ::testing::ValuesIn(shipped_names()),
                         [](const auto& scene) { return scene.param; });
INSTANTIATE_TEST_SUITE_P(All, ShippedChain, ::testing::ValuesIn(shipped_chains()),
                         [](const auto& scene) { return scene.param; });

constexpr const char* kBare = R"(
[run]
end = 0.1
[rotor]
speed = 0.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [40.0]
)";

TEST_F(Writer, AbsentPartsAreAbsent) {
  const ModelPointer m = load(mjcf(parsed(kBare)));
  EXPECT_EQ(m->nv, 2);
  EXPECT_EQ(m->nu, 0);
  EXPECT_EQ(m->npair, 0);
  EXPECT_EQ(m->nsensor, 1);  // rotorub_active
  EXPECT_LT(mj_name2id(m.get(), mjOBJ_BODY, names::kRing), 0);
}

// A contact at mid-span is a node of the second mode: that mode must not move the disc.
constexpr const char* kNode = R"(
[run]
end = 0.1
[rotor]
speed = "50 Hz"
length = 0.6
E = "210 GPa"
nu = 0.3
rho = 7850.0
modes = 3
[[rotor.section]]
from = 0.0
to = 0.6
diameter = "18 mm"
[[rotor.bearing]]
z = 0.0
stiffness = 1e8
[[rotor.bearing]]
z = 0.6
stiffness = 1e8
[contact]
station = 0.3
radius = "20 mm"
clearance = "0.5 mm"
friction = 0.1
restitution = 0.5
)";

TEST_F(Writer, ModeWithANodeAtTheContactHangsOnABranch) {
  const scene::Scene scene = parsed(kNode);
  const Model model = prepare(scene);
  ASSERT_EQ(model.first().shape.x[1], 0.0);
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  std::vector<double> q(static_cast<std::size_t>(model.nq()));
  for (std::size_t i = 0; i < q.size(); ++i) q[i] = 1e-4 * static_cast<double>(i + 1);
  const std::vector<int> order = joint_order(model);
  for (int j = 0; j < m->nq; ++j) {
    d->qpos[j] = q[static_cast<std::size_t>(order[static_cast<std::size_t>(j)])];
  }
  mj_forward(m.get(), d.get());
  const mjtNum* disc = d->geom_xpos + 3 * mj_name2id(m.get(), mjOBJ_GEOM, names::kRotorContact);
  const Eigen::Vector2d expected = rotor_point(model, q.data());
  EXPECT_DOUBLE_EQ(disc[0], expected.x());
  EXPECT_DOUBLE_EQ(disc[1], expected.y());
}

TEST_F(Writer, ActuatorsPullOnTheFortyFiveDegreeAxes) {
  const ModelPointer m = load(mjcf(shipped("paper_sliding")));
  ASSERT_EQ(m->nu, 2);
  const DataPointer d = start(m.get());
  const int ring = m->jnt_dofadr[mj_name2id(m.get(), mjOBJ_JOINT, names::kRingX)];
  for (int k = 0; k < 2; ++k) {
    d->ctrl[0] = k == 0 ? 100.0 : 0.0;
    d->ctrl[1] = k == 1 ? 100.0 : 0.0;
    mj_forward(m.get(), d.get());
    EXPECT_NEAR(d->qfrc_actuator[ring], (k == 0 ? 100.0 : -100.0) / std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(d->qfrc_actuator[ring + 1], 100.0 / std::sqrt(2.0), 1e-12);
    EXPECT_EQ(m->actuator_ctrlrange[2 * k + 1], 600.0);
  }
}

// A rotor with a speed at the start: a cone is as stiff at each contact as the speed there asks,
// wherever the contact stands in the list. The modes are scaled to 1 at the first one.
TEST_F(Writer, AConesStiffnessIsOfTheSpeedAtItsOwnContact) {
  scene::Scene scene = scene::read_scene(std::string(ROTORUB_SOURCE_DIR) +
                                         "/tests/compare/engine/two_catchers.toml");
  scene.mujoco.contact = scene::ContactModel::kCone;
  scene.run.step = 1e-6;  // stiff enough that the speed decides
  scene.initial.vx = {0.12, 0.0, 0.0, 0.0};
  scene::Scene other = scene;
  std::swap(other.auxiliary[0], other.auxiliary[1]);
  other.initial.vx[0] *= prepare(scene).auxiliary[1].shape.x[0];
  // MuJoCo sorts its pairs; here they stand by their stiffness.
  const auto stiffness = [](const scene::Scene& s) {
    const ModelPointer m = load(mjcf(s));
    EXPECT_EQ(m->npair, 2);
    return std::minmax({-m->pair_solref[0], -m->pair_solref[mjNREF]});
  };
  const auto [least, most] = stiffness(scene);
  const auto [other_least, other_most] = stiffness(other);
  EXPECT_GT(most, 1.5 * least);
  EXPECT_NEAR(other_least / least, 1.0, 1e-6);
  EXPECT_NEAR(other_most / most, 1.0, 1e-6);
}

// The line that refuses `scene`.
std::string refusal(const scene::Scene& scene) {
  return message_of<scene::SceneError>([&] { mjcf(scene); });
}

TEST_F(Writer, TakesTheSolverOfTheScene) {
  for (const auto& [word, solver] :
       {std::pair{"newton", mjSOL_NEWTON}, {"cg", mjSOL_CG}, {"pgs", mjSOL_PGS}}) {
    const ModelPointer m =
        load(mjcf(shipped("bench_ring", {std::string("mujoco.solver=") + word})));
    EXPECT_EQ(m->opt.solver, solver) << word;
  }
}

TEST_F(Writer, RefusesWhatIsNotOffered) {
  scene::Scene scene = shipped("bench_ring");
  scene.mujoco.rotor = scene::MujocoRotor::kSegments;
  EXPECT_NE(refusal(scene).find("mujoco.rotor: "), std::string::npos);
  scene = shipped("bench_ring");
  scene.mujoco.integrator = scene::MujocoIntegrator::kRk4;
  EXPECT_NE(refusal(scene).find("mujoco.integrator: "), std::string::npos);
}

// Sizes that overflow: MuJoCo would read another number than was written, or none.
TEST_F(Writer, RefusesNumbersThatAreNotFinite) {
  scene::Scene scene = shipped("bench_ring");
  scene.first().contact->clearance = 1e308;
  scene.first().contact->radius = 1e308;
  EXPECT_NE(refusal(scene).find("too large for MuJoCo"), std::string::npos) << refusal(scene);
  scene = shipped("bench_ring");
  scene.rotor.modal->stiffness[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(scene).find("stiffness=\"nan\""), std::string::npos) << refusal(scene);
}

// ---------------------------------------------------------------- hard scenes
// Words are equal and numbers agree to 1e-13, since mathematical functions differ between
// processors.
bool same_but_for_round_off(const std::string& a, const std::string& b) {
  const std::regex number(R"(-?\d+(\.\d+)?(e[-+]?\d+)?)");
  if (std::regex_replace(a, number, "#") != std::regex_replace(b, number, "#")) return false;
  std::sregex_iterator one(a.begin(), a.end(), number), other(b.begin(), b.end(), number);
  for (; one != std::sregex_iterator(); ++one, ++other) {
    const double x = std::stod(one->str()), y = std::stod(other->str());
    if (std::abs(x - y) > 1e-13 * std::abs(x)) return false;
  }
  return true;
}

// The hard scenes: each has its committed .xml, or the writer refuses it.

TEST(HardScenes, CommittedFilesAreTheWritersOwn) {
  int written = 0, refused = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(ROTORUB_MJCF_DIR) / "hard")) {
    if (entry.path().extension() != ".toml") continue;
    SCOPED_TRACE(entry.path());
    std::filesystem::path xml = entry.path();
    xml.replace_extension(".xml");
    std::string text;
    try {
      const scene::Scene scene = scene::read_scene(entry.path());
      EXPECT_FALSE(scene::read_rules(scene).empty()) << "a hard case has a rule";
      text = mjcf(scene);
    } catch (const scene::SceneError&) {
      EXPECT_FALSE(std::filesystem::exists(xml));
      ++refused;
      continue;
    }
    std::ifstream in(xml, std::ios::binary);
    std::stringstream committed;
    committed << in.rdbuf();
    EXPECT_TRUE(same_but_for_round_off(committed.str(), text)) << "write it anew: rotorub mjcf\n"
                                                               << text;
    ++written;
  }
  EXPECT_GE(written, 25);
  EXPECT_EQ(refused, 1) << "indefinite_mass";
}

}  // namespace
}  // namespace rotorub::test
