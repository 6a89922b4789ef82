// A rotor or a ring beyond what holds it.
#include "native_model/trajectory/range_check.h"
#include "native_model/prepare/prepare.h"

#include <gtest/gtest.h>

#include <utility>

#include "native_model/bearing/actuator.h"
#include "tests/native_model/hard/rules.h"
#include "tests/support/jeffcott.h"

namespace rotorub {
namespace {

constexpr double kAirGap = 1e-3;  // m

scene::Scene in_magnets() {
  scene::Scene scene = test::make_scene({.mass = 2.0, .stiffness = 2e5});
  test::add_ring(scene, 1.0, 200.0, 1e4);
  scene.first().actuator = scene::Actuator{.kind = scene::ActuatorKind::kElectromagnet,
                                           .force_constant = 3e-5,
                                           .bias_current = 3.0,
                                           .air_gap = kAirGap};
  return scene;
}

TEST(RangeCheck, OfTheRingIsTheAirGapOnEitherAxis) {
  const Model model = prepare(in_magnets());
  Eigen::VectorXd q = Eigen::VectorXd::Zero(model.nq());
  const int ring = model.layout.ring();
  for (const Eigen::Vector2d& axis : {Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(0.0, -1.0)}) {
    q.segment(ring, 2) = from_axes(0.99 * kAirGap * axis);
    q.head(2) = q.segment(ring, 2);  // the rotor in its middle
    EXPECT_FALSE(out_of_range(model, q.data()));
    q.segment(ring, 2) = from_axes(1.01 * kAirGap * axis);
    q.head(2) = q.segment(ring, 2);
    const auto reason = out_of_range(model, q.data());
    ASSERT_TRUE(reason);
    EXPECT_NE(reason->find("air gap"), std::string::npos) << *reason;
  }
}

TEST(RangeCheck, OfTheRotorIsTwiceTheClearance) {
  const Model model = prepare(test::make_scene({.clearance = 0.5e-3}));
  Eigen::VectorXd q = Eigen::VectorXd::Zero(model.nq());
  q[0] = 0.99e-3;
  EXPECT_FALSE(out_of_range(model, q.data()));
  q[0] = -1.01e-3;
  const auto reason = out_of_range(model, q.data());
  ASSERT_TRUE(reason);
  EXPECT_NE(reason->find("clearance"), std::string::npos) << *reason;
}

// A soft ring holds up to its own thickness, 5 mm here, wherever it stands in the list.
TEST(RangeCheck, OfASoftRingIsItsOwnThickness) {
  scene::Scene scene = test::make_scene({.clearance = 0.5e-3, .radius = 5e-3});
  scene.auxiliary.push_back(scene.first());
  scene.auxiliary[1].contact->radius = 0.05;
  for (const char* order : {"thin ring first", "thick ring first"}) {
    SCOPED_TRACE(order);
    const Model model = prepare(scene);
    Eigen::VectorXd q = Eigen::VectorXd::Zero(model.nq());
    q[0] = 5.4e-3;
    EXPECT_FALSE(out_of_range(model, q.data(), RingDepth::kThickness));
    EXPECT_TRUE(out_of_range(model, q.data())) << "a rigid ring holds up to its clearance";
    q[0] = 5.6e-3;
    EXPECT_TRUE(out_of_range(model, q.data(), RingDepth::kThickness));
    std::swap(scene.auxiliary[0], scene.auxiliary[1]);
  }
}

// The ring's spring is weaker than the pull of the bias current: it runs into a core.
TEST(RangeCheck, EndsARunWithWhatThereIs) {
  scene::Scene scene = in_magnets();
  scene.first().stator->position = from_axes({1e-6, 0.0});
  scene.run.end = 0.5;
  const Trajectory t = test::run_event(scene);
  ASSERT_EQ(t.status, Status::kOutOfRange) << t.message;
  EXPECT_NE(t.message.find("air gap"), std::string::npos) << t.message;
  EXPECT_NE(t.message.find("t = "), std::string::npos) << t.message;
  EXPECT_LT(t.end, scene.run.end);
  EXPECT_GT(t.rows(), 1u);
  const auto &x = t.column("stator_x"), &y = t.column("stator_y");
  for (std::size_t k = 0; k < t.rows(); ++k) {
    EXPECT_LE(to_axes({x[k], y[k]}).cwiseAbs().maxCoeff(), kAirGap * (1.0 + 1e-9));
  }
}

}  // namespace
}  // namespace rotorub
