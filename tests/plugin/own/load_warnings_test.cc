// Warnings at load about sensors that nothing fills, and about friction that is not Coulomb's.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/plugin/own/machine.h"
#include "tests/plugin/own/two_rings.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

std::vector<std::string> heard;

class LoadWarnings : public HookedTest {
 protected:
  // The warnings from loading the model and from a few steps with it.
  static std::vector<std::string> of(const std::string& document) {
    const auto said_by_fixture = mju_user_warning;
    mju_user_warning = [](const char* text) { heard.emplace_back(text); };
    heard.clear();
    {
      const ModelPointer m = load(document);
      state_after(m.get(), 3);
      m->pair_friction[0] *= 1.01;  // an edit is no new model
      state_after(m.get(), 3);
    }
    mju_user_warning = said_by_fixture;
    return heard;
  }
  static std::string with_sensor(std::string text, const std::string& name) {
    const std::string end = "</sensor>";
    return text.replace(text.find(end), end.size(),
                        "<user name=\"" + name +
                            "\" objtype=\"geom\" objname=\"disc\" datatype=\"real\" "
                            "needstage=\"acc\" dim=\"1\"/>" +
                            end);
  }
};

TEST_F(LoadWarnings, NameTheSensorThatIsMeant) {
  const auto heard_of = [](const std::string& name) {
    return of(with_sensor(document(Machine{}), name));
  };
  EXPECT_EQ(heard_of("normal_forse_scaled"),
            (std::vector<std::string>{
                "rotorub: <user name=\"normal_forse_scaled\">: the plugin does not know this "
                "sensor, so it stays 0; did you mean \"normal_force_scaled\"?"}));
  EXPECT_TRUE(heard_of("gap_rate").empty());
  EXPECT_TRUE(heard_of("temperature").empty()) << "a sensor of the user's own callback";
}

TEST_F(LoadWarnings, KnowTheNamesOfEveryContact) {
  EXPECT_TRUE(of(document(TwoRings{})).empty());
  ASSERT_EQ(of(with_sensor(document(TwoRings{}), "gap_rats_2")).size(), 1u);
  EXPECT_NE(heard[0].find("\"gap_rate_2\""), std::string::npos) << heard[0];
}

// A sphere that slides on a plane in any direction.
TEST_F(LoadWarnings, NameTheEllipticCone) {
  const auto sliding = [](const std::string& option, int condim) {
    return "<mujoco><option timestep=\"0.001\" " + option + R"(/><size nuserdata="21"/>
<worldbody><geom name="floor" type="plane" size="100 100 1"/>
<body pos="0 0 0.1"><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>
<joint type="slide" axis="0 0 1"/><geom name="ball" type="sphere" size="0.1" mass="1"/></body>
</worldbody><contact><pair name="sliding" geom1="floor" geom2="ball" condim=")" +
           std::to_string(condim) + R"("/></contact>
<custom><text name="rotorub_cone_coulomb_pair" data="sliding"/></custom></mujoco>)";
  };
  const std::vector<std::string> pyramid = of(sliding("", 3));
  ASSERT_EQ(pyramid.size(), 1u);
  EXPECT_NE(pyramid[0].find("geom1=\"floor\" geom2=\"ball\""), std::string::npos) << pyramid[0];
  EXPECT_NE(pyramid[0].find("cone=\"elliptic\""), std::string::npos) << pyramid[0];
  EXPECT_TRUE(of(sliding("cone=\"elliptic\"", 3)).empty());
}

}  // namespace
}  // namespace rotorub::test
