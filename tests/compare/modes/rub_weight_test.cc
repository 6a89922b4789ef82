// The lasting rubs of a rotor with weight: what `modes` tells of them, and that a run is about it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "compare/modes/rotor_analysis.h"
#include "compare/modes/rub_analysis.h"
#include "compare/modes/rub_result.h"
#include "tests/native_model/hard/rules.h"

namespace rotorub {
namespace {

RubAnalysis analysed(const scene::Scene& scene) {
  const std::vector<RubAnalyses> all = analyse_rubs(scene, {scene.rotor.speed});
  EXPECT_EQ(all.front().refused, "");
  return all.front().at.front();
}

TEST(RubsUnderWeight, AreToldWithoutItAndSaySo) {
  const scene::Scene hangs = test::shipped("bench_annular_elastic", {"initial={steady=true}"});
  const scene::Scene lies = test::shipped(
      "bench_annular_elastic", {"initial={steady=true}", "gravity={acceleration=[0.0,-9.81]}"});
  const RubAnalysis with = analysed(lies), without = analysed(hangs);
  EXPECT_EQ(without.left_out, "");
  EXPECT_NE(with.left_out.find("the weight"), std::string::npos);
  EXPECT_NE(result::text_of(rub_result(with)).find("left out: the weight"), std::string::npos);
  EXPECT_EQ(result::json_of(rub_result(with)).at("rubs"),
            result::json_of(rub_result(without)).at("rubs"));
  EXPECT_TRUE(result::json_of(rub_result(without)).at("left_out").is_null());
}

TEST(RubsUnderWeight, AreNoneWhereNothingButTheRingHoldsTheRotor) {
  const std::string unheld = "rotor.modal.stiffness=[0.0]",
                    lies = "gravity={acceleration=[0.0,-9.81]}";
  const auto of = [](const std::vector<std::string>& changes) {
    const scene::Scene s = test::shipped("bench_annular_elastic", changes);
    return analyse_rubs(s, {s.rotor.speed}).front();
  };
  const RubAnalyses none = of({unheld, lies});
  EXPECT_TRUE(none.at.empty());
  EXPECT_NE(none.refused.find("gravity: no lasting rub can be analysed: only rings"),
            std::string::npos)
      << none.refused;
  EXPECT_EQ(of({unheld}).refused, "") << "upright it whirls in its ring";
}

// A ring that sags less than the rotor: the force beats, and over whole turns the mean force is
// that of the analysis.
TEST(RubsUnderWeight, ARunsMeanForceIsTheAnalyses) {
  scene::Scene lies = test::shipped("bench_annular_elastic",
                                    {"run.end=1.0", "run.output_step=1e-4", "stator.stiffness=3e5",
                                     "gravity={acceleration=[0.0,-9.81]}"});
  const rub::StandingRub* rub = analysed(lies).point.leading(rub::RubKind::kForced);
  ASSERT_TRUE(rub && rub->stability.stable);
  const double expected = rub->rub.normal_force;
  const Trajectory t = test::run_event(lies);
  ASSERT_EQ(t.status, Status::kOk) << t.message;
  const auto& force = t.column("normal_force");
  double sum = 0.0, least = 1e300, most = 0.0;
  const std::size_t from = t.rows() - 2001;  // 0.2 s: ten turns
  for (std::size_t k = from; k + 1 < t.rows(); ++k) {
    sum += force[k];
    least = std::min(least, force[k]);
    most = std::max(most, force[k]);
  }
  EXPECT_NEAR(sum / 2000.0, expected, 0.02 * expected);
  EXPECT_GT(most - least, 0.01 * expected) << "it beats";
}

}  // namespace
}  // namespace rotorub
