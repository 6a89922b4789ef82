#include "native_model/trajectory/series.h"

#include <array>
#include <cassert>

#include "native_model/dynamics/dynamics.h"
#include "native_model/trajectory/columns.h"

namespace rotorub {
namespace {

using Place = std::vector<Column>::iterator;

bool has_actuator_columns(const AuxiliaryBearing& at) {
  return at.moves() && (at.commanded() || at.magnets);
}

// What moves the ring of the k-th bearing, and its spin.
void put_ring(const Model& m, std::size_t k, const Snapshot& now, Place& column) {
  const ContactSnapshot& at = now.at(k);
  const AuxiliaryBearing& bearing = m.auxiliary[k];
  const auto put = [&column](double value) { (column++)->values.push_back(value); };
  if (has_actuator_columns(bearing)) {
    put(at.actuator.force.x());
    put(at.actuator.force.y());
  }
  if (bearing.magnets) {
    put(at.actuator.current.x());
    put(at.actuator.current.y());
  }
  if (bearing.controller && !bearing.controller->outputs().empty()) {
    std::array<double, kMostOutputs> values = at.actuator.outputs;
    if (!bearing.loop) control_outputs(m, now.t, now.q, now.v, values.data(), k);
    for (std::size_t i = 0; i < bearing.controller->outputs().size(); ++i) put(values[i]);
  }
  if (!bearing.turns()) return;
  put(now.q[bearing.ring_angle]);
  put(now.v[bearing.ring_angle]);
}

// The columns of another contact than the first.
void put_further(const Model& m, std::size_t k, const Snapshot& now, Place& column) {
  const ContactSnapshot& at = now.at(k);
  const ContactPoint p = contact_point(m, now.q, now.v, k);
  const Eigen::Vector2d r = rotor_point(m, now.q, k), rv = rotor_point(m, now.v, k);
  const Eigen::Vector2d f = ring_centre(m, now.q, k), fv = stator_point(m, now.v, k);
  for (double value :
       {r.x(), r.y(), rv.x(), rv.y(), f.x(), f.y(), fv.x(), fv.y(), p.gap, p.gap_rate, p.slip,
        at.normal_force, at.friction_force, static_cast<double>(at.mode)}) {
    (column++)->values.push_back(value);
  }
  put_ring(m, k, now, column);
}

}  // namespace

std::vector<Column> series_of(const Model& model) {
  const Layout& l = model.layout;
  std::vector<Column> c;
  const auto add = [&c](const std::string& name) {
    c.push_back({name, std::string(series_column(name).unit), {}});
  };
  const auto numbered = [&](const std::string& name, int count) {
    for (int k = 1; k <= count; ++k) add(name + "_" + std::to_string(k));
  };
  // What moves the ring of the k-th bearing, and its spin.
  const auto add_ring = [&](std::size_t k) {
    const AuxiliaryBearing& at = model.auxiliary[k];
    const auto of = [k](const char* name) { return column_of_contact(k, name); };
    if (has_actuator_columns(at)) {
      add(of("control_x"));
      add(of("control_y"));
    }
    numbered(of("current"), at.magnets ? 2 : 0);
    if (at.controller) {
      for (const Controller::Output& out : at.controller->outputs()) {
        c.push_back({of("control_") + std::string(out.name), std::string(out.unit), {}});
      }
    }
    if (!at.turns()) return;
    add(of("ring_angle"));
    add(of("ring_speed"));
  };
  for (const char* name : {"t", "rotor_x", "rotor_y", "rotor_vx", "rotor_vy", "stator_x",
                           "stator_y", "stator_vx", "stator_vy", "spin_angle", "spin_speed", "gap",
                           "gap_rate", "slip", "normal_force", "friction_force", "mode"}) {
    add(name);
  }
  for (const char* name : {"x", "y", "vx", "vy"}) numbered(name, l.modes);
  numbered("torsion", l.torsion);
  numbered("torsion_speed", l.torsion);
  add_ring(0);
  if (model.drive) add("motor_torque");
  if (model.feedback) {
    add("bearing_current_x");
    add("bearing_current_y");
  }
  for (std::size_t k = 1; k < model.auxiliary.size(); ++k) {
    for (const char* name :
         {"rotor_x", "rotor_y", "rotor_vx", "rotor_vy", "stator_x", "stator_y", "stator_vx",
          "stator_vy", "gap", "gap_rate", "slip", "normal_force", "friction_force", "mode"}) {
      add(column_of_contact(k, name));
    }
    add_ring(k);
  }
  return c;
}

void put_row(const Model& m, double time, const Snapshot& now, std::vector<Column>& columns) {
  const Layout& l = m.layout;
  const ContactPoint p = contact_point(m, now.q, now.v);
  const Eigen::Vector2d r = rotor_point(m, now.q), rv = rotor_point(m, now.v);
  const Eigen::Vector2d f = ring_centre(m, now.q), fv = stator_point(m, now.v);
  Place column = columns.begin();
  const auto put = [&column](double value) { (column++)->values.push_back(value); };
  for (double value : {time, r.x(), r.y(), rv.x(), rv.y(), f.x(), f.y(), fv.x(), fv.y(),
                       spin_angle(m, now.t, now.q), spin_speed(m, now.v), p.gap, p.gap_rate, p.slip,
                       now.normal_force, now.friction_force, static_cast<double>(now.mode)}) {
    put(value);
  }
  const auto block = [&](const double* from, int at, int count) {
    for (int k = 0; k < count; ++k) put(from[at + k]);
  };
  block(now.q, l.x(), 2 * l.modes);
  block(now.v, l.x(), 2 * l.modes);
  block(now.q, l.theta(), l.torsion);
  block(now.v, l.theta(), l.torsion);
  put_ring(m, 0, now, column);
  if (m.drive) put(motor_torque(m, time, now.q, now.v));
  if (m.feedback) {
    for (const double current : bearing_current(m, time, now.q, now.v)) put(current);
  }
  for (std::size_t k = 1; k < m.auxiliary.size(); ++k) put_further(m, k, now, column);
  assert(column == columns.end());
}

}  // namespace rotorub
