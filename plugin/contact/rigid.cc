#include "plugin/contact/rigid.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "native_model/scene/mujoco.h"
#include "plugin/contact/constraint_probe.h"
#include "plugin/contact/contact_memory.h"
#include "plugin/contact/contact_space.h"
#include "plugin/contact/relative_motion.h"
#include "plugin/contact/rigid_contacts.h"
#include "plugin/model/actuators.h"
#include "plugin/model/options.h"

namespace rotorub::plugin {
namespace {

// False if no impulse of the contact opens its gap, because nothing moves along the normal.
bool can_open(const RigidContact& at) {
  constexpr double kNothing = 1e-12;  // share of the whole admittance
  const Eigen::Vector2d e_r = contact_normal(at.step, at.pair->contact.clearance);
  const Eigen::Matrix2d g = at.rows.plane->step_admittance().topLeftCorner<2, 2>();
  return e_r.dot(g * e_r) > kNothing * g.trace();
}

// Contacts that act on the same bodies (two rings on one shaft), over one step of MuJoCo. They are
// one problem (native_model/contact/coupled_law.h), which has a closed form for one contact.
//
// A step has two parts. First come the lasting contacts, (12)-(13), together over the step. Then
// come the impacts, in no time, with the velocities that the first part leaves: (15)-(19) for all
// closed contacts at once, because a lasting contact takes part in an impact elsewhere on its
// shaft. With constraints the forces of the step may then close a gap again (constrained_law.h). If
// the impulses drive the rotor into a further ring, that contact is closed too and the step is
// solved again.
class RigidSolver {
 public:
  RigidSolver(const mjModel* m, mjData* d, std::span<RigidContact* const> members,
              ConstraintProbe* probe)
      : members_(members), probe_(probe), contacts_(m, d, members, probe) {
    contacts_.update_ends();
    for (RigidContact* c : members_) {
      c->step.free = c->end;
      c->closed = closes(*c);
    }
  }

  void solve() {
    // Each round closes a further contact or is the last.
    for (std::size_t round = 0; round <= members_.size() && contacts_.any_closed(); ++round) {
      if (!solve_closed()) {
        contacts_.clear_impulses();
        break;
      }
      if (!close_driven()) break;
    }
    for (RigidContact* c : members_) {
      if (c->blocked) c->result.status = Status::kNoSolution;
    }
    if (!probe_ || !contacts_.any_closed()) return;
    // The forward pass will find the step with all impulses.
    contacts_.update_ends();
    probe_->keep();
  }
  void add_forces(mjtNum* to) const { contacts_.add_forces(to); }

 private:
  bool solve_closed() {
    start_over();
    if (!solve_lasting()) return false;
    ContactSubset all;
    if (find_impacts(all) && !solve_impacts(all)) return false;
    for (RigidContact* c : members_) {
      c->result.converged = contacts_.converged();
      c->result.normal = c->lasting_impulse.x() + c->impact_impulse.x();
      c->result.friction = c->lasting_impulse.y() + c->impact_impulse.y();
    }
    return true;
  }

  // Resets all impulses, and finds the normals of the closed contacts and which of them are
  // impacts.
  void start_over() {
    for (RigidContact* c : members_) {
      c->lasting_impulse = c->impact_impulse = Eigen::Vector3d::Zero();
      c->result = {};
      if (!c->closed) continue;
      const ContactParameters& contact = c->pair->contact;
      c->rows.e_r = c->result.e_r = contact_normal(c->step, contact.clearance);
      c->impact = is_impact(c->step, c->rows.e_r, contact);
    }
    contacts_.update_ends();
  }

  bool solve_lasting() {
    ContactSubset lasting;
    for (RigidContact* c : members_) {
      if (c->closed && !c->impact) lasting.members.push_back({c, offset(*c)});
    }
    if (lasting.members.empty()) return true;
    SubsetSolution found;
    if (!contacts_.solve(lasting, found)) return false;
    contacts_.update_ends();
    for (std::size_t k = 0; k < lasting.members.size(); ++k) {
      RigidContact& c = *lasting.members[k].at;
      c.result.mode = mode_of(c.lasting_impulse.x(), found.sticks[k]);
    }
    return true;
  }

  // Finds the contacts that take part in the impacts of the step. False: there is no impact.
  bool find_impacts(ContactSubset& all) const {
    bool impacts = false;
    all.impact = true;
    for (RigidContact* c : members_) {
      if (!c->closed) continue;
      // A contact that the lasting ones keep off its ring has no impact in this step.
      if (c->impact && !reaches_ring(ended(*c), c->pair->contact.clearance)) continue;
      impacts = impacts || c->impact;
      all.members.push_back({c, c->impact ? 0.0 : offset(*c)});
    }
    return impacts;
  }

  bool solve_impacts(const ContactSubset& s) {
    const ContactVector before = contacts_.rates(s);
    SubsetSolution found;
    if (!contacts_.solve(s, found)) return false;
    contacts_.update_ends();
    const ContactVector after = found.after.size() > 0 ? found.after : contacts_.rates(s);
    for (std::size_t k = 0; k < s.members.size(); ++k) {
      RigidContact& c = *s.members[k].at;
      if (!(c.impact_impulse.x() > 0.0)) continue;
      const Eigen::Index row = contacts_.row(k);
      // A lasting contact that the impact does not open goes on.
      const double changed = std::abs(after[row]) + before.cwiseAbs().maxCoeff();
      if (!c.impact && after[row] <= 1e-9 * changed) {
        c.result.mode = mode_of(c.impact_impulse.x(), found.sticks[k]);
        continue;
      }
      c.result.mode =
          found.lasts[k] ? mode_of(c.impact_impulse.x(), found.sticks[k]) : ContactMode::kFree;
      c.result.impact = true;
      c.result.gap_rate_before = before[row] - s.members[k].offset;
      c.result.slip_before = before[row + 1];
      c.result.gap_rate_after = after[row] - s.members[k].offset;
      c.result.slip_after = after[row + 1];
    }
    return true;
  }

  // m/s, y_N of (12) less the gap rate, for a lasting contact.
  static double offset(const RigidContact& c) {
    const RigidStep step = ended(c);
    return gap_over_step(step, c.pair->contact) + c.rows.e_r.dot(step.free.head<2>());
  }

  // The step of the contact, with `free` including the impulses so far.
  static RigidStep ended(const RigidContact& c) {
    RigidStep step = c.step;
    step.free = c.end;
    return step;
  }

  // True if the contact would end outside its ring and has an impulse against that.
  static bool closes(RigidContact& c) {
    if (!reaches_ring(ended(c), c.pair->contact.clearance)) return false;
    c.blocked = !can_open(c);
    return !c.blocked;
  }

  // Closes the contacts that the impulses drive out of their rings. False: there is none.
  bool close_driven() {
    bool any = false;
    for (RigidContact* c : members_) {
      if (!c->closed && closes(*c)) c->closed = any = true;
    }
    return any;
  }

  std::span<RigidContact* const> members_;
  ConstraintProbe* probe_;
  RigidContacts contacts_;
};

// Finds the results and adds the impulses to d->qfrc_passive as forces over the step.
void solve_group(const mjModel* m, mjData* d, std::span<RigidContact* const> contacts) {
  const bool constrained = std::any_of(contacts.begin(), contacts.end(),
                                       [](const RigidContact* at) { return at->constrained; });
  std::optional<ConstraintProbe> probe;
  if (constrained) {
    mj_fwdAcceleration(m, d);
    probe.emplace(m, d);
  }
  RigidSolver solver(m, d, contacts, constrained ? &*probe : nullptr);
  solver.solve();
  probe.reset();
  solver.add_forces(d->qfrc_passive);
}

// True if an impulse of one may change the rates of the other.
bool moves_with(const RigidContact& a, const RigidContact& b) {
  if (a.constrained && b.constrained) return true;
  const auto answers = [](const ContactSpace* at, const ContactSpace* to) {
    return at && to && !at->step_admittance(*to).isZero(0.0);
  };
  return answers(a.rows.plane, b.rows.plane) || answers(a.rows.plane, b.rows.axial) ||
         answers(a.rows.axial, b.rows.plane) || answers(a.rows.axial, b.rows.axial);
}

// Takes the first contact out of `left`, and all contacts coupled to it, directly or through
// others, because their bodies are in one tree or constraints act on them.
ContactList<RigidContact*> take_group(ContactList<RigidContact*>& left) {
  ContactList<RigidContact*> group, rest;
  for (RigidContact* c : left) (group.empty() ? group : rest).push_back(c);
  for (std::size_t k = 0; k < group.size(); ++k) {
    left = rest;
    rest.clear();
    for (RigidContact* c : left) (moves_with(*group[k], *c) ? group : rest).push_back(c);
  }
  left = rest;
  return group;
}

void note_results(const mjModel* m, mjData* d, std::span<RigidContact* const> group) {
  const double h = m->opt.timestep;
  const RigidContact* unsolved = nullptr;
  bool warned = false;
  for (const RigidContact* at : group) {
    ContactMemory memory(d, *at->pair, h);
    warned = warned || memory.warned();
    if (at->constrained && !at->result.converged) unsolved = at;
    memory.note(at->result, at->step.d.norm());
    if (!at->rows.axial) continue;
    note_contact(d, at->pair->userdata, at->result.e_r,
                 (at->lasting_impulse.z() + at->impact_impulse.z()) / h);
  }
  if (unsolved && !warned) warn_unsolved(m, d, *unsolved->rows.plane);
}

// Solves all contacts that face each other, in a step in which at least one may close.
void solve_facing(const Config& config, const ContactList<const ContactPair*>& pairs,
                  const mjModel* m, mjData* d, PassMotion& motion) {
  const double h = m->opt.timestep;
  ContactSpaces spaces(config, m, d);
  ContactList<RigidContact> members;
  ContactList<RigidContact*> left;
  for (const ContactPair* pair : pairs) {
    const ContactPlace& place = motion.of(*pair).place();
    const auto [plane, axial] = spaces.add(*pair, place);
    RigidContact c;
    c.pair = pair;
    c.rows = {plane, axial, {1.0, 0.0}, pair->contact.radius};
    c.step.h = h;
    c.step.d = place.d;
    c.step.bend = 0.5 * h * h * motion.of(*pair).turning();
    c.step.start = plane->rates(d->qvel);
    c.step.start.z() += pair->prescribed_spin;
    ContactMemory memory(d, *pair, h);
    memory.watch(place.d.norm());
    c.step.was_in_contact = memory.was_in_contact(place.d.norm());
    c.constrained = constraints_couple(m, d, *plane) || (axial && constraints_couple(m, d, *axial));
    if (axial) c.axial_start = axial->rates(d->qvel);
    members.push_back(c);
  }
  for (RigidContact& c : members) left.push_back(&c);
  while (!left.empty()) {
    const ContactList<RigidContact*> group = take_group(left);
    solve_group(m, d, group);
    note_results(m, d, group);
  }
}

}  // namespace

void apply_rigid(const Config& config, const mjModel* m, mjData* d, PassMotion& motion) {
  update_smooth_force(m, d);
  Reach reach(m, d);
  ContactList<const ContactPair*> facing;
  bool near = false;
  for (const ContactPair& pair : config.pairs) {
    if (pair.contact_model != scene::ContactModel::kRigid) continue;
    ContactMemory memory(d, pair, m->opt.timestep);
    if (!face_each_other(pair, motion.of(pair).place())) {
      memory.begin_anew();
      memory.note_open();
      continue;
    }
    facing.push_back(&pair);
    near = near || memory.was_in_contact() || reach.may_reach(pair, motion.of(pair));
  }
  if (near && contact_enabled(m)) {
    solve_facing(config, facing, m, d, motion);
    return;
  }
  for (const ContactPair* pair : facing) {
    ContactMemory memory(d, *pair, m->opt.timestep);
    // The rotor is well within its ring; the exact gap does not matter.
    if (!near) memory.watch(0.0);
    memory.note_open();
  }
}

}  // namespace rotorub::plugin
