// Two auxiliary bearings in MuJoCo, a segment rotor and the modal chain, against the native model
// of the same scene.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "compare/engine/engine.h"
#include "compare/engine/lyapunov.h"
#include "compare/engine/mujoco_record.h"
#include "compare/figures/figure.h"
#include "compare/metrics/metrics.h"
#include "mjcf/writer.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/recorder.h"
#include "tests/support/jeffcott.h"
#include "tests/support/mujoco_run.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"
#include "tests/support/refusal.h"
#include "tests/support/two_catchers.h"

namespace rotorub::test {
namespace {

class SeveralInMujoco : public testing::TestWithParam<scene::ContactModel> {};

// The segments are another beam: its frequency differs by 0.02 %, and so do the impacts of the
// start. The lasting motion agrees.
TEST_P(SeveralInMujoco, PressOnEachRingAsTheNativeModelDoes) {
  const Trajectory native = test::run_event(test::segments_in_two_catchers());
  const Trajectory t = test::mujoco_run(test::segments_in_two_catchers(), GetParam(), 1e-5);
  ASSERT_EQ(t.contacts, 2u);
  ASSERT_EQ(t.statistics.contacts.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const ContactStatistics &found = t.statistics.contacts[k],
                            &exact = native.statistics.contacts[k];
    EXPECT_NEAR(found.first_touch, exact.first_touch, 5e-5) << k;
    EXPECT_NEAR(found.impulse_total, exact.impulse_total, 5e-3 * exact.impulse_total) << k;
    EXPECT_NEAR(found.friction_work, exact.friction_work, 5e-3 * std::abs(exact.friction_work))
        << k;
    EXPECT_NEAR(found.contact_time, exact.contact_time, 0.03 * exact.contact_time) << k;
  }
  EXPECT_NEAR(t.statistics.impulse_total,
              t.statistics.contacts[0].impulse_total + t.statistics.contacts[1].impulse_total,
              1e-12);
  // At the end both ends of the shaft rest on their rings and slide, and share the weight.
  for (const char* column : {"normal_force", "contact2_normal_force"}) {
    const double exact = native.column(column).back();
    EXPECT_NEAR(t.column(column).back(), exact, 0.02 * exact) << column;
  }
  EXPECT_EQ(t.column("contact2_mode").back(), static_cast<double>(ContactMode::kSlide));
}

INSTANTIATE_TEST_SUITE_P(, SeveralInMujoco,
                         testing::Values(scene::ContactModel::kRigid, scene::ContactModel::kCoulomb,
                                         scene::ContactModel::kConeCoulomb),
                         [](const auto& of) {
                           std::string name = scene::to_string(of.param);
                           std::erase(name, '-');
                           return name;
                         });

// Scatter, peak and lasting contact are those of all contacts: an end that chatters does not end
// the rub of the other.
TEST(SeveralContactsInMujoco, FiguresAreThoseOfAllContacts) {
  for (const auto contact : {scene::ContactModel::kRigid, scene::ContactModel::kCoulomb}) {
    scene::Scene scene = test::segments_in_two_catchers();
    scene.run.output_step = scene.run.step;  // a row each step
    const Trajectory t = test::mujoco_run(scene, contact, scene.run.step);
    const auto &first = t.column("normal_force"), &second = t.column("contact2_normal_force");
    const double h = scene.run.step, window = kWindowSteps * h;
    double square = 0.0, peak = 0.0, lasting = 0.0;
    std::vector<bool> lasts(first.size(), false);
    for (const auto* force : {&first, &second}) {
      for (std::size_t i = 0, from = 0; i <= force->size(); ++i) {
        if (i < force->size() && (*force)[i] > 0.0) continue;
        if (static_cast<double>(i - from) * h > window)
          std::fill(lasts.begin() + static_cast<std::ptrdiff_t>(from),
                    lasts.begin() + static_cast<std::ptrdiff_t>(i), true);
        from = i + 1;
      }
    }
    for (std::size_t i = 0; i < first.size(); ++i) {
      square += (first[i] + second[i]) * (first[i] + second[i]) * h;
      peak = std::max(peak, first[i] + second[i]);
      lasting += lasts[i] ? h : 0.0;
    }
    const Statistics& s = t.statistics;
    // Rows have no force at an impact.
    EXPECT_GE(s.peak_force, 0.999 * peak);
    EXPECT_GE(s.force_square, 0.99 * square);
    if (contact == scene::ContactModel::kRigid) continue;
    EXPECT_NEAR(s.peak_force, peak, 0.01 * peak);
    EXPECT_NEAR(s.force_square, square, 0.02 * square);
    EXPECT_NEAR(s.contact_time - s.impact_time, lasting, 0.02 * t.end);
    EXPECT_GT(lasting, 0.2 * t.end);
  }
}

// With `rigid` it is the native step, whatever the number of contacts.
TEST(SeveralContactsInMujoco, OnTheModalChainRigidStepsAsVerletDoes) {
  const scene::Scene scene = test::segments_in_two_catchers({"mujoco.rotor=modal", "run.end=0.03"});
  const Trajectory t = test::mujoco_run(scene, scene::ContactModel::kRigid, 4e-6);
  const Trajectory native = test::run_with(scene, scene::Integrator::kVerlet, 4e-6);
  EXPECT_LT(test::rotor_error(t, native), 1e-10);
  ASSERT_GT(native.impacts.size(), 5u);
  EXPECT_EQ(t.impacts.size(), native.impacts.size());
}

// In the other order they are the same machine; the plane of the first one is z = 0.
TEST(SeveralContactsInMujoco, HaveNoOrder) {
  scene::Scene scene = test::segments_in_two_catchers();
  const Trajectory t = test::mujoco_run(scene);
  const std::string& text = scene.text;
  const std::size_t first = text.find("[[contact]]"), second = text.find("[[contact]]", first + 1);
  const std::size_t end = text.find("[mujoco]");
  ASSERT_NE(end, std::string::npos);
  const std::string swapped = text.substr(0, first) + text.substr(second, end - second) +
                              text.substr(first, second - first) + text.substr(end);
  const Trajectory other = test::mujoco_run(scene::parse_scene(swapped, "swapped.toml"));
  EXPECT_NEAR(t.statistics.contacts[0].impulse_total, other.statistics.contacts[1].impulse_total,
              1e-3 * t.statistics.contacts[0].impulse_total);
  EXPECT_NEAR(t.column("contact2_gap").back(), other.column("gap").back(), 1e-9);
}

TEST(SeveralContactsInMujoco, NeedPassiveRingsAndSegmentsForACone) {
  const auto refusal = [](const std::vector<std::string>& overrides) {
    const auto refused = test::refusals([&] { mjcf(test::segments_in_two_catchers(overrides)); });
    return refused.empty() ? "taken" : to_string(refused.front());
  };
  EXPECT_EQ(refusal({}), "taken");
  EXPECT_EQ(refusal({"mujoco.rotor=modal"}), "taken");
  for (const char* cone : {"mujoco.contact=cone", "mujoco.contact=cone-coulomb"}) {
    const std::string said = refusal({"mujoco.rotor=modal", cone});
    EXPECT_NE(said.find("mujoco.contact"), std::string::npos) << said;
    EXPECT_NE(said.find("mujoco.rotor = \"segments\""), std::string::npos) << said;
  }
  EXPECT_NE(refusal({"mujoco.shadow=true"}).find("mujoco.shadow"), std::string::npos);
  EXPECT_NE(refusal({"contact[1].controller.kind=pd", "contact[1].controller.stiffness=1e4",
                     "contact[1].controller.damping=10"})
                .find("contact[1].controller"),
            std::string::npos);
}

// ---------------------------------------------------------------- their order
// Lengths that an engine takes from the clearances: they must not depend on the order of the
// contacts.

// A rotor of one mode in two rings at one place.
scene::Scene in_two_rings(const Jeffcott& in_the_first, double clearance, double radius) {
  scene::Scene s = make_scene(in_the_first);
  s.auxiliary.push_back(s.first());
  s.auxiliary[1].contact->clearance = clearance;
  s.auxiliary[1].contact->radius = radius;
  return s;
}

scene::Scene in_the_other_order(scene::Scene s) {
  std::swap(s.auxiliary[0], s.auxiliary[1]);
  return s;
}

TEST(ContactOrder, DoesNotMatterForTwins) {
  constexpr double kNarrow = 0.1e-3;  // m
  const scene::Scene scene = in_two_rings({.stiffness = 2e5, .clearance = 0.5e-3}, kNarrow, 0.05);
  const double moved = perturbed(scene, 3).initial.x.front();
  EXPECT_EQ(moved, perturbed(in_the_other_order(scene), 3).initial.x.front());
  EXPECT_EQ(moved, 3.0 * (std::nextafter(kNarrow, 1.0) - kNarrow));
}

// A start off the other one by a tenth of the wide clearance would lie outside the narrow ring.
TEST(ContactOrder, DoesNotMatterForAnExponent) {
  const scene::Scene scene =
      in_two_rings({.mass = 2.0, .damping = 24.0, .stiffness = 2e5, .speed = 200.0}, 0.1, 0.5);
  LyapunovParameters parameters;
  parameters.stretch = 0.03;
  parameters.distance = 0.1;
  parameters.integrator = scene::Integrator::kEvent;
  for (const scene::Scene& s : {scene, in_the_other_order(scene)}) {
    const Lyapunov found = largest_lyapunov(s, parameters);
    ASSERT_TRUE(found.exponent) << found.refused;
    EXPECT_NEAR(*found.exponent, -6.0, 0.3) << "-d / 2 m";
  }
}

// The rotor rubs in the narrow ring all the time, and never touches the wide one.
TEST(ContactOrder, DoesNotMatterForTheFigures) {
  scene::Scene scene = in_two_rings(
      {.damping = 24.0, .stiffness = 2e5, .friction = 0.05, .speed = 200.0}, 0.1e-3, 0.06);
  add_rotating_force(scene, 60.0, 200.0);
  scene.run.end = 0.5;
  for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    nlohmann::json first;
    for (const scene::Scene& s : {scene, in_the_other_order(scene)}) {
      const Trajectory run = run_with(s, integrator, 1e-5);
      ASSERT_EQ(run.status, Status::kOk) << run.message;
      const Metrics found = metrics(run, contact_facts(s));
      EXPECT_EQ(found.settled.attractor, Attractor::kSynchronousRub);
      const nlohmann::json figures = metrics_json(found).flatten();
      if (first.is_null()) first = figures;
      for (const auto& [path, value] : figures.items()) {
        const nlohmann::json& there = first.at(path);
        if (is_timing(path.substr(1))) continue;
        if (value.is_number_float() && std::isfinite(value.get<double>())) {
          ASSERT_TRUE(there.is_number()) << path;
          EXPECT_NEAR(value.get<double>(), there.get<double>(),
                      1e-9 + 1e-6 * std::abs(value.get<double>()))
              << path;
        } else {
          EXPECT_EQ(value.dump(), there.dump()) << path;
        }
      }
    }
  }
}

// The thin ring loses the rotor at a depth of its own radius, 5 mm. The other ring's radius does
// not matter.
TEST(ContactOrder, DoesNotMatterForTheDepthOfASoftRing) {
  const scene::Scene scene = in_two_rings({.clearance = 0.5e-3, .radius = 5e-3}, 0.5e-3, 0.05);
  for (const scene::Scene& s : {scene, in_the_other_order(scene)}) {
    const Model model = prepare(s);
    const MujocoRecord record(model, false, 1e-5, {}, 2e-4);
    Eigen::VectorXd q = Eigen::VectorXd::Zero(model.nq());
    const Eigen::VectorXd v = q;
    q[0] = 5.4e-3;
    EXPECT_FALSE(record.lost(q.data(), v.data()));
    q[0] = 5.6e-3;
    EXPECT_TRUE(record.lost(q.data(), v.data()));
  }
}

}  // namespace
}  // namespace rotorub::test
