// The motion of the base against equivalents: a weight, forces, and the machine in fixed
// coordinates.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "native_model/scene/reader.h"
#include "tests/support/native_run.h"
#include "tests/support/pair_parts.h"

namespace rotorub::test {
namespace {

using Eigen::Vector2d;

scene::Scene shaft(const std::vector<std::string>& overrides) {
  return scene::parse_scene(kBaseGeometry, "shaft.toml", overrides);
}
scene::Scene mode(const std::vector<std::string>& overrides) {
  return scene::parse_scene(kBaseModal, "mode.toml", overrides);
}

// Largest difference of all columns, relative to the largest value of each.
double apart(const Trajectory& a, const Trajectory& b) {
  EXPECT_EQ(a.rows(), b.rows());
  double largest = 0.0;
  for (std::size_t c = 0; c < a.series.size(); ++c) {
    double size = 1e-12, by = 0.0;
    for (std::size_t k = 0; k < a.rows(); ++k) {
      size = std::max(size, std::abs(a.series[c].values[k]));
      by = std::max(by, std::abs(a.series[c].values[k] - b.series[c].values[k]));
    }
    largest = std::max(largest, by / size);
  }
  return largest;
}

// A base that accelerates upwards acts as a weight does: on rotor, modes and ring, through impacts.
TEST(MovingBase, AConstantAccelerationIsAWeight) {
  const scene::Scene pushed =
      shaft({"base={time=[-1.0,1.0],acceleration_x=[-0.5,-0.5],acceleration_y=[9.81,9.81]}"});
  const scene::Scene heavy = shaft({"gravity={acceleration=[0.5,-9.81]}"});
  for (const auto integrator :
       {scene::Integrator::kEvent, scene::Integrator::kVerlet, scene::Integrator::kEuler}) {
    const Trajectory a = run_with(pushed, integrator), b = run_with(heavy, integrator);
    EXPECT_GE(a.impacts.size(), 1u);
    // Round-off, which impacts magnify.
    EXPECT_LT(apart(a, b), 1e-9) << a.integrator;
    EXPECT_NEAR(a.statistics.external_work, b.statistics.external_work, 1e-12) << a.integrator;
  }
}

// A cos(w t + phi) along d is half a turn forward and half a turn backward.
TEST(MovingBase, ALineIsTwoForcesOnARotorInAFixedRing) {
  const std::string times = ",on=0.7654e-3,ramp=3.21e-3,off=8.7654e-3}";
  const scene::Scene moved = mode({"stator=none",
                                   "base={frequency=[510.0],amplitude=[60.0],"
                                   "phase=[0.3],direction=0.6" +
                                       times});
  const scene::Scene forced = mode(
      {"stator=none", "force[1]={kind='rotating',amplitude=-60.0,frequency=510.0,phase=0.9" + times,
       "force[2]={kind='rotating',amplitude=-60.0,frequency=-510.0,phase=0.3" + times});
  const Trajectory a = run_event(moved), b = run_event(forced);
  EXPECT_GE(a.impacts.size(), 1u);
  EXPECT_LT(apart(a, b), 1e-9);
  EXPECT_LT(a.statistics.energy_residual(), 1e-10) << "what the base does is booked";
}

// The machine of kBaseModal without its force, in coordinates that stand still: springs, dampers
// and the impact act between each body and a base that is at
//
//   u(t) = -sum_j A_j / w_j^2 cos(w_j t + phi_j) d.
class StillFrame {
 public:
  static constexpr double kRotor = 2.0, kRing = 1.0, kClearance = 0.5e-3, kFriction = 0.2,
                          kRestitution = 0.4, kStep = 2e-6;
  // Rotor, ring: places, then velocities, m and m/s.
  using Phase = Eigen::Matrix<double, 8, 1>;

  // Relative to the base, at 0.
  explicit StillFrame(const Phase& start) : y_(start + moved(0.0)) {}

  void run(double end) {
    while (t_ < end - 1e-15) {
      const double h = std::min(kStep, end - t_);
      const Phase next = step(h);
      if (gap(next) < 0.0) {
        double low = 0.0, high = h;  // of the time to the touch
        for (int k = 0; k < 80; ++k) {
          const double middle = 0.5 * (low + high);
          (gap(step(middle)) < 0.0 ? high : low) = middle;
        }
        y_ = step(low);
        t_ += low;
        hit();
      } else {
        y_ = next;
        t_ += h;
      }
    }
  }
  Phase relative() const { return y_ - moved(t_); }
  int hits() const { return hits_; }

 private:
  static Phase moved(double t) {
    const double w[] = {200.0, 510.0}, a[] = {60.0, 40.0}, phase[] = {0.3, 1.9};
    double place = 0.0, rate = 0.0;
    for (int j = 0; j < 2; ++j) {
      place -= a[j] / (w[j] * w[j]) * std::cos(w[j] * t + phase[j]);
      rate += a[j] / w[j] * std::sin(w[j] * t + phase[j]);
    }
    const Vector2d d(std::cos(0.6), std::sin(0.6));
    Phase all;
    all << place * d, place * d, rate * d, rate * d;
    return all;
  }
  static Phase slope(double t, const Phase& y) {
    const Phase of_base = y - moved(t);
    Phase f;
    f.head<4>() = y.tail<4>();
    f.segment<2>(4) = (-2e5 * of_base.head<2>() - 40.0 * of_base.segment<2>(4)) / kRotor;
    f.segment<2>(6) = (-1e5 * of_base.segment<2>(2) - 200.0 * of_base.segment<2>(6)) / kRing;
    return f;
  }
  Phase step(double h) const {  // Runge and Kutta
    const Phase a = slope(t_, y_), b = slope(t_ + 0.5 * h, y_ + 0.5 * h * a),
                c = slope(t_ + 0.5 * h, y_ + 0.5 * h * b), d = slope(t_ + h, y_ + h * c);
    return y_ + h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  static double gap(const Phase& y) { return kClearance - (y.head<2>() - y.segment<2>(2)).norm(); }
  // Poisson's law; the surface is fast enough to slide on in one sense.
  void hit() {
    const Vector2d r = (y_.head<2>() - y_.segment<2>(2)).normalized(), along(-r.y(), r.x());
    const double closing = r.dot(y_.segment<2>(4) - y_.segment<2>(6));
    const double normal = (1.0 + kRestitution) * closing / (1.0 / kRotor + 1.0 / kRing);
    const Vector2d impulse = -normal * r - kFriction * normal * along;
    y_.segment<2>(4) += impulse / kRotor;
    y_.segment<2>(6) -= impulse / kRing;
    ++hits_;
  }

  double t_ = 0.0;
  Phase y_;
  int hits_ = 0;
};

TEST(MovingBase, TheRelativeFrameIsAMovedFrame) {
  for (const double end : {0.5e-3, 4e-3}) {  // in flight, and through impacts
    const scene::Scene scene = mode(
        {"force=none", "run.end=" + std::to_string(end),
         "base={frequency=[200.0,510.0],amplitude=[60.0,40.0],phase=[0.3,1.9],direction=0.6}"});
    StillFrame::Phase start;
    start << 0.2e-3, -0.1e-3, 0.0, 0.0, 0.25, 0.05, 0.0, 0.0;
    StillFrame still(start);
    still.run(end);
    const Trajectory t = run_event(scene);
    ASSERT_EQ(static_cast<int>(t.impacts.size()), still.hits());
    EXPECT_EQ(still.hits() > 0, end > 1e-3);
    const StillFrame::Phase exact = still.relative();
    const char* const columns[] = {"rotor_x",  "rotor_y",  "stator_x",  "stator_y",
                                   "rotor_vx", "rotor_vy", "stator_vx", "stator_vy"};
    for (int i = 0; i < 8; ++i) {
      EXPECT_NEAR(t.column(columns[i]).back(), exact[i], i < 4 ? 1e-13 : 1e-10) << columns[i];
    }
  }
}

}  // namespace
}  // namespace rotorub::test
