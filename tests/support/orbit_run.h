// A run whose rotor moves on a prescribed orbit.
#pragma once

#include <complex>
#include <cstddef>
#include <utility>
#include <vector>

#include "native_model/trajectory/trajectory.h"

namespace rotorub::test {

// The state at one instant.
struct OrbitRow {
  std::complex<double> place, rate;  // x + i y, m, and m/s
  double angle = 0.0, speed = 0.0;   // of the spin, rad and rad/s
};

// The time at which the mark passes between two rows, by bisection.
template <class At>
KeyphasorPass pass_between(double low, double high, double mark, At at) {
  const bool rises = at(high).angle > at(low).angle;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((at(middle).angle > mark) == rises ? high : low) = middle;
  }
  const OrbitRow row = at(high);
  return {high, row.place.real(), row.place.imag(), row.speed};
}

// A run with `rows` rows, evenly from 0 to `end`, s. at(t): the OrbitRow at t.
template <class At>
Trajectory orbit_run(double end, std::size_t rows, At at) {
  std::vector<double> t, x, y, vx, vy, angle, speed;
  for (std::size_t i = 0; i < rows; ++i) {
    t.push_back(end * static_cast<double>(i) / static_cast<double>(rows - 1));
    const OrbitRow row = at(t.back());
    x.push_back(row.place.real());
    y.push_back(row.place.imag());
    vx.push_back(row.rate.real());
    vy.push_back(row.rate.imag());
    angle.push_back(row.angle);
    speed.push_back(row.speed);
  }
  Trajectory run;
  Keyphasor keyphasor;
  for (std::size_t i = 0; i < rows; ++i) {
    if (i == 0) keyphasor.begin(angle[0]);
    keyphasor.follow(angle[i], [&](double mark) { return pass_between(t[i - 1], t[i], mark, at); });
  }
  run.keyphasor = keyphasor.take();
  run.series = {{"t", "s", std::move(t)},
                {"rotor_x", "m", std::move(x)},
                {"rotor_y", "m", std::move(y)},
                {"rotor_vx", "m/s", std::move(vx)},
                {"rotor_vy", "m/s", std::move(vy)},
                {"spin_angle", "rad", std::move(angle)},
                {"spin_speed", "rad/s", std::move(speed)}};
  return run;
}

}  // namespace rotorub::test
