#include "native_model/stepping/step_contacts.h"

#include <algorithm>
#include <cmath>

#include "native_model/contact/kinematics.h"
#include "native_model/model/dynamics.h"

namespace rotorub {

namespace eq = equations;

StepContacts::StepContacts(const StepState& state, LoadKick& loads)
    : m_(state.model),
      loads_(loads),
      h_(state.h),
      contacts_(state.model.auxiliary.size()),
      uncoupled_(count() * count(), Eigen::Matrix3d::Zero()),
      results_(count()),
      without_impacts_(state.q) {
  for (std::size_t j = 0; j < count(); ++j) {
    Contact& c = contacts_[j];
    c.bearing = &m_.auxiliary[j];
    for (auto& column : c.column) column.resize(state.q.size());
    if (!c.bearing->contact) continue;
    const ContactParameters& law = *c.bearing->contact;
    any_ = true;
    c.rigid = !law.is_compliant();
    any_compliant_ = any_compliant_ || law.is_compliant();
    c.clearance = law.clearance;
    c.radius = law.radius;
    if (law.friction.is_constant()) c.friction = law.friction.coefficient;
    for (int axis = 0; axis < 3; ++axis) {
      double* column = c.column[static_cast<std::size_t>(axis)].data();
      add_contact_load(m_, Eigen::Vector3d::Unit(axis), column, j);
      loads.solve_uncoupled(column);
      for (std::size_t i = 0; i < count(); ++i) {
        if (!m_.auxiliary[i].contact) continue;
        uncoupled_[i * count() + j].col(axis) = contact_acceleration(m_, column, i);
      }
    }
  }
  admittance_ = uncoupled_;
  impacts.reserve(count() * count() * kMostImpacts);
}

void StepContacts::clear_results() {
  impacts.clear();
  impacted_ = false;
  for (std::size_t i = 0; i < count(); ++i) {
    contacts_[i].last_sign = states[i].slip_sign;
    if (has_results_) results_[i] = {};
  }
  has_results_ = false;
}

void StepContacts::restart(const StepState& state) {
  states = {};
  for (std::size_t i = 0; i < count(); ++i) {
    if (!m_.auxiliary[i].contact) continue;
    const ContactPoint p = contact_point(m_, state.q.data(), state.v.data(), i);
    if (contacts_[i].rigid) {
      states[i].closed = rests_on_circle(p.gap, p.gap_rate, parameters(i).clearance);
      continue;
    }
    states[i].closed = CompliantLaw::begins_closed(p.gap, p.gap_rate, parameters(i).clearance);
    states[i].hunt_crossley = parameters(i).compliance.a_of_start();
  }
}

bool StepContacts::any_rigid_lasts() const {
  for (std::size_t i = 0; i < count(); ++i) {
    if (contacts_[i].rigid && states[i].closed) return true;
  }
  return false;
}

Eigen::Vector3d StepContacts::rates(std::size_t i, const double* v) const {
  const Pair w = eq::relative(m_, *contacts_[i].bearing, v);
  return {w.x, w.y, eq::contact_spin(m_, *contacts_[i].bearing, v)};
}

// ------------------------------------------------------------------ response to a load
// Updates the admittance to the coupling of bending and spin in this step.
void StepContacts::update_admittance() {
  const Layout& l = m_.layout;
  const VelocityMatrix& a = loads_.matrix();
  if (coupled_at_ == a.times_coupled()) return;
  coupled_at_ = a.times_coupled();
  for (Contact& c : contacts_) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      c.coupled[axis] = a.coupled_part(c.column[axis].data());
    }
  }
  for (std::size_t i = 0; i < count(); ++i) {
    const AuxiliaryBearing& at = *contacts_[i].bearing;
    const Pair bent = eq::at_station(l.modes, at.shape, a.solved_coupling());
    double turned = a.spin_column()[0];
    for (int k = 0; k < l.torsion; ++k) turned += at.torsion_shape[k] * a.spin_column()[1 + k];
    for (std::size_t j = 0; j < count(); ++j) {
      const Eigen::Matrix3d& from = uncoupled_[i * count() + j];
      Eigen::Matrix3d& to = admittance_[i * count() + j];
      for (int axis = 0; axis < 3; ++axis) {
        const VelocityMatrix::Coupled& part = contacts_[j].coupled[static_cast<std::size_t>(axis)];
        to(0, axis) = from(0, axis) - bent.x * part.spin;
        to(1, axis) = from(1, axis) - bent.y * part.spin;
        to(2, axis) = from(2, axis) + turned * part.back;
      }
    }
  }
}

ROTORUB_INLINE void StepContacts::add_response(std::size_t i, double normal, double friction,
                                               const double* from, double* to) const {
  const Contact& c = contacts_[i];
  const double px = -c.e_r.x * normal - c.e_r.y * friction,
               py = -c.e_r.y * normal + c.e_r.x * friction, pz = c.radius * friction;
  const double *cx = c.column[0].data(), *cy = c.column[1].data(), *cz = c.column[2].data();
  const int nq = static_cast<int>(c.column[0].size());
  ROTORUB_APART for (int k = 0; k < nq; ++k) {
    to[k] = from[k] + (cx[k] * px + cy[k] * py + cz[k] * pz);
  }
  if (!loads_.coupled()) return;
  const auto along = [&](auto part) {
    return c.coupled[0].*part * px + c.coupled[1].*part * py + c.coupled[2].*part * pz;
  };
  using Coupled = VelocityMatrix::Coupled;
  loads_.matrix().add({along(&Coupled::spin), along(&Coupled::back)}, to);
}

void StepContacts::add_velocity_change(std::size_t i, double normal, double friction,
                                       double* to) const {
  add_response(i, normal, friction, to, to);
}

Eigen::Vector3d StepContacts::rates_by(std::size_t i, const List& others) const {
  Eigen::Vector3d sum(0.0, 0.0, 0.0);
  for (const std::size_t j : others) {
    if (j == i) continue;
    const Contact& c = contacts_[j];
    sum += admittance(i, j) *
           contact_load({c.e_r.x, c.e_r.y}, c.radius, states[j].normal, states[j].friction);
  }
  return sum;
}

// ------------------------------------------------------------------ lasting contact
ROTORUB_INLINE bool StepContacts::leaves_circle(const Contact& c, const Pair& velocity) const {
  const double px = c.d.x + h_ * velocity.x, py = c.d.y + h_ * velocity.y;
  return px * px + py * py > c.clearance * c.clearance;
}

ROTORUB_INLINE void StepContacts::find_separations(const StepState& state) {
  for (Contact& c : contacts_) c.d = eq::separation(m_, *c.bearing, state.q_k.data());
  find_free_rates(state);
}

ROTORUB_INLINE void StepContacts::find_free_rates(const StepState& state) {
  for (std::size_t i = 0; i < count(); ++i) {
    Contact& c = contacts_[i];
    c.v_free = eq::relative(m_, *c.bearing, state.v_free.data());
    if (!c.rigid) c.free_rates = rates(i, state.v_free.data());
  }
}

// Finds the rigid contacts that last. A contact that acts alone lasts if its free path leaves the
// circle. One of several may be closed by the force of another, so all are solved together.
ROTORUB_INLINE void StepContacts::find_lasting(StepState& state, bool iteration_deferred) {
  lasting_.clear();
  for (std::size_t i = 0; i < count(); ++i) {
    if (contacts_[i].rigid && states[i].closed) lasting_.push_back(i);
  }
  if (lasting_.size() != 1 || !compliant_.empty()) return;
  const Contact& c = contacts_[lasting_[0]];
  bool outside = leaves_circle(c, c.v_free);
  if (!outside && iteration_deferred) {
    loads_.iterate(state);
    find_free_rates(state);
    outside = leaves_circle(c, c.v_free);
  }
  if (outside) return;
  states[lasting_[0]] = {};
  lasting_.clear();
}

bool StepContacts::any_flight_ends(const StepState& state) const {
  for (const Contact& c : contacts_) {
    if (!c.in_flight) continue;
    const Pair v = any_acts_ ? eq::relative(m_, *c.bearing, state.v_end.data()) : c.v_free;
    if (leaves_circle(c, v)) return true;
  }
  return false;
}

// Solves one rigid contact with a constant mu that slides on as in the step before, in closed form;
// returns false if it does not. See contact/lasting_contacts.h.
ROTORUB_INLINE bool StepContacts::try_sliding_on(std::size_t i, const double* free) {
  const Contact& c = contacts_[i];
  const double h = h_, r = c.radius, ex = c.e_r.x, ey = c.e_r.y;
  const double spin = eq::contact_spin(m_, *c.bearing, free);
  const double ratio = -*c.friction * c.sign_before;
  // Response to N with T = ratio N.
  const double lx = -ex - ey * ratio, ly = -ey + ex * ratio, lz = r * ratio;
  const Eigen::Matrix3d& a = admittance(i, i);
  const double gx = a(0, 0) * lx + a(0, 1) * ly + a(0, 2) * lz;
  const double gy = a(1, 0) * lx + a(1, 1) * ly + a(1, 2) * lz;
  const double gz = a(2, 0) * lx + a(2, 1) * ly + a(2, 2) * lz;
  const double px = c.d.x + h * c.v_free.x, py = c.d.y + h * c.v_free.y, hx = h * gx, hy = h * gy;
  const double square = hx * hx + hy * hy, along = px * hx + py * hy;
  const double circle = c.clearance * c.clearance;
  const double depth = px * px + py * py - circle;
  const double root = along * along - square * depth;
  const double normal = depth / (std::sqrt(root > 0.0 ? root : 1.0) - along);
  const double slip =
      ex * (c.v_free.y + normal * gy) - ey * (c.v_free.x + normal * gx) + r * (spin + normal * gz);
  const double turned = c.d.x * px + c.d.y * py;
  // After iteration the path may end inside the circle; the contact must not pull it out.
  const bool slides = depth > 0.0 && root > 0.0 && along < 0.0 && slip * c.sign_before > 0.0 &&
                      turned >= 0.5 * circle;
  if (!slides) return false;
  states[i].normal = normal;
  states[i].friction = ratio * normal;
  states[i].slip_sign = c.sign_before;
  return true;
}

// Computes v_end from v_free and v_start, including the iteration if there is one.
ROTORUB_INLINE void StepContacts::solve_contacts(StepState& state) {
  if (loads_.coupled()) update_admittance();
  for (const std::size_t i : lasting_) turn_normal(contacts_[i]);
  if (loads_.needs_iteration()) loads_.begin_iteration(state.kick_length);
  const bool may_slide_on =
      compliant_.empty() && lasting_.size() == 1 && contacts_[lasting_[0]].friction;
  for (bool settled = false;;) {
    const bool slides_on = may_slide_on && try_sliding_on(lasting_[0], state.v_free.data());
    if (!slides_on && !find_impulses(state)) return;
    const double* from = state.v_free.data();
    for (const List* list : {&lasting_, &compliant_}) {
      for (const std::size_t i : *list) {
        add_response(i, states[i].normal, states[i].friction, from, state.v_end.data());
        from = state.v_end.data();
      }
    }
    // One more solution follows the last round.
    if (!loads_.needs_iteration() || settled) break;
    settled = !loads_.iterate_once(state, state.v_end.data());
    find_free_rates(state);
  }
}

// Finds the impulses of all contacts for the present v_free; false if the laws have no unique
// solution. Rigid and compliant contacts are solved in turn until their impulses no longer change,
// at most kRounds times.
bool StepContacts::find_impulses(StepState& state) {
  if (compliant_.empty()) return solve_rigid(state);
  constexpr int kRounds = 200;
  constexpr double kSettled = 1e-15;  // relative to the largest impulse
  for (int round = 0; round < kRounds; ++round) {
    const States was = states;
    if (!solve_compliant(state)) return false;
    if (lasting_.empty()) return true;
    if (!solve_rigid(state)) return false;
    double moved = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < count(); ++i) {
      moved = std::max({moved, std::abs(states[i].normal - was[i].normal),
                        std::abs(states[i].friction - was[i].friction)});
      largest = std::max(largest, states[i].normal);
    }
    if (moved <= kSettled * largest) break;
  }
  return true;
}

bool StepContacts::solve_rigid(StepState& state) {
  ContactList<LastingContact> contacts;
  for (const std::size_t i : lasting_) {
    Contact& c = contacts_[i];
    LastingContact s;
    s.d = {c.d.x, c.d.y};
    s.free = rates(i, state.v_free.data()) + rates_by(i, compliant_);
    // If the path of a single contact ends far from its start (it passes the middle), the normal is
    // taken at the point where the path leaves the circle.
    const Eigen::Vector2d path = h_ * s.free.head<2>();
    if (lasting_.size() == 1 && s.d.dot(s.d + path) < 0.5 * c.clearance * c.clearance) {
      const double share = circle_exit(s.d, path, c.clearance).value_or(1.0);
      const Eigen::Vector2d e_r = (s.d + share * path).normalized();
      c.e_r = {e_r.x(), e_r.y()};
    }
    s.e_r = {c.e_r.x, c.e_r.y};
    s.start = rates(i, state.v_start.data());
    s.clearance = c.clearance;
    s.radius = c.radius;
    s.friction = parameters(i).friction;
    s.slip_sign = c.sign_before;
    // The impulses of the last round, or in the first round those of the step before.
    const State& last = states[i];
    const bool begun = last.normal > 0.0;
    s.normal_impulse = begun ? last.normal : state.kick_length * last.normal_at_end;
    s.friction_impulse = begun ? last.friction : state.kick_length * last.friction_at_end;
    contacts.push_back(s);
  }
  const ContactAdmittance a{admittance_.data(), count(), {lasting_.data(), lasting_.size()}};
  const Status found = solve_lasting_contacts(h_, {contacts.data(), contacts.size()}, a);
  if (found != Status::kOk) {
    state.fail(found);
    return false;
  }
  for (std::size_t k = 0; k < lasting_.size(); ++k) {
    State& c = states[lasting_[k]];
    c.normal = contacts[k].normal_impulse;
    c.friction = contacts[k].friction_impulse;
    c.slip_sign = contacts[k].slip_sign;
  }
  return true;
}

void StepContacts::apply_lasting(StepState& state, bool iteration_deferred) {
  find_separations(state);
  any_acts_ = false;
  for (std::size_t i = 0; i < count(); ++i) {
    State& c = states[i];
    contacts_[i].in_flight = contacts_[i].rigid && !c.closed && m_.auxiliary[i].contact;
    contacts_[i].sign_before = c.slip_sign;
    c.normal = c.friction = 0.0;
  }
  if (any_compliant_ && !find_touches(state)) return;
  find_lasting(state, iteration_deferred);
  any_acts_ = !lasting_.empty() || !compliant_.empty();
  if (any_acts_) solve_contacts(state);
  for (std::size_t i = 0; i < count(); ++i) {
    State& c = states[i];
    const bool loaded = c.closed && c.normal > 0.0;
    if (contacts_[i].rigid) c.closed = loaded;
    if (!loaded) c.slip_sign = 0.0;
    c.normal_at_end = c.normal / state.kick_length;
    c.friction_at_end = c.friction / state.kick_length;
  }
  if (any_acts_) record_lasting();
}

void StepContacts::add_last_forces(StepState& state) {
  bool any = false;
  for (std::size_t i = 0; i < count(); ++i) {
    const State& kept = states[i];
    if (!kept.closed || !(kept.normal_at_end > 0.0)) continue;
    if (!any && loads_.coupled()) update_admittance();
    any = true;
    Contact& c = contacts_[i];
    const Pair d = eq::separation(m_, *c.bearing, state.q_k.data());
    const double delta = std::sqrt(d.x * d.x + d.y * d.y);
    if (!(delta > (c.rigid ? kNoNormal : c.clearance))) continue;
    c.e_r = {d.x / delta, d.y / delta};
    add_velocity_change(i, kept.normal_at_end, kept.friction_at_end, state.v_free.data());
  }
}

}  // namespace rotorub
