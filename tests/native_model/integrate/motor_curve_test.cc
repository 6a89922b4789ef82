// The asynchronous motor on its torque-speed curve (the paper's Fig. 6): run_up_kloss from
// standstill over the breakdown torque to its synchronous speed, then with a rub as its load.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

// N m, the textbook's curve.
double kloss(const scene::Drive& d, double speed) {
  const double slip = 1.0 - speed / d.synchronous_speed;
  return 2.0 * d.breakdown_torque / (slip / d.breakdown_slip + d.breakdown_slip / slip);
}

TEST(MotorCurve, TheRunLiesOnItFromStandstillToItsLoad) {
  const scene::Scene s = test::shipped("run_up_kloss");
  const scene::Drive& motor = *s.drive;
  const Model model = prepare(s);
  const Trajectory t = test::run_with(s, scene::Integrator::kVerlet, 2e-5);
  ASSERT_EQ(t.status, Status::kOk) << t.message;
  const std::vector<double> time = t.column("t"), spin = t.column("spin_speed"),
                            torque = t.column("motor_torque"), twist = t.column("torsion_speed_1");

  // Every row, at the speed of the motor's place.
  for (std::size_t k = 0; k < spin.size(); ++k) {
    const double speed = spin[k] + model.drive_shape[0] * twist[k];
    EXPECT_NEAR(torque[k], kloss(motor, speed), 1e-12 * motor.breakdown_torque) << time[k];
  }

  // The way along it: the starting torque, up to the most it can, down to nothing at its
  // synchronous speed.
  const auto touch = static_cast<std::size_t>(
      std::upper_bound(time.begin(), time.end(), t.statistics.first_touch) - time.begin());
  const auto most = std::max_element(torque.begin(), torque.end());
  const double sb = motor.breakdown_slip;
  EXPECT_DOUBLE_EQ(torque.front(), 2.0 * motor.breakdown_torque * sb / (1.0 + sb * sb));
  EXPECT_NEAR(*most, motor.breakdown_torque, 1e-3 * motor.breakdown_torque);
  EXPECT_NEAR(spin[static_cast<std::size_t>(most - torque.begin())],
              (1.0 - sb) * motor.synchronous_speed, 0.01 * motor.synchronous_speed);
  EXPECT_LT(torque[touch - 1], 1e-3) << "no load yet";

  // The rub is its load: what the motor gives is what friction takes and the spin loses; unbalance
  // takes a hundredth.
  double given = 0.0;
  for (std::size_t k = touch; k < time.size(); ++k) {
    given += 0.5 * (torque[k] + torque[k - 1]) * (time[k] - time[k - 1]);
  }
  const double taken = -s.first().contact->radius * t.statistics.friction_impulse;
  const double lost = model.mass[model.layout.phi()] * (spin[touch - 1] - spin.back());
  EXPECT_NEAR(given + lost, taken, 0.02 * taken);
  EXPECT_GT(spin.back(), (1.0 - sb) * motor.synchronous_speed) << "on the stable branch";
  EXPECT_GT(torque.back(), 0.2);
}

}  // namespace
}  // namespace rotorub
