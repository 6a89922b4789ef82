#include "plugin/contact/rigid_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "plugin/contact/constraint_probe.h"

namespace rotorub::plugin {
namespace {

// False if no impulse of the contact opens its gap, because nothing moves along the normal.
bool can_open(const RigidContact& at) {
  constexpr double kNothing = 1e-12;  // share of the whole flexibility
  const Eigen::Vector2d e_r = contact_normal(at.step, at.pair->contact.clearance);
  const Eigen::Matrix2d g = at.space->flexibility().topLeftCorner<2, 2>();
  return e_r.dot(g * e_r) > kNothing * g.trace();
}

class RigidSolver {
 public:
  RigidSolver(const mjModel* m, mjData* d, std::span<RigidContact* const> members,
              ConstraintProbe* probe)
      : members_(members), probe_(probe), contacts_(m, d, members, probe) {
    contacts_.find_ends();
    for (std::size_t i = 0; i < size(); ++i) {
      members_[i]->step.free = contacts_[i].end;
      contacts_[i].closed = closes(i);
    }
  }

  void solve() {
    // Each round closes a further contact or is the last.
    for (std::size_t round = 0; round <= size() && contacts_.any_closed(); ++round) {
      if (!solve_closed()) {
        contacts_.give_none();
        break;
      }
      if (!close_driven()) break;
    }
    for (std::size_t i = 0; i < size(); ++i) {
      members_[i]->result = contacts_[i].result;
      members_[i]->axial_friction = contacts_[i].lasting.z() + contacts_[i].sudden.z();
      if (blocked_[i]) members_[i]->result.status = Status::kNoSolution;
    }
    if (!probe_ || !contacts_.any_closed()) return;
    // The forward pass will find the step with all impulses.
    contacts_.find_ends();
    probe_->keep();
  }
  void add_forces(mjtNum* to) const { contacts_.add_forces(to); }

 private:
  std::size_t size() const { return members_.size(); }

  bool solve_closed() {
    start_over();
    if (!solve_lasting()) return false;
    ContactSubset all;
    if (find_impacts(all) && !solve_impacts(all)) return false;
    for (std::size_t i = 0; i < size(); ++i) {
      Closing& c = contacts_[i];
      c.result.converged = contacts_.converged();
      c.result.normal = c.lasting.x() + c.sudden.x();
      c.result.friction = c.lasting.y() + c.sudden.y();
    }
    return true;
  }

  // Takes all impulses back, and finds the normals of the closed contacts and which are impacts.
  void start_over() {
    for (std::size_t i = 0; i < size(); ++i) {
      Closing& c = contacts_[i];
      c.lasting = c.sudden = Eigen::Vector3d::Zero();
      c.result = {};
      if (!c.closed) continue;
      const RigidStep& step = members_[i]->step;
      const ContactParameters& contact = members_[i]->pair->contact;
      c.rows.e_r = c.result.e_r = contact_normal(step, contact.clearance);
      c.impact = is_impact(step, c.rows.e_r, contact);
    }
    contacts_.find_ends();
  }

  bool solve_lasting() {
    ContactSubset lasting;
    for (std::size_t i = 0; i < size(); ++i) {
      if (!contacts_[i].closed || contacts_[i].impact) continue;
      lasting.offset[lasting.count] = offset(i);
      lasting.index[lasting.count++] = i;
    }
    if (lasting.count == 0) return true;
    SubsetSolution found;
    if (!contacts_.solve(lasting, found)) return false;
    contacts_.find_ends();
    for (std::size_t k = 0; k < lasting.count; ++k) {
      Closing& c = contacts_[lasting.index[k]];
      c.result.mode = mode_of(c.lasting.x(), found.sticks[k]);
    }
    return true;
  }

  // Finds the contacts that take part in the impacts of the step. False: there is no impact.
  bool find_impacts(ContactSubset& all) const {
    bool impacts = false;
    all.impact = true;
    for (std::size_t i = 0; i < size(); ++i) {
      const Closing& c = contacts_[i];
      if (!c.closed) continue;
      // A contact that the lasting ones keep off its ring has no impact in this step.
      if (c.impact && !reaches_ring(ended(i), members_[i]->pair->contact.clearance)) continue;
      impacts = impacts || c.impact;
      all.offset[all.count] = c.impact ? 0.0 : offset(i);
      all.index[all.count++] = i;
    }
    return impacts;
  }

  bool solve_impacts(const ContactSubset& s) {
    const ContactVector before = contacts_.rates(s);
    SubsetSolution found;
    if (!contacts_.solve(s, found)) return false;
    contacts_.find_ends();
    const ContactVector after = found.after.size() > 0 ? found.after : contacts_.rates(s);
    for (std::size_t k = 0; k < s.count; ++k) {
      Closing& c = contacts_[s.index[k]];
      if (!(c.sudden.x() > 0.0)) continue;
      const Eigen::Index row = contacts_.rows() * static_cast<Eigen::Index>(k);
      // A lasting contact that the impact does not open goes on.
      const double changed = std::abs(after[row]) + before.cwiseAbs().maxCoeff();
      if (!c.impact && after[row] <= 1e-9 * changed) {
        c.result.mode = mode_of(c.sudden.x(), found.sticks[k]);
        continue;
      }
      c.result.mode = found.lasts[k] ? mode_of(c.sudden.x(), found.sticks[k]) : Mode::kFree;
      c.result.impact = true;
      c.result.gap_rate_before = before[row] - s.offset[k];
      c.result.slip_before = before[row + 1];
      c.result.gap_rate_after = after[row] - s.offset[k];
      c.result.slip_after = after[row + 1];
    }
    return true;
  }

  // m/s, y_N of (12) less the gap rate, for a lasting contact.
  double offset(std::size_t i) const {
    const RigidStep step = ended(i);
    return gap_over_step(step, members_[i]->pair->contact) +
           contacts_[i].rows.e_r.dot(step.free.head<2>());
  }

  // The step of contact i, with `free` including the impulses so far.
  RigidStep ended(std::size_t i) const {
    RigidStep step = members_[i]->step;
    step.free = contacts_[i].end;
    return step;
  }

  // True if contact i would end outside its ring and has an impulse against that.
  bool closes(std::size_t i) {
    if (!reaches_ring(ended(i), members_[i]->pair->contact.clearance)) return false;
    blocked_[i] = !can_open(*members_[i]);
    return !blocked_[i];
  }

  // Closes the contacts that the impulses drive out of their rings. False: there is none.
  bool close_driven() {
    bool any = false;
    for (std::size_t i = 0; i < size(); ++i) {
      Closing& c = contacts_[i];
      if (!c.closed && closes(i)) c.closed = any = true;
    }
    return any;
  }

  std::span<RigidContact* const> members_;
  ConstraintProbe* probe_;
  RigidContacts contacts_;
  std::array<bool, kMaxContacts> blocked_{};  // no impulse opens their gap
};

}  // namespace

void solve_rigid_contacts(const mjModel* m, mjData* d, std::span<RigidContact* const> contacts,
                          mjtNum* to) {
  const bool held = std::any_of(contacts.begin(), contacts.end(),
                                [](const RigidContact* at) { return at->held; });
  std::optional<ConstraintProbe> probe;
  if (held) {
    mj_fwdAcceleration(m, d);
    probe.emplace(m, d);
  }
  RigidSolver solver(m, d, contacts, held ? &*probe : nullptr);
  solver.solve();
  probe.reset();
  solver.add_forces(to);
}

}  // namespace rotorub::plugin
