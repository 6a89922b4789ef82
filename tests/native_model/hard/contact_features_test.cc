// What a contact can do (rebound, stick, lift off, reverse), by the fixed-step schemes against
// `event`.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/native_model/hard/contact_features.h"
#include "tests/native_model/hard/orders.h"

namespace rotorub::test {
namespace {

class LongFeature : public ::testing::TestWithParam<std::string> {
 protected:
  static ContactFeature feature() {
    for (const ContactFeature& f : contact_features()) {
      if (f.name == GetParam()) return f;
    }
    return {};
  }
  // Alone, and with the parts that reach into a contact.
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

TEST_P(LongFeature, MidpointIsOfFirstOrder) { expect_order(Integrator::kMidpoint, kMidpointOrder); }
TEST_P(LongFeature, VerletIsOfSecondOrder) {
  // The force jumps within the step of a reversal, and of the first sticking, which is found to the
  // share of a step.
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
