// Two contacts on MuJoCo's modal chain against a second program
// (tests/native_model/event/two_rings).

#include <gtest/gtest.h>

#include "compare/engine/mujoco_engine.h"
#include "tests/support/two_rings.h"

namespace rotorub {
namespace {

Trajectory in_mujoco(const scene::Scene& scene, scene::ContactModel contact, double step) {
  MujocoOptions options;
  options.contact = contact;
  options.step = step;
  return run_mujoco(scene, options);
}

// The largest error of a position, over the clearance of the first ring, and of a ring's impulse.
struct Errors {
  double place = 0.0, impulse = 0.0, friction = 0.0;
};
Errors errors(const std::string& name, scene::ContactModel contact, double step) {
  const scene::Scene scene = test::two_rings_scene(name);
  const nlohmann::json exact = test::two_rings_answer(name);
  const Trajectory t = in_mujoco(scene, contact, step);
  EXPECT_EQ(t.status, Status::kOk) << t.message;
  Errors e;
  for (const nlohmann::json& row : exact.at("rows")) {
    const std::size_t k = test::row_of(t, row.at("t"));
    for (const auto& [column, value] : row.at("state").items()) {
      const bool rate = column.find("_v") != std::string::npos || column.starts_with("v");
      if (rate || column.starts_with("spin")) continue;
      const double off = test::state_of(t, scene, column, k) - value.get<double>();
      e.place = std::max(e.place, std::abs(off) / scene.first().contact->clearance);
    }
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const double normal = exact.at("contacts").at("normal_impulse")[k];
    const double friction = exact.at("contacts").at("friction_impulse")[k];
    const ContactStatistics& found = t.statistics.contacts[k];
    e.impulse = std::max(e.impulse, std::abs(found.impulse_total - normal) / normal);
    e.friction = std::max(e.friction, std::abs(found.friction_impulse - friction) / normal);
  }
  return e;
}

class TwoRingsInMujoco : public testing::TestWithParam<const char*> {};

TEST_P(TwoRingsInMujoco, RigidAgreesToTheOrderOfTheStep) {
  const Errors coarse = errors(GetParam(), scene::ContactModel::kRigid, 2e-5);
  const Errors fine = errors(GetParam(), scene::ContactModel::kRigid, 2e-6);
  std::printf("%s place %g %g impulse %g %g friction %g %g\n", GetParam(), coarse.place, fine.place,
              coarse.impulse, fine.impulse, coarse.friction, fine.friction);
}

TEST_P(TwoRingsInMujoco, CoulombAgreesAsASoftContactDoes) {
  const Errors e = errors(GetParam(), scene::ContactModel::kCoulomb, 2e-6);
  std::printf("%s place %g impulse %g friction %g\n", GetParam(), e.place, e.impulse, e.friction);
}

INSTANTIATE_TEST_SUITE_P(, TwoRingsInMujoco,
                         testing::Values("drop", "rub", "moving", "rolling", "conical",
                                         "cylindrical"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace rotorub
