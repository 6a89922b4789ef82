#include "compare/report/modes_page.h"

#include <gtest/gtest.h>

#include "compare/base/units.h"
#include "native_model/rotor/campbell.h"
#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

using nlohmann::json;

scene::Scene shipped(const std::string& name) {
  return scene::read_scene(std::string(ROTORUB_MJCF_DIR) + "/" + name + ".toml");
}

// What the model says at the scene's speed, and no shape without a shaft.
TEST(RotorSection, IsOfTheScenesSpeed) {
  const scene::Scene s = shipped("paper_passive");
  const RotorSection section = rotor_section(s);
  ASSERT_EQ(section.values.at("has_campbell"), true);
  EXPECT_EQ(section.values.at("has_shapes"), true);
  const WhirlSpectrum spectrum = whirl_spectrum(whirl_system(s), s.rotor.speed);
  const json& operating = section.data.at("campbell").at("operating");
  ASSERT_EQ(operating.size(), spectrum.modes.size());
  for (std::size_t k = 0; k < operating.size(); ++k) {
    EXPECT_NEAR(
        operating[k].at("frequency").get<double>() / (kHz * std::abs(spectrum.modes[k].frequency)),
        1.0, 1e-6);
    EXPECT_EQ(operating[k].at("sense"), spectrum.modes[k].frequency > 0.0 ? "forward" : "backward");
  }
  const json& shapes = section.data.at("shapes");
  EXPECT_FALSE(shapes.contains("modes")) << "those at rest are on the page of modes";
  ASSERT_EQ(shapes.at("whirl").size(), 8u);
  EXPECT_EQ(shapes["whirl"][0].at("shape").size(), shapes.at("z").size());
}

TEST(RotorSection, OfAModalFormHasADiagramAlone) {
  const RotorSection section = rotor_section(shipped("bench_ring"));
  EXPECT_EQ(section.values.at("has_campbell"), true);
  EXPECT_EQ(section.values.at("has_shapes"), false);
  EXPECT_TRUE(section.data.at("shapes").is_null());
  EXPECT_EQ(section.data.at("campbell").at("torsion"), json::array());
}

// A rotor without eigenvalues to show still has its page, with the reason.
TEST(RotorSection, SaysWhyThereIsNone) {
  scene::Scene s = shipped("bench_ring");
  s.rotor.modal->mass = {1e-300};
  s.rotor.modal->stiffness = {1e300};
  const RotorSection section = rotor_section(s);
  EXPECT_EQ(section.values.at("has_campbell"), false);
  EXPECT_TRUE(section.data.is_null());
  EXPECT_NE(section.values.at("refusal"), "");
}

}  // namespace
}  // namespace rotorub
