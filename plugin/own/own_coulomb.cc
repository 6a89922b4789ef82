#include "plugin/own/own_coulomb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "native_model/contact/kinematics.h"
#include "native_model/trajectory/trajectory.h"
#include "plugin/contact/annular.h"
#include "plugin/contact/constrained_law.h"
#include "plugin/contact/constraint_probe.h"
#include "plugin/own/own_space.h"
#include "plugin/user_data.h"

namespace rotorub::plugin {
namespace {

// One contact in accelerations: see coulomb.h.
struct TouchingPair {
  const OwnPair* pair = nullptr;
  const OwnSpace* space = nullptr;
  int row = 0;  // of MuJoCo's solver
  ContactPoint point;
  Eigen::Vector2d base;  // m/s^2, of y what is not the acceleration of a coordinate
  double curvature = 0.0;  // m/s^2, towards the ring, with that of centres that go in circles
  bool touches = false;
  Eigen::Vector2d force{0.0, 0.0};  // N, (normal, friction)
  bool sticks = false;

  mjtNum* entry(mjData* d) const { return d->userdata + pair->data; }
  Eigen::Vector3d load(double normal, double friction) const {
    return contact_load(point.e_r, pair->contact.radius, normal, friction);
  }
  // y = base + this of the coordinates' accelerations.
  Eigen::Vector2d along(const Eigen::Vector3d& a) const {
    return {-point.e_r.dot(a.head<2>()),
            point.e_t().dot(a.head<2>()) + pair->contact.radius * a.z()};
  }
};

TouchingPair touching_pair(const OwnPair& pair, const ContactPlace& place, const OwnSpace& space,
                         const mjModel* m, const mjData* d, int row) {
  const double h = m->opt.timestep;
  TouchingPair s;
  s.pair = &pair;
  s.space = &space;
  s.row = row;
  Eigen::Vector3d rates = space.rates(d->qvel);
  rates.z() += pair.held_spin;
  s.point = contact_kinematics(place.d, rates.head<2>(), rates.z(), pair.contact.radius,
                               pair.contact.clearance);
  const ContactPoint& p = s.point;
  const double whirl = p.whirl_speed();
  const Eigen::Vector2d turning = own_turning(pair, place, m, d);
  const double whirling = whirl * whirl / p.delta;
  s.curvature = whirling + p.e_r.dot(turning);
  // MuJoCo's a_ref with the gap rate of the state's own time: that of a semi-implicit step is of half a
  // step ago.
  const mjtNum* kbip = d->efc_KBIP + 4 * row;
  const double reference = -kbip[1] * (p.gap_rate + 0.5 * h * s.curvature) - kbip[0] * kbip[2] * p.gap;
  s.base = {-s.curvature - reference,
            p.slip / h + whirl / p.delta * p.gap_rate + p.e_t().dot(turning)};
  return s;
}

// y without any force. A rebound that the loads undo within the step is no flight.
Eigen::Vector2d look(TouchingPair& s, const Eigen::Vector3d& free, const mjModel* m, mjData* d) {
  const Eigen::Vector2d a = s.along(free);
  const bool before = s.entry(d)[kMode] != 0.0;
  const bool lasts = before && s.point.gap_rate <= -(a.x() - s.curvature) * m->opt.timestep;
  s.touches = s.point.gap < 0.0 || lasts;
  return s.base + a;
}

// Open: well below, so that not even round-off leaves a force.
double open_reference(double acceleration) { return acceleration - (1.0 + std::abs(acceleration)); }

// The contacts of a pass.
struct TouchingPairs {
  std::array<TouchingPair, kMaxPairs> all;
  std::array<int, kMaxPairs> rows{};
  std::size_t count = 0;
  std::span<TouchingPair> span() { return {all.data(), count}; }
};

// Those that touch, in the order of a vector of forces.
struct Touching {
  std::array<TouchingPair*, kMaxPairs> at{};
  std::array<double, kMaxPairs> frictions{};
  std::size_t count = 0;
};

Touching touching(TouchingPairs& contacts) {
  Touching t;
  for (TouchingPair& s : contacts.span()) {
    if (!s.touches) continue;
    t.frictions[t.count] = s.pair->contact.friction;
    t.at[t.count++] = &s;
  }
  return t;
}

ContactMatrix matrix(const Touching& t) {
  const auto n = static_cast<Eigen::Index>(t.count);
  ContactMatrix a(2 * n, 2 * n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const TouchingPair& source = *t.at[static_cast<std::size_t>(j)];
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector3d load = source.load(k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0);
      for (Eigen::Index i = 0; i < n; ++i) {
        const TouchingPair& s = *t.at[static_cast<std::size_t>(i)];
        a.col(2 * j + k).segment<2>(2 * i) = s.along(s.space->flexibility(*source.space) * load);
      }
    }
  }
  return 0.5 * (a + a.transpose());
}

void put(Touching& t, const ContactVector& forces, const std::array<bool, kMaxPairs>& sticks) {
  for (std::size_t k = 0; k < t.count; ++k) {
    t.at[k]->force = forces.segment<2>(static_cast<Eigen::Index>(2 * k));
    t.at[k]->sticks = sticks[k];
  }
}

// Accelerations of the contacts under their forces, beside constraints.
class ForceResponse final : public ContactResponse {
 public:
  ForceResponse(ConstraintProbe& probe, const Touching& t) : probe_(probe), t_(t) {}
  ContactVector at(const ContactVector& p) override {
    probe_.solve([&](mjtNum* force) {
      for (std::size_t k = 0; k < t_.count; ++k) {
        const auto row = static_cast<Eigen::Index>(2 * k);
        t_.at[k]->space->add_load(t_.at[k]->load(p[row], p[row + 1]), force);
      }
    });
    ContactVector y(2 * static_cast<Eigen::Index>(t_.count));
    for (std::size_t k = 0; k < t_.count; ++k) {
      const TouchingPair& s = *t_.at[k];
      y.segment<2>(static_cast<Eigen::Index>(2 * k)) =
          s.base + s.along(probe_.acceleration(*s.space));
    }
    return y;
  }
  double accuracy() const override { return probe_.accuracy(); }

 private:
  ConstraintProbe& probe_;
  const Touching& t_;
};

// Once, not every step.
void note_status(const Touching& t, bool converged, const mjModel* m, mjData* d) {
  const auto warned = [d](const TouchingPair* s) { return s->entry(d)[kContactStatus] != 0.0; };
  const bool known = std::any_of(t.at.begin(), t.at.begin() + static_cast<std::ptrdiff_t>(t.count), warned);
  if (!converged && !known) warn_unsolved(m, d, *t.at[0]->space);
  for (std::size_t k = 0; k < t.count; ++k) {
    t.at[k]->entry(d)[kContactStatus] =
        converged ? 0.0 : static_cast<double>(Status::kNoSolution);
  }
}

void solve_free(TouchingPairs& contacts, const mjModel* m, mjData* d) {
  ContactVector b(2 * static_cast<Eigen::Index>(contacts.count));
  Eigen::Index rows = 0;
  for (TouchingPair& s : contacts.span()) {
    const Eigen::Vector2d free = look(s, s.space->response(d->qfrc_smooth), m, d);
    if (!s.touches) continue;
    b.segment<2>(rows) = free;
    rows += 2;
  }
  Touching t = touching(contacts);
  if (t.count == 0) return;
  std::array<ContactSet, kMaxPairs> sets{};
  for (std::size_t k = 0; k < t.count; ++k) sets[k].friction = t.frictions[k];
  const CoupledSolution s =
      solve_coupled(matrix(t), b.head(rows), std::span(sets).first(t.count));
  if (s.solutions > 0) put(t, s.p, s.sticks);
}

// MuJoCo's solver finds l = (aref - J a_smooth) / (J M^-1 J^T + R): the aref for the normal forces.
void set_references(TouchingPairs& contacts, const mjModel* m, mjData* d) {
  StackFrame room(d);
  mjtNum* acceleration = room.numbers(count(m->nv));
  mju_copy(acceleration, d->qacc_smooth, count(m->nv));
  for (const TouchingPair& s : contacts.span()) {
    if (s.force.x() > 0.0) s.space->add_acceleration(s.load(s.force.x(), s.force.y()), acceleration);
  }
  for (const TouchingPair& s : contacts.span()) {
    const double found = s.along(s.space->rates(acceleration)).x();
    d->efc_aref[s.row] =
        s.force.x() > 0.0 ? found + d->efc_R[s.row] * s.force.x() : open_reference(found);
  }
}

// The same beside constraints: the contacts' own rows rest while the others are tried. What the solver
// finds then is J a = aref - R l.
void solve_beside_constraints(TouchingPairs& contacts, const mjModel* m, mjData* d) {
  constexpr double kResting = -1e12;  // m/s^2
  for (const TouchingPair& s : contacts.span()) d->efc_aref[s.row] = kResting;
  ConstraintProbe probe(m, d);
  probe.solve([](mjtNum*) {});
  for (TouchingPair& s : contacts.span()) look(s, probe.acceleration(*s.space), m, d);
  Touching t = touching(contacts);
  if (t.count > 0) {
    ForceResponse response(probe, t);
    const ContactVector none = ContactVector::Zero(2 * static_cast<Eigen::Index>(t.count));
    const ConstrainedContact found = solve_constrained(response, response.at(none), matrix(t),
                                                       std::span(t.frictions).first(t.count));
    if (found.solved) put(t, found.p, found.sticks);
    note_status(t, found.converged, m, d);
    ContactVector forces = none;
    for (std::size_t k = 0; k < t.count; ++k) {
      forces.segment<2>(static_cast<Eigen::Index>(2 * k)) = t.at[k]->force;
    }
    response.at(forces);
  }
  bool any = false;
  for (const TouchingPair& s : contacts.span()) {
    const double found = s.along(s.space->rates(d->qacc)).x();
    any = any || s.force.x() > 0.0;
    d->efc_aref[s.row] =
        s.force.x() > 0.0 ? found + d->efc_R[s.row] * s.force.x() : open_reference(found);
  }
  if (any) probe.keep();
}

void note(const TouchingPair& s, mjData* d) {
  mjtNum* entry = s.entry(d);
  const bool closed = s.force.x() > 0.0;
  const Mode mode = !closed ? Mode::kFree : s.sticks ? Mode::kStick : Mode::kSlide;
  entry[kNormalForce] = s.force.x();
  entry[kFrictionForce] = s.force.y();
  entry[kMode] = static_cast<double>(mode);
}

}  // namespace

void apply_own_coulomb(std::span<const OwnPair> pairs, const mjModel* m, mjData* d) {
  // On the stack of mjData: the last made goes first.
  std::array<std::optional<OwnSpace>, kMaxPairs> spaces;
  TouchingPairs contacts;
  for (const OwnPair& pair : pairs) {
    if (pair.law == scene::ContactModel::kRigid) continue;
    mjtNum* entry = d->userdata + pair.data;
    entry[kNormalForce] = entry[kFrictionForce] = 0.0;
    const mjContact* contact = find_contact(pair.rotor_geom, pair.ring_geom, d);
    if (!contact) entry[kMode] = 0.0;
    if (!contact || pair.law != scene::ContactModel::kCoulomb) continue;
    if (contacts.count == 0) {
      mj_fwdActuation(m, d);
      mj_fwdAcceleration(m, d);
    }
    const ContactPlace place = contact_place(pair, d);
    OwnSpace& space = spaces[contacts.count].emplace(pair, place, m, d);
    space.solve();
    contacts.rows[contacts.count] = contact->efc_address;
    contacts.all[contacts.count++] = touching_pair(pair, place, space, m, d, contact->efc_address);
  }
  if (contacts.count == 0) return;
  bool beside = false;
  for (const TouchingPair& s : contacts.span()) {
    beside = beside || constraints_couple(m, d, *s.space, std::span(contacts.rows).first(contacts.count));
  }
  if (beside) {
    solve_beside_constraints(contacts, m, d);
  } else {
    solve_free(contacts, m, d);
    set_references(contacts, m, d);
  }
  for (const TouchingPair& s : contacts.span()) {
    note(s, d);
    s.space->add_load(s.load(0.0, s.force.y()), d->qfrc_passive);
  }
  for (std::size_t i = contacts.count; i-- > 0;) spaces[i].reset();
}

}  // namespace rotorub::plugin
