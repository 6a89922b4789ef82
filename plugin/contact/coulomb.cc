#include "plugin/contact/coulomb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "native_model/contact/constrained_law.h"
#include "native_model/contact/impact.h"
#include "native_model/model/dynamics.h"
#include "native_model/scene/mujoco.h"
#include "native_model/trajectory/trajectory.h"
#include "plugin/contact/constraint_probe.h"
#include "plugin/contact/contact_memory.h"
#include "plugin/contact/contact_space.h"
#include "plugin/model/actuators.h"
#include "plugin/model/generated_rotor.h"
#include "plugin/model/options.h"
#include "plugin/model/user_data.h"

namespace rotorub::plugin {
namespace {

// The row of a contact that MuJoCo's solver does not contain (ContactPair::further).
constexpr int kNoRow = -1;

// One contact in terms of accelerations.
struct CoulombContact : ContactRows {
  const ContactPair* pair = nullptr;
  int row = 0;  // row of MuJoCo's solver
  ContactPoint point{};
  Eigen::Vector3d base{0.0, 0.0, 0.0};  // m/s^2, part of y beyond accelerations of coordinates
  double slip = 0.0;                    // m/s, magnitude in both directions
  double curvature = 0.0;  // m/s^2, towards the ring, by the whirl and by centres on circles
  Eigen::Vector3d free{0.0, 0.0, 0.0};  // m/s^2, y without any contact force
  bool closed = false;
  std::optional<double> compliant_force{};  // N, normal force of a compliant contact
  Eigen::Vector3d force{0.0, 0.0, 0.0};     // N, (normal, friction, friction along the axis)
  bool sticks = false;

  ContactEntries& entries(mjData* d) const { return contact_entries(*pair, d); }
  Eigen::Vector3d normal() const { return contact_load(e_r, radius, force.x(), 0.0); }
  Eigen::Vector3d friction() const { return contact_load(e_r, radius, 0.0, force.y()); }
  // Adds the part of the force that MuJoCo's solver does not find.
  void add_remainder(mjtNum* to) const {
    if (row == kNoRow) return plane->add_load(normal() + friction(), to);
    plane->add_remainder(normal(), friction(), to);
    if (axial && force.z() != 0.0) axial->add_load(force.z() * column(2), to);
  }
  // Adds the accelerations by the whole force.
  void add_acceleration(mjtNum* to) const {
    if (row == kNoRow) {
      const Eigen::Vector3d none(0.0, 0.0, 0.0);
      return plane->add_remainder_acceleration(none, normal() + friction(), to);
    }
    plane->add_acceleration(normal(), to);
    plane->add_remainder_acceleration(normal(), friction(), to);
    if (axial && force.z() != 0.0) axial->add_acceleration(force.z() * column(2), to);
  }
};

// K I and B of MuJoCo's reference, where I is the impedance.
struct Reference {
  double stiffness, damping;
};
Reference reference_of(const ContactPair& pair, const mjModel* m, const mjData* d, int row) {
  if (row != kNoRow) {
    const mjtNum* kbip = d->efc_KBIP + 4 * row;
    return {kbip[0] * kbip[2], kbip[1]};
  }
  // As MuJoCo would compute them: direct, with a constant impedance (mjcf/soft_contact.h).
  const mjtNum* solref = m->pair_solref + mjNREF * pair.pair;
  const double impedance = m->pair_solimp[mjNIMP * pair.pair];
  return {-solref[0] / impedance, -solref[1] / impedance};
}

CoulombContact coulomb_contact(const ContactPair& pair, const ContactPlace& place,
                               const Eigen::Vector2d& turning, const ContactSpaces::PairSpaces& at,
                               const mjModel* m, mjData* d, int row) {
  const auto& [space, axial] = at;
  const double h = m->opt.timestep;
  Eigen::Vector3d rates = space->rates(d->qvel);
  rates.z() += pair.prescribed_spin;
  const ContactPoint p = contact_kinematics(place.d, rates.head<2>(), rates.z(),
                                            pair.contact.radius, pair.contact.clearance);
  CoulombContact s{{space, axial, p.e_r, pair.contact.radius}, &pair, row, p};
  const double whirl = p.whirl_speed();
  const double whirling = whirl * whirl / p.delta;
  s.curvature = whirling + p.e_r.dot(turning);
  // MuJoCo's a_ref with the gap rate at the time of the state. The velocity of a semi-implicit step
  // is half a step old.
  const Reference r = reference_of(pair, m, d, row);
  const double reference = -r.damping * (p.gap_rate + 0.5 * h * s.curvature) - r.stiffness * p.gap;
  if (pair.contact.is_compliant()) {
    s.compliant_force = compliant_force(pair, p, m, d);
  }
  s.base = {-s.curvature - reference,
            p.slip / h + whirl / p.delta * p.gap_rate + p.e_t().dot(turning),
            axial ? s.column(2).dot(axial->rates(d->qvel)) / h : 0.0};
  s.slip = std::hypot(p.slip, s.base.z() * h);
  return s;
}

// Finds y without any contact force, where free(space) are the free accelerations, and decides
// whether the contact is closed. A rebound that the loads undo within two steps is not a flight.
// With other contacts, whose forces may close this one, the common law decides.
template <typename Free>
void look(CoulombContact& s, bool with_others, Free free, const mjModel* m, mjData* d) {
  const Eigen::Vector3d a = s.contact_rates(free);
  s.free = s.base + a;
  if (s.compliant_force) {
    s.closed = *s.compliant_force > 0.0;
    return;
  }
  const bool before = s.entries(d).mode != 0.0;
  const bool lasts =
      before && (with_others ||
                 !flight_outlives(2.0 * m->opt.timestep, s.point.gap_rate, s.curvature - a.x()));
  s.closed = s.point.gap < 0.0 || lasts;
}

// The reference of an open contact. It is well below the acceleration, so that not even round-off
// leaves a force.
double open_reference(double acceleration) { return acceleration - (1.0 + std::abs(acceleration)); }

using CoulombContacts = ContactList<CoulombContact>;

// Sets aref, from which MuJoCo's solver finds l = (aref - J a_smooth) / (J M^-1 J^T + R).
// rates(space): the accelerations with all contact forces.
template <typename Rates>
void set_references(const CoulombContacts& contacts, Rates rates, mjData* d) {
  for (const CoulombContact& s : contacts) {
    if (s.row == kNoRow) continue;
    const double found = s.contact_rates(rates).x();
    d->efc_aref[s.row] =
        s.force.x() > 0.0 ? found + d->efc_R[s.row] * s.force.x() : open_reference(found);
  }
}

// The closed contacts, in the order of a vector of forces.
struct ClosedContacts {
  ContactList<CoulombContact*> at;
  ContactList<ImpactLaw> laws;   // only their friction is filled
  ContactList<ContactSet> sets;  // only for compliant contacts; either all or none are
  Eigen::Index rows = 2;         // 3 if one of them moves along its axis
  Eigen::Index row(std::size_t k) const { return rows * static_cast<Eigen::Index>(k); }
  ContactMatrix matrix() const {
    ContactList<const ContactRows*> all;
    for (const CoulombContact* s : at) all.push_back(s);
    return contact_matrix(all, rows, false);
  }
};

ClosedContacts closed_contacts(CoulombContacts& contacts) {
  ClosedContacts closed;
  for (CoulombContact& s : contacts) {
    if (!s.closed) continue;
    // The law is evaluated at the slip here, because the rates of this problem are accelerations.
    ImpactLaw law;
    law.friction = s.pair->contact.friction.at(s.slip);
    closed.laws.push_back(law);
    if (s.compliant_force) {
      ContactSet set{law.friction.coefficient, *s.compliant_force};
      set.normal_known = true;
      closed.sets.push_back(set);
    }
    closed.at.push_back(&s);
    if (s.axial) closed.rows = 3;
  }
  return closed;
}

void put(ClosedContacts& closed, const ContactVector& forces,
         const std::array<bool, kMaxContacts>& sticks) {
  for (std::size_t k = 0; k < closed.at.size(); ++k) {
    closed.at[k]->force.head(closed.rows) = forces.segment(closed.row(k), closed.rows);
    closed.at[k]->sticks = sticks[k];
  }
}

// Accelerations of the contacts under their forces, with constraints.
class ForceResponse final : public ContactResponse {
 public:
  ForceResponse(ConstraintProbe& probe, const ClosedContacts& closed)
      : probe_(probe), closed_(closed) {}
  ContactVector at(const ContactVector& p) override {
    probe_.solve([&](mjtNum* force) {
      for (std::size_t k = 0; k < closed_.at.size(); ++k) {
        const Eigen::Index row = closed_.row(k);
        closed_.at[k]->for_each_load(
            {p[row], p[row + 1], closed_.rows == 3 ? p[row + 2] : 0.0},
            [&](const ContactSpace& at, const Eigen::Vector3d& load) { at.add_load(load, force); });
      }
    });
    ContactVector y(closed_.row(closed_.at.size()));
    const auto found = [this](const ContactSpace& at) { return probe_.acceleration(at); };
    for (std::size_t k = 0; k < closed_.at.size(); ++k) {
      const CoulombContact& s = *closed_.at[k];
      y.segment(closed_.row(k), closed_.rows) =
          (s.base + s.contact_rates(found)).head(closed_.rows);
    }
    return y;
  }
  double accuracy() const override { return probe_.accuracy(); }

 private:
  ConstraintProbe& probe_;
  const ClosedContacts& closed_;
};

// Warns once and not in every step.
void note_status(const ClosedContacts& closed, bool converged, const mjModel* m, mjData* d) {
  const auto warned = [d](const CoulombContact* s) {
    return ContactStatus(s->entries(d).status).status() != Status::kOk;
  };
  const bool known = std::any_of(closed.at.begin(), closed.at.end(), warned);
  if (!converged && !known) warn_unsolved(m, d, *closed.at[0]->plane);
  for (const CoulombContact* s : closed.at) {
    ContactStatus(s->entries(d).status).set_status(converged ? Status::kOk : Status::kNoSolution);
  }
}

// Lets MuJoCo's solver start from its solution, where the contacts' forces change the acceleration.
void start_solver_from(const mjtNum* change, const mjModel* m, mjData* d) {
  const int nv = count(m->nv);
  if (std::all_of(change, change + nv, [](mjtNum x) { return x == 0.0; })) return;
  StackFrame room(d);
  mjtNum* smooth = room.numbers(nv);
  mj_solveM(m, d, smooth, d->qfrc_smooth, 1);
  for (int i = 0; i < nv; ++i) {
    if (change[i] != 0.0) d->qacc_warmstart[i] = smooth[i] + change[i];
  }
}

void solve_free(CoulombContacts& contacts, const mjModel* m, mjData* d) {
  const auto response = [d](const ContactSpace& at) { return at.response(d->qfrc_smooth); };
  for (CoulombContact& s : contacts) look(s, contacts.size() > 1, response, m, d);
  ClosedContacts closed = closed_contacts(contacts);
  if (!closed.at.empty()) {
    ContactVector b(closed.row(closed.at.size()));
    for (std::size_t k = 0; k < closed.at.size(); ++k) {
      b.segment(closed.row(k), closed.rows) = closed.at[k]->free.head(closed.rows);
    }
    const CoupledSolution s = closed.sets.empty()
                                  ? solve_coupled_coulomb(closed.matrix(), b, closed.laws)
                                  : solve_coupled(closed.matrix(), b, closed.sets);
    if (s.solutions > 0) put(closed, s.p, s.sticks);
  }
  StackFrame room(d);
  mjtNum* acceleration = room.numbers(count(m->nv));
  mju_zero(acceleration, count(m->nv));
  for (const CoulombContact& s : contacts) {
    if (s.force.x() > 0.0) s.add_acceleration(acceleration);
  }
  const auto rates = [acceleration](const ContactSpace& at) -> Eigen::Vector3d {
    return at.smooth() + at.rates(acceleration);
  };
  set_references(contacts, rates, d);
  start_solver_from(acceleration, m, d);
}

// The same with constraints that act on the bodies. The contacts' own rows are kept inactive during
// the trials. The solver's final result then obeys J a = aref - R l.
void solve_with_constraints(CoulombContacts& contacts, const mjModel* m, mjData* d) {
  constexpr double kInactive = -1e12;  // m/s^2
  for (const CoulombContact& s : contacts) {
    if (s.row != kNoRow) d->efc_aref[s.row] = kInactive;
  }
  ConstraintProbe probe(m, d);
  probe.solve([](mjtNum*) {});
  const auto free = [&probe](const ContactSpace& at) { return probe.acceleration(at); };
  for (CoulombContact& s : contacts) look(s, contacts.size() > 1, free, m, d);
  ClosedContacts closed = closed_contacts(contacts);
  if (!closed.at.empty()) {
    ForceResponse response(probe, closed);
    const ContactVector none = ContactVector::Zero(closed.row(closed.at.size()));
    const ConstrainedContact found =
        solve_constrained(response, response.at(none), closed.matrix(), closed.laws);
    if (found.solved) put(closed, found.p, found.sticks);
    note_status(closed, found.converged, m, d);
    response.at(found.solved ? found.p : none);
  }
  set_references(
      contacts, [d](const ContactSpace& at) { return at.rates(d->qacc); }, d);
  const auto is_loaded = [](const CoulombContact& s) { return s.force.x() > 0.0; };
  if (std::any_of(contacts.begin(), contacts.end(), is_loaded)) probe.keep();
}

// True if a further contact, which MuJoCo's solver does not contain, is near enough to be detected.
bool is_detected(const ContactPair& pair, const ContactPlace& place, const mjModel* m) {
  const double delta = place.d.norm();
  return contact_enabled(m) && delta > kNoNormal &&
         pair.contact.clearance - delta < detected_below(m, pair.pair);
}

void note(const CoulombContact& s, mjData* d) {
  ContactEntries& entry = s.entries(d);
  record_forces(entry, mode_of(s.force.x(), s.sticks), s.force.x(), s.force.y());
  if (s.axial) note_contact(d, s.pair->userdata, s.e_r, s.force.z());
}

}  // namespace

void apply_coulomb(const Config& config, const mjModel* m, mjData* d, PassMotion& motion) {
  std::optional<ContactSpaces> spaces;
  CoulombContacts contacts;
  ContactList<int> own;  // their rows
  for (const ContactPair& pair : config.pairs) {
    if (pair.contact_model == scene::ContactModel::kRigid) continue;
    ContactEntries& entry = contact_entries(pair, d);
    entry.normal_force = entry.friction_force = 0.0;
    const mjContact* contact = find_contact(pair, d);
    ContactPlace place = motion.of(pair).place();
    if (pair.further) place.d = separation(config.model, Coordinates(config, d).q(), pair.bearing);
    const bool detected = pair.further ? is_detected(pair, place, m) : contact != nullptr;
    if (!detected) entry.mode = 0.0;
    if (!detected && pair.contact.is_compliant()) pass_without_contact(pair, m, d);
    if (!detected || pair.contact_model != scene::ContactModel::kCoulomb) continue;
    if (contacts.empty()) {
      update_smooth_force(m, d);
      spaces.emplace(config, m, d);
    }
    const int row = pair.further ? kNoRow : contact->efc_address;
    own.push_back(row);
    const ContactSpaces::PairSpaces at = spaces->add(pair, place);
    contacts.push_back(coulomb_contact(pair, place, motion.of(pair).turning(), at, m, d, row));
  }
  if (contacts.empty()) return;
  bool constrained = false;
  for (const CoulombContact& s : contacts) {
    constrained = constrained || constraints_couple(m, d, *s.plane, own) ||
                  (s.axial && constraints_couple(m, d, *s.axial, own));
  }
  // The force of a compliant contact is known, whatever constraints act on its bodies.
  if (constrained && !contacts[0].compliant_force) {
    mj_fwdAcceleration(m, d);
    solve_with_constraints(contacts, m, d);
  } else {
    solve_free(contacts, m, d);
  }
  for (const CoulombContact& s : contacts) {
    note(s, d);
    if (s.force.x() > 0.0) s.add_remainder(d->qfrc_passive);
  }
}

}  // namespace rotorub::plugin
