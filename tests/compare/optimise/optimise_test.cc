// Optima that are known in closed form.
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "compare/optimise/optimiser.h"
#include "compare/optimise/output.h"
#include "tests/compare/sweep/studies.h"
#include "tests/support/said.h"

namespace rotorub::optimise {
namespace {

using test::StudyFolder;

// One mass of 2 kg on 200 kN/m in a wide ring, driven by 150 N at 50 Hz.
const char* const kScene = R"(
[run]
end = 0.1
step = 1e-4
integrator = "verlet"
[rotor]
speed = "50 Hz"
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [40.0]
[contact]
radius = 0.05
clearance = "20 mm"
friction = 0.1
restitution = 0.5
[[force]]
kind = "rotating"
amplitude = 150.0
frequency = "50 Hz"
[[force]]
kind = "rotating"
amplitude = 0.0
frequency = "50 Hz"
)";

constexpr const char* kDamping = R"([[vary]]
key = "rotor.modal.damping[0]"
from = 1.0
to = 4000.0
)";

class Optimise : public testing::Test {
 protected:
  Optimise() { folder.write("one_mass.toml", kScene); }
  Task task(const std::string& text) {
    return read_task(folder.write("study.toml", "scene = \"one_mass.toml\"\n" + text));
  }
  std::string refusal(const std::string& text) {
    return test::message_of([&] { task(text); });
  }
  static Optimum found(const Task& task) {
    return optimise(task, scene::Variants(task.study.scene, task.study.overrides));
  }
  StudyFolder folder;
};

// The slowest decay of m x'' + d x' + k x = 0 is fastest at critical damping, d = 2 sqrt(k m),
// where it is -sqrt(k / m): a kink, which is steeper on the side of less damping.
TEST_F(Optimise, CriticalDampingDecaysFastest) {
  for (const char* algorithm : {"cobyla", "nelder_mead", "subplex", "direct"}) {
    const Task t = task(std::string(kDamping) +
                        "[optimise]\nminimise = \"modes.speeds.0.rub.free_growth_rate\"\n"
                        "tolerance = 1e-6\nalgorithm = \"" +
                        algorithm + "\"\n");
    const Optimum optimum = found(t);
    ASSERT_TRUE(optimum.best) << algorithm;
    const Evaluation& best = optimum.evaluations[*optimum.best];
    EXPECT_NEAR(best.values[0], 2.0 * std::sqrt(2e5 * 2.0), 0.5) << algorithm;
    EXPECT_NEAR(*best.figure, -std::sqrt(1e5), 0.5) << algorithm;
  }
}

// The orbit F / |k - m w^2 + i d w| grows as the damping falls, down to where the decay d / 2 m is
// still 10 1/s.
TEST_F(Optimise, AConstraintHoldsAtTheOptimum) {
  for (const char* algorithm : {"cobyla", "direct"}) {
    const Optimum optimum =
        found(task(std::string(kDamping) +
                   "start = 2000.0\n[optimise]\nmaximise = \"modes.speeds.0.response.orbit\"\n"
                   "tolerance = 1e-7\nevaluations = 400\nalgorithm = \"" +
                   algorithm +
                   "\"\n[[optimise.constraint]]\n"
                   "figure = \"modes.speeds.0.rub.free_growth_rate\"\nmax = -10.0\n"));
    ASSERT_TRUE(optimum.best) << algorithm;
    const Evaluation& best = optimum.evaluations[*optimum.best];
    EXPECT_NEAR(best.values[0], 40.0, 0.01) << algorithm;
    const double w = 100.0 * std::numbers::pi;
    EXPECT_NEAR(*best.figure, 150.0 / std::hypot(2e5 - 2.0 * w * w, 40.0 * w), 1e-6) << algorithm;
    EXPECT_LE(best.violation, Optimum::kFeasible);
  }
}

// Two loads of one frequency cancel where they are as large and opposite: the rotor then stays in
// the middle, and the gap is the clearance. A cone, with its tip there.
TEST_F(Optimise, ACorrectionCancelsTheLoadOfARun) {
  const Optimum optimum = found(task(R"([[vary]]
key = "force[1].amplitude"
from = 50.0
to = 300.0
[[vary]]
key = "force[1].phase"
from = "100 deg"
to = "300 deg"
[optimise]
maximise = "least_gap"
tolerance = 1e-6
evaluations = 400
)"));
  ASSERT_TRUE(optimum.best);
  const Evaluation& best = optimum.evaluations[*optimum.best];
  EXPECT_NEAR(best.values[0], 150.0, 0.05);
  EXPECT_NEAR(best.values[1], std::numbers::pi, 3e-4);
  EXPECT_NEAR(*best.figure, 20e-3, 2e-6);
}

// Where the ring is narrower than the start there is no scene: such points are left, and the search
// goes on beside them.
TEST_F(Optimise, GoesOnBesideWhatIsRefused) {
  const Task t = task(R"([[vary]]
key = "initial.x[0]"
from = -0.03
to = 0.03
start = 0.019
[run]
end = 0.01
[optimise]
maximise = "least_gap"
[[optimise.constraint]]
figure = "steps"
max = 1e6
)");
  const Optimum optimum = found(t);
  ASSERT_TRUE(optimum.best);
  bool refused = false;
  for (const Evaluation& e : optimum.evaluations) refused = refused || e.status == "refused";
  EXPECT_TRUE(refused);
  EXPECT_LT(std::abs(optimum.evaluations[*optimum.best].values[0]), 5e-3);
}

// The orbit shrinks all the way as the damping rises.
TEST_F(Optimise, SaysThatTheBestIsAtTheEndOfARange) {
  const Task t =
      task(std::string(kDamping) + "[optimise]\nminimise = \"modes.speeds.0.response.orbit\"\n");
  const Optimum optimum = found(t);
  ASSERT_TRUE(optimum.best);
  EXPECT_NEAR(optimum.evaluations[*optimum.best].values[0], 4000.0, 4.0);
  const std::string says = "at the upper end of the range of rotor.modal.damping[0]";
  EXPECT_EQ(edge_text(t, optimum), says + ": a wider range may hold better values");
  EXPECT_EQ(json_of(result_of("x", t, optimum)).at("best").at("edge"), edge_text(t, optimum));
  EXPECT_NE(text_of(result_of("x", t, optimum)).find("(an end of its range)"), std::string::npos);
  const Task middle = task(std::string(kDamping) +
                           "[optimise]\nminimise = \"modes.speeds.0.rub.free_growth_rate\"\n");
  EXPECT_EQ(edge_text(middle, found(middle)), "");
}

TEST_F(Optimise, SaysWhereNothingKeepsTheConstraints) {
  const Task t = task(std::string(kDamping) +
                      "[optimise]\nmaximise = \"least_gap\"\nevaluations = 15\n"
                      "[[optimise.constraint]]\nfigure = \"steps\"\nmax = 3\n");
  const Optimum optimum = found(t);
  EXPECT_FALSE(optimum.best);
  EXPECT_TRUE(json_of(result_of("x", t, optimum)).at("best").is_null());
  EXPECT_NE(text_of(result_of("x", t, optimum)).find("none of them"), std::string::npos);
}

TEST_F(Optimise, SaysWhatIsWrong) {
  const std::string goal = "[optimise]\nminimise = \"peak_force\"\n";
  const struct {
    std::string text, says;
  } cases[] = {
      {kDamping, "optimise: missing"},
      {std::string(kDamping) + "[optimise]\n", "exactly one of"},
      {std::string(kDamping) + goal + "maximise = \"impacts\"\n", "exactly one of"},
      {std::string(kDamping) + "[optimise]\nminimise = \"modes.\"\n", "rotorub modes --json"},
      {std::string(kDamping) + goal + "algorithm = \"bfgs\"\n", "choose from cobyla, bobyqa"},
      {std::string(kDamping) + goal + "tolerance = 2\n", "below 1"},
      {std::string(kDamping) + goal +
           "algorithm = \"bobyqa\"\n[[optimise.constraint]]\n"
           "figure = \"impacts\"\nmax = 3\n",
       "choose cobyla or direct"},
      {std::string(kDamping) + goal + "[[optimise.constraint]]\nfigure = \"impacts\"\n",
       "no limit"},
      {"[[vary]]\nkey = \"contact.friction\"\nvalues = [1, 2]\n" + goal, "needs a range"},
      {"[[vary]]\nkey = \"contact.friction\"\nfrom = 0.1\nto = 0.2\nstart = 0.3\n" + goal,
       "between `from` and `to`"},
      {"[[vary]]\nkey = \"contact.friction\"\nfrom = 0.1\nto = 0.2\n[optimise]\nminimise = "
       "\"mean_farce\"\n",
       "a run has no figure `mean_farce`, did you mean `mean_force`?"},
  };
  for (const auto& c : cases) {
    const std::string said = refusal(c.text);
    EXPECT_NE(said.find(c.says), std::string::npos) << c.says << "\n" << said;
  }
}

// A list's `*` is the worst of its numbers; one that is null is none.
TEST(FigurePath, TakesTheWorstOfAList) {
  const nlohmann::json all = {{"a", {{{"b", 1.0}}, {{"b", 3.0}}, {{"b", 2.0}}}}, {"c", nullptr}};
  EXPECT_EQ(figure_value(parse_figure("a.*.b"), all, true), 3.0);
  EXPECT_EQ(figure_value(parse_figure("a.*.b"), all, false), 1.0);
  EXPECT_EQ(figure_value(parse_figure("a.1.b"), all, false), 3.0);
  for (const char* none : {"a.3.b", "a.*.d", "c", "a", "a.x.b"})
    EXPECT_FALSE(figure_value(parse_figure(none), all, true)) << none;
}

}  // namespace
}  // namespace rotorub::optimise
