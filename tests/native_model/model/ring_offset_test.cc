// contact.offset: a machine and its ring moved by the same are the same machine.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "native_model/linear/rub_system.h"
#include "native_model/model/model.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "tests/support/native_run.h"
#include "tests/support/refusal.h"
#include "tests/support/thrown.h"

namespace rotorub {
namespace {

Trajectory thrown(scene::Integrator integrator, const std::vector<std::string>& overrides) {
  return test::run_with(scene::parse_scene(test::kThrown, "thrown.toml", overrides), integrator);
}

TEST(RingOffset, AMachineMovedIsTheSameMachine) {
  const std::vector<std::string> ring{"stator={mass=1.0,stiffness=1e5,damping=100.0}"};
  for (const std::vector<std::string>& with : {std::vector<std::string>{}, ring}) {
    for (const scene::Integrator integrator :
         {scene::Integrator::kEvent, scene::Integrator::kVerlet, scene::Integrator::kEuler}) {
      std::vector<std::string> there = with;
      there.insert(there.end(), {"contact.offset=[\"0.25 mm\",\"-0.125 mm\"]", "initial.x=[2.5e-4]",
                                 "initial.y=[-1.25e-4]"});
      std::vector<std::string> here = with;
      if (integrator == scene::Integrator::kEuler) {
        for (auto* all : {&here, &there}) all->push_back("contact.friction=0.0");
      }
      const Trajectory moved = thrown(integrator, there), plain = thrown(integrator, here);
      ASSERT_EQ(moved.status, Status::kOk) << moved.message;
      ASSERT_EQ(plain.status, Status::kOk) << plain.message;
      EXPECT_GE(plain.impacts.size(), 3u);
      ASSERT_EQ(moved.impacts.size(), plain.impacts.size());
      for (std::size_t k = 0; k < moved.rows(); ++k) {
        EXPECT_NEAR(moved.column("rotor_x")[k] - 2.5e-4, plain.column("rotor_x")[k], 1e-12);
        EXPECT_NEAR(moved.column("rotor_y")[k] + 1.25e-4, plain.column("rotor_y")[k], 1e-12);
        EXPECT_NEAR(moved.column("stator_x")[k] - 2.5e-4, plain.column("stator_x")[k], 1e-12);
        EXPECT_NEAR(moved.column("gap")[k], plain.column("gap")[k], 1e-12);
      }
    }
  }
}

TEST(RingOffset, AStartOutsideTheRingIsRefusedByIt) {
  const auto with = [](const std::string& offset) {
    const std::vector<std::string> overrides{"contact.offset=" + offset};
    return scene::parse_scene(test::kThrown, "thrown.toml", overrides);
  };
  EXPECT_EQ(test::refusal(with("[0.0,0.6e-3]")).key, "contact.offset");
  const scene::Scene inside = with("[0.0,0.1e-3]");
  EXPECT_THROW(rub::rub_system(inside), scene::SceneError);
}

}  // namespace
}  // namespace rotorub
