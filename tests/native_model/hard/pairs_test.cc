// Every pair of a machine's parts, by every fixed-step scheme against `event`: the error must fall
// with the step at the scheme's order. Terms that each work alone and go wrong together (unbalance,
// gyroscopics and a free spin, say) show as an order lost.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "native_model/stepping/ensemble.h"
#include "native_model/dynamics/dynamics.h"
#include "tests/native_model/hard/rules.h"
#include "tests/support/order.h"
#include "tests/support/pairs.h"

namespace rotorub {
namespace {

using scene::Integrator;
using test::Convergence;
using test::Form;
using test::Pair;

// Over two decades, 50 us to 0.5 us, close together where impacts fall at random within their
// steps. 1 ms, where the rows and the samples are, is a whole number of each.
constexpr int kStepsInAMillisecond[] = {20,  25,  30,  40,  60,   90,   135,
                                        200, 300, 450, 680, 1000, 1400, 2000};
constexpr double kPaperOrder = 0.8;   // 1, less the scatter of impacts within their steps
constexpr double kVerletOrder = 1.7;  // 2, likewise
// m: `event` and 30,000 steps of round-off come to 1e-14; what is judged stands well above, and is
// five errors at least.
constexpr double kFloor = 1e-13;
constexpr std::size_t kErrors = 5;

std::vector<double> steps() {
  std::vector<double> out;
  for (const int n : kStepsInAMillisecond) out.push_back(1e-3 / n);
  return out;
}

// ---------------------------------------------------------------- what is refused
// A part, or a pair, that a scheme refuses, with the words that its message must hold. Empty: none is.
struct Refusal {
  Integrator integrator;
  const char* part;
  const char* with;  // null: with anything
  const char* message;
};
constexpr const char* kTakesTime = "an impact that takes time needs the integrator event";
// A sample of a controller that falls into an impact: loads and command are held over it.
constexpr const char* kSampled = "under a controller with a sample_time, needs the integrator event";
constexpr std::array<Refusal, 2> kRefused{
    {{Integrator::kPaper, "finite_impacts", nullptr, kTakesTime},
     {Integrator::kVerlet, "finite_impacts", "sampled_support", kSampled}}};

// Where `verlet` was measured short of that; the bound is set from what was measured.
struct Kink {
  const char *one, *other;
  double order;
};
constexpr std::array<Kink, 1> kKinks{{
    // Errors scatter by a factor of 30 between neighbouring steps: 1.66.
    {"anisotropic_rotor", "switched_load", 1.5},
}};

double least_order(Integrator integrator, const std::vector<test::Part>& parts, double least) {
  const auto has = [&](const std::string& name) {
    return std::any_of(parts.begin(), parts.end(), [&](const auto& p) { return p.name == name; });
  };
  for (const Kink& k : kKinks) {
    if (integrator == Integrator::kVerlet && has(k.one) && has(k.other)) return k.order;
  }
  return least;
}

const char* refused(Integrator integrator, const std::vector<test::Part>& parts) {
  for (const Refusal& r : kRefused) {
    const auto has = [&](const std::string& name) {
      return std::any_of(parts.begin(), parts.end(), [&](const auto& p) { return p.name == name; });
    };
    if (r.integrator == integrator && has(r.part) && (!r.with || has(r.with))) return r.message;
  }
  return nullptr;
}

// ---------------------------------------------------------------- runs
Trajectory run_fixed(const scene::Scene& scene, Integrator integrator, double step) {
  NativeOptions options;
  options.integrator = integrator;
  options.step = step;
  return run_native(scene, options);
}

Trajectory reference(const scene::Scene& scene) {
  Trajectory t = test::run_event(scene);
  EXPECT_EQ(t.status, Status::kOk) << scene.name << ": " << t.message;
  EXPECT_FALSE(t.impacts.empty()) << scene.name << ": nothing happens";
  return t;
}

constexpr double kArm = 0.02;  // m, of the spin's error where there is no contact

Convergence converge(const scene::Scene& scene, Integrator integrator, const Trajectory& exact) {
  Convergence c;
  for (const double step : steps()) {
    const Trajectory t = run_fixed(scene, integrator, step);
    EXPECT_EQ(t.status, Status::kOk) << scene.name << " at " << step << ": " << t.message;
    if (t.status != Status::kOk || t.rows() != exact.rows()) continue;
    c.steps.push_back(step);
    c.errors.push_back(
        test::trajectory_error(t, exact, scene.contact ? scene.contact->radius : kArm));
  }
  return c;
}

// A line for each scene; the whole table is shown where one falls short.
struct Table {
  std::string text;
  bool short_of_order = false;

  void judge(const std::string& name, const Convergence& c, double least) {
    const Convergence judged = c.above(kFloor);
    const bool good = judged.steps.size() >= kErrors && judged.order() >= least;
    short_of_order = short_of_order || !good;
    char head[96];
    std::snprintf(head, sizeof head, "%s %-46s", good ? "     " : "SHORT", name.c_str());
    text += head + c.text() + '\n';
  }
};

void expect_order(const std::vector<Pair>& pairs, Integrator integrator, double least) {
  Table table;
  for (const Pair& pair : pairs) {
    const scene::Scene scene = pair.scene();
    if (const char* message = refused(integrator, pair.parts)) {
      try {
        run_fixed(scene, integrator, steps().back());
        ADD_FAILURE() << scene.name << " is listed as refused";
      } catch (const scene::SceneError& error) {
        EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
      }
      continue;
    }
    table.judge(scene.name, converge(scene, integrator, reference(scene)),
                least_order(integrator, pair.parts, least));
  }
  EXPECT_FALSE(table.short_of_order) << "least order " << least << '\n' << table.text;
}

class LongPairs : public ::testing::TestWithParam<std::string> {};

TEST_P(LongPairs, PaperIsOfFirstOrder) {
  expect_order(test::pairs_from(GetParam()), Integrator::kPaper, kPaperOrder);
}

TEST_P(LongPairs, VerletIsOfSecondOrder) {
  expect_order(test::pairs_from(GetParam()), Integrator::kVerlet, kVerletOrder);
}

// The ensemble is `paper` or `verlet` run by run, whatever the parts: what converges there converges
// here.
TEST_P(LongPairs, EnsembleIsRunByRun) {
  constexpr double kRounding = 1e-15;  // m: rows are interpolated, also at the end of a step
  for (const Pair& pair : test::pairs_from(GetParam())) {
    const scene::Scene scene = pair.scene();
    const Model model = make_model(scene);
    for (const Integrator integrator : {Integrator::kPaper, Integrator::kVerlet}) {
      if (refused(integrator, pair.parts)) {
        EXPECT_THROW(Ensemble({model}, 1e-5, integrator), std::invalid_argument) << scene.name;
        continue;
      }
      for (const int n : {30, 450}) {
        const auto count = static_cast<std::int64_t>(std::llround(scene.run.end * 1e3 * n));
        const EnsembleRun run = Ensemble({model}, 1e-3 / n, integrator).run(count).front();
        const Trajectory alone = run_fixed(scene, integrator, 1e-3 / n);
        ASSERT_EQ(run.status, alone.status) << scene.name;
        const Eigen::Vector2d end{alone.column("rotor_x").back(), alone.column("rotor_y").back()};
        EXPECT_LT((rotor_point(model, run.q.data()) - end).norm(), kRounding) << scene.name;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(From, LongPairs, ::testing::ValuesIn(test::part_names()),
                         [](const auto& part) { return part.param; });

// ---------------------------------------------------------------- three parts
// Mass and gyroscopics are both off the diagonal here: the velocity must be turned with the coupled
// mass. The reference shaft, one disc of 20 mm eccentricity at a quarter, the spin free.
constexpr const char* kUnbalancedGyroscope = R"(
[run]
end = 0.010
step = 1e-5
output_step = 1e-3
[rotor]
speed = 314.0
length = 0.60
E = 2.1e11
nu = 0.3
rho = 7850.0
modes = 2
damping_ratio = 0.01
[[rotor.section]]
from = 0.0
to = 0.60
diameter = 0.018
[[rotor.disc]]
z = 0.15
mass = 2.0
Jt = 1.8e-3
Jp = 3.6e-3
eccentricity = 20e-3
[[rotor.bearing]]
z = 0.03
stiffness = 2e7
[[rotor.bearing]]
z = 0.57
stiffness = 2e7
[drive]
kind = "free"
inertia = 2e-3
)";

void expect_both_orders(const scene::Scene& scene) {
  const Trajectory exact = test::run_event(scene);
  ASSERT_EQ(exact.status, Status::kOk) << exact.message;
  Table paper, verlet;
  paper.judge("paper", converge(scene, Integrator::kPaper, exact), kPaperOrder);
  verlet.judge("verlet", converge(scene, Integrator::kVerlet, exact), kVerletOrder);
  EXPECT_FALSE(paper.short_of_order) << paper.text;
  EXPECT_FALSE(verlet.short_of_order) << verlet.text;
}

TEST(LongTriple, GyroscopicsUnbalanceAndFreeSpin) {
  expect_both_orders(scene::parse_scene(kUnbalancedGyroscope, "triple.toml"));
}

TEST(LongTriple, GyroscopicsUnbalanceAndFreeSpinInTheRing) {
  scene::Scene scene = scene::parse_scene(kUnbalancedGyroscope, "triple.toml");
  scene.contact = scene::Contact{};
  scene.contact->station = 0.24;
  scene.contact->radius = 0.02;
  scene.contact->clearance = 2e-3;
  scene.contact->friction = 0.2;
  scene.contact->restitution = 0.4;
  scene.stator = scene::Stator{{1.5, 1.5}, {300.0, 300.0}, {2e5, 2e5}};
  expect_both_orders(scene);
}

// Where spin and bending share a mass matrix that turns, with every other part; slow enough for an
// eccentricity that couples them tightly.
std::vector<Pair> coupled(const std::string& drive) {
  test::Part unbalance, driven;
  std::vector<Pair> out;
  for (const test::Part& part : test::pair_parts()) {
    if (part.name == "unbalance") unbalance = part;
    if (part.name == drive) driven = part;
  }
  unbalance.name = "coupled";
  unbalance.geometry = {"rotor.disc[0].eccentricity=4e-3", "rotor.disc[0].phase=0.7",
                        "rotor.speed=150.0"};
  for (const test::Part& part : test::pair_parts()) {
    if (part.group == "drive" || part.name == "unbalance" || part.geometry.empty()) continue;
    out.push_back({Form::kGeometry, {unbalance, driven, part}});
  }
  return out;
}

TEST(LongTriple, UnbalanceOnAFreeSpinByPaper) {
  expect_order(coupled("free_spin"), Integrator::kPaper, kPaperOrder);
}
TEST(LongTriple, UnbalanceOnAFreeSpinByVerlet) {
  expect_order(coupled("free_spin"), Integrator::kVerlet, kVerletOrder);
}
TEST(LongTriple, UnbalanceOnAMotorByPaper) {
  expect_order(coupled("kloss_drive"), Integrator::kPaper, kPaperOrder);
}
TEST(LongTriple, UnbalanceOnAMotorByVerlet) {
  expect_order(coupled("kloss_drive"), Integrator::kVerlet, kVerletOrder);
}

// ---------------------------------------------------------------- what a contact can do
class LongFeature : public ::testing::TestWithParam<std::string> {
 protected:
  static test::ContactFeature feature() {
    for (const test::ContactFeature& f : test::contact_features()) {
      if (f.name == GetParam()) return f;
    }
    return {};
  }
  // Alone, and with the parts that reach into a contact.
  static std::vector<scene::Scene> scenes() {
    std::vector<scene::Scene> out;
    out.push_back(test::scene_of(Form::kModal, {}, feature().overrides));
    for (const test::Part& part : test::pair_parts()) {
      for (const char* name : {"gyroscopics", "torsion", "free_spin", "anisotropic_rotor",
                               "anisotropic_ring", "continuous_support", "gravity"}) {
        if (part.name != name) continue;
        out.push_back(test::scene_of(Form::kModal, {part}, feature().overrides));
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

TEST_P(LongFeature, PaperIsOfFirstOrder) { expect_order(Integrator::kPaper, kPaperOrder); }
TEST_P(LongFeature, VerletIsOfSecondOrder) {
  // The force jumps within the step of a reversal, and of the first sticking, which is found to the
  // share of a step.
  const bool jumps = std::string(GetParam()) == "reversal" || std::string(GetParam()) == "sticking";
  expect_order(Integrator::kVerlet, jumps ? 1.5 : kVerletOrder);
}

std::vector<std::string> feature_names() {
  std::vector<std::string> names;
  for (const test::ContactFeature& f : test::contact_features()) names.push_back(f.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Of, LongFeature, ::testing::ValuesIn(feature_names()),
                         [](const auto& feature) { return feature.param; });

}  // namespace
}  // namespace rotorub
