// Trajectories written by hand, whose figures are known.
#pragma once

#include <cmath>
#include <complex>
#include <functional>
#include <string>

#include "native_model/trajectory/columns.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub::test {

// The rows that a hand-made series is filled from.
struct Row {
  double x = 0.0, y = 0.0, vx = 0.0, vy = 0.0;  // rotor, ring at rest in the origin
  double spin_speed = 0.0, gap = 0.0, slip = 0.0;
  double normal = 0.0, friction = 0.0;
};

// `rows` rows at t = k spacing, each from row(t).
inline Trajectory hand_made(std::size_t rows, double spacing,
                            const std::function<Row(double)>& row) {
  Trajectory trajectory;
  for (const char* name : {"t", "rotor_x", "rotor_y", "rotor_vx", "rotor_vy", "stator_x",
                           "stator_y", "stator_vx", "stator_vy", "spin_angle", "spin_speed", "gap",
                           "gap_rate", "slip", "normal_force", "friction_force", "mode"}) {
    trajectory.series.push_back({name, "", std::vector<double>(rows, 0.0)});
  }
  const auto put = [&](const std::string& name, std::size_t i, double value) {
    for (Column& column : trajectory.series) {
      if (column.name == name) column.values[i] = value;
    }
  };
  double turned = 0.0;  // rad
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = static_cast<double>(i) * spacing;
    const Row r = row(t);
    put("t", i, t);
    put("rotor_x", i, r.x);
    put("rotor_y", i, r.y);
    put("rotor_vx", i, r.vx);
    put("rotor_vy", i, r.vy);
    turned += i == 0 ? 0.0 : 0.5 * spacing * (r.spin_speed + row(t - spacing).spin_speed);
    put("spin_angle", i, turned);
    put("spin_speed", i, r.spin_speed);
    put("gap", i, r.gap);
    put("slip", i, r.slip);
    put("normal_force", i, r.normal);
    put("friction_force", i, r.friction);
  }
  trajectory.end = static_cast<double>(rows - 1) * spacing;
  trajectory.step = spacing;
  return trajectory;
}

// A rotor that goes the way place(t) = x + i y, m; its velocity is a difference.
inline Trajectory moving(std::size_t rows, double spacing,
                         const std::function<std::complex<double>(double)>& place) {
  return hand_made(rows, spacing, [&](double t) {
    constexpr double kStep = 1e-7;  // s
    const std::complex<double> z = place(t),
                               v = (place(t + kStep) - place(t - kStep)) / (2.0 * kStep);
    Row row;
    row.x = z.real();
    row.y = z.imag();
    row.vx = v.real();
    row.vy = v.imag();
    return row;
  });
}

struct Whirl {
  double clearance = 0.5e-3;  // m
  double radius = 0.05;       // m
  double frequency = 300.0;   // rad/s, signed
  double spin_speed = 300.0;  // rad/s
  double normal = 100.0;      // N
  double friction = 0.2;      // mu
};

// A rotor that slides along the ring for ever, obeying every law.
inline Row sliding(const Whirl& w, double t) {
  const double angle = w.frequency * t;
  const double v = w.frequency * w.clearance;
  Row row;
  row.x = w.clearance * std::cos(angle);
  row.y = w.clearance * std::sin(angle);
  row.vx = -v * std::sin(angle);
  row.vy = v * std::cos(angle);
  row.spin_speed = w.spin_speed;
  row.slip = v + w.radius * w.spin_speed;
  row.normal = w.normal;
  row.friction = -w.friction * w.normal * (row.slip > 0.0 ? 1.0 : row.slip < 0.0 ? -1.0 : 0.0);
  return row;
}

// One run with two contacts, each as in the given run; times, spin and statistics are the first's.
inline Trajectory at_two_contacts(Trajectory first, const Trajectory& second) {
  for (const Column& column : second.series) {
    if (column.name == "t" || column.name.starts_with("spin_")) continue;
    first.series.push_back({column_of_contact(1, column.name), column.unit, column.values});
  }
  first.contacts = 2;
  first.statistics.contacts.resize(2);
  return first;
}

}  // namespace rotorub::test
