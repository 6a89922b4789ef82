#include "plugin/contact/coupled_step.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "plugin/contact/constraint_probe.h"
#include "plugin/contact/coupled_contacts.h"

namespace rotorub::plugin {
namespace {

class CoupledStep {
 public:
  CoupledStep(const mjModel* m, mjData* d, std::span<CoupledMember* const> members,
              ConstraintProbe* probe)
      : members_(members), probe_(probe), contacts_(m, d, members, probe) {
    contacts_.find_ends();
    for (std::size_t i = 0; i < size(); ++i) {
      RigidStep& step = members_[i]->step;
      step.free = contacts_[i].end;
      contacts_[i].closed = reaches_ring(step, members_[i]->pair->contact.clearance);
    }
  }

  void solve() {
    // Each round closes one more, or is the last.
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
    }
    if (!probe_ || !contacts_.any_closed()) return;
    // The step with all impulses is what the pass will find.
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
    if (find_blow(all) && !solve_impacts(all)) return false;
    for (std::size_t i = 0; i < size(); ++i) {
      Closing& c = contacts_[i];
      c.result.converged = contacts_.converged();
      c.result.normal = c.lasting.x() + c.sudden.x();
      c.result.friction = c.lasting.y() + c.sudden.y();
    }
    return true;
  }

  // No impulses; where the closed contacts are, and which of them are impacts.
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

  // Those that take part in the blows of the step. False: there are none.
  bool find_blow(ContactSubset& all) const {
    bool impacts = false;
    all.impact = true;
    for (std::size_t i = 0; i < size(); ++i) {
      const Closing& c = contacts_[i];
      if (!c.closed) continue;
      // What the lasting contacts hold back has no blow in this step.
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
      // A lasting contact that the blow has not opened lasts.
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

  // y_N less gdot_N of a lasting contact.
  double offset(std::size_t i) const {
    const RigidStep step = ended(i);
    return gap_over_step(step, members_[i]->pair->contact) +
           contacts_[i].rows.e_r.dot(step.free.head<2>());
  }

  // The step with the impulses so far in `free`.
  RigidStep ended(std::size_t i) const {
    RigidStep step = members_[i]->step;
    step.free = contacts_[i].end;
    return step;
  }

  // Closes those that end outside their ring all the same. False: none.
  bool close_driven() {
    bool any = false;
    for (std::size_t i = 0; i < size(); ++i) {
      Closing& c = contacts_[i];
      if (c.closed || !reaches_ring(ended(i), members_[i]->pair->contact.clearance)) continue;
      c.closed = any = true;
    }
    return any;
  }

  std::span<CoupledMember* const> members_;
  ConstraintProbe* probe_;
  CoupledContacts contacts_;
};

}  // namespace

void apply_coupled_step(const mjModel* m, mjData* d, std::span<CoupledMember* const> members,
                        mjtNum* to) {
  const bool held =
      std::any_of(members.begin(), members.end(), [](const CoupledMember* at) { return at->held; });
  std::optional<ConstraintProbe> probe;
  if (held) {
    mj_fwdAcceleration(m, d);
    probe.emplace(m, d);
  }
  CoupledStep step(m, d, members, held ? &*probe : nullptr);
  step.solve();
  probe.reset();
  step.add_forces(to);
}

}  // namespace rotorub::plugin
