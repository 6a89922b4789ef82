#include "plugin/own/coupled_step.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "native_model/contact/kinematics.h"
#include "plugin/contact/constrained_law.h"
#include "plugin/contact/constraint_probe.h"
#include "plugin/contact/memory.h"
#include "plugin/passes.h"

namespace rotorub::plugin {
namespace {

using Columns = Eigen::Matrix<double, 3, 2>;

// W_N and W_T as columns: the loads (x, y, torque) of a normal and of a friction impulse of 1.
Columns columns(const Eigen::Vector2d& e_r, double radius) {
  Columns w;
  w.col(0) = contact_load(e_r, radius, 1.0, 0.0);
  w.col(1) = contact_load(e_r, radius, 0.0, 1.0);
  return w;
}

// A contact of the step that is being solved.
struct Closing {
  bool closed = false;
  bool impact = false;              // by itself: it was open, and its rebound outlives the step
  Columns w;
  Eigen::Vector2d e_r;
  Eigen::Vector2d lasting, sudden;  // N s, (normal, friction) of the two parts
  Eigen::Vector3d end;              // rates at the end of the step with all impulses so far
  RigidResult result;
};

class CoupledStep {
 public:
  CoupledStep(const mjModel* m, mjData* d, std::span<CoupledMember* const> members,
              ConstraintProbe* probe)
      : d_(d), members_(members), probe_(probe), h_(m->opt.timestep) {
    for (Closing& c : contacts_) c.lasting = c.sudden = Eigen::Vector2d::Zero();
    find_ends();
    for (std::size_t i = 0; i < size(); ++i) {
      RigidStep& step = members_[i]->step;
      step.free = contacts_[i].end;
      contacts_[i].closed = reaches_ring(step, members_[i]->contact->clearance);
    }
  }

  void solve() {
    // Each round closes one more, or is the last.
    for (std::size_t round = 0; round <= size() && any_closed(); ++round) {
      if (!solve_closed()) {
        give_none();
        return;
      }
      if (!close_driven()) break;
    }
  }

  bool converged() const { return converged_; }
  const RigidResult& result(std::size_t i) const { return contacts_[i].result; }

  // The step with all impulses is what the pass will find.
  void keep() {
    if (!probe_ || !any_closed()) return;
    find_ends();
    probe_->keep();
  }
  void add_forces(mjtNum* to) const {
    for (std::size_t i = 0; i < size(); ++i) {
      const Closing& c = contacts_[i];
      if (!c.closed) continue;
      if (!c.lasting.isZero(0.0)) members_[i]->space->add_load(c.w * c.lasting / h_, to);
      if (!c.sudden.isZero(0.0)) members_[i]->space->add_impact(c.w * c.sudden / h_, to);
    }
  }

 private:
  // Those of the contacts that one part of the step is solved for, in the order of its vectors.
  struct Subset {
    std::array<std::size_t, kMaxPairs> index{};
    std::size_t count = 0;
    bool impact = false;
    std::array<double, kMaxPairs> offset{};  // m/s, of the normal law
  };

  std::size_t size() const { return members_.size(); }
  bool any_closed() const {
    return std::any_of(contacts_.begin(), contacts_.begin() + static_cast<std::ptrdiff_t>(size()),
                       [](const Closing& c) { return c.closed; });
  }

  // What was found of a step without a solution is its status.
  void give_none() {
    for (Closing& c : contacts_) {
      const Status status = c.result.status;
      c.lasting = c.sudden = Eigen::Vector2d::Zero();
      c.result = {};
      c.result.status = status;
      c.result.converged = converged_;
    }
  }

  // Rates at the end of the step, with the impulses as they are.
  void find_ends() {
    if (probe_) probe_->solve([this](mjtNum* force) { add_forces(force); });
    for (std::size_t i = 0; i < size(); ++i) {
      const CoupledMember& at = *members_[i];
      if (probe_) {
        contacts_[i].end = at.step.start + h_ * probe_->acceleration(*at.space);
        continue;
      }
      Eigen::Vector3d end = at.step.start + h_ * at.space->response(d_->qfrc_smooth);
      for (std::size_t j = 0; j < size(); ++j) {
        const Closing& other = contacts_[j];
        if (!other.closed) continue;
        const ContactSpace& space = *members_[j]->space;
        if (!other.lasting.isZero(0.0)) {
          end += at.space->flexibility(space) * (other.w * other.lasting);
        }
        if (!other.sudden.isZero(0.0)) end += at.space->admittance(space) * (other.w * other.sudden);
      }
      contacts_[i].end = end;
    }
  }

  // (gap rate + offset, slip) of a subset.
  ContactVector rates(const Subset& s) const {
    ContactVector y(2 * static_cast<Eigen::Index>(s.count));
    for (std::size_t k = 0; k < s.count; ++k) {
      const Closing& c = contacts_[s.index[k]];
      const auto row = static_cast<Eigen::Index>(2 * k);
      y.segment<2>(row) = c.w.transpose() * c.end;
      y[row] += s.offset[k];
    }
    return y;
  }

  ContactMatrix matrix(const Subset& s) const {
    const auto n = static_cast<Eigen::Index>(s.count);
    ContactMatrix a(2 * n, 2 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        const std::size_t one = s.index[static_cast<std::size_t>(i)];
        const std::size_t two = s.index[static_cast<std::size_t>(j)];
        const ContactSpace &at = *members_[one]->space, &other = *members_[two]->space;
        const Eigen::Matrix3d g = s.impact ? at.admittance(other) : at.flexibility(other);
        a.block<2, 2>(2 * i, 2 * j) = contacts_[one].w.transpose() * g * contacts_[two].w;
      }
    }
    return 0.5 * (a + a.transpose());
  }

  void put(const Subset& s, const ContactVector& p) {
    for (std::size_t k = 0; k < s.count; ++k) {
      Closing& c = contacts_[s.index[k]];
      (s.impact ? c.sudden : c.lasting) = p.segment<2>(static_cast<Eigen::Index>(2 * k));
    }
  }

  // The step's answer to impulses of a subset, for those whom constraints hold.
  class Response final : public ContactResponse {
   public:
    Response(CoupledStep& step, const Subset& subset) : step_(step), subset_(subset) {}
    ContactVector at(const ContactVector& p) override {
      step_.put(subset_, p);
      step_.find_ends();
      return step_.rates(subset_);
    }
    double accuracy() const override { return step_.h_ * step_.probe_->accuracy(); }

   private:
    CoupledStep& step_;
    const Subset& subset_;
  };

  // Puts the impulses of the subset; which of them stick. False: no solution, or several.
  bool solve_subset(const Subset& s, std::array<bool, kMaxPairs>& sticks) {
    const ContactMatrix a = matrix(s);
    const ContactVector free = rates(s);
    std::array<double, kMaxPairs> frictions{};
    std::array<ImpactLaw, kMaxPairs> laws{};
    std::array<ContactSet, kMaxPairs> sets{};
    for (std::size_t k = 0; k < s.count; ++k) {
      const ContactParameters& c = *members_[s.index[k]]->contact;
      frictions[k] = sets[k].friction = c.friction;
      laws[k] = {c.friction, c.restitution, c.tangential_restitution};
    }
    if (probe_) {
      Response response(*this, s);
      const ConstrainedContact found =
          s.impact ? solve_constrained_impact(response, free, a, std::span(laws).first(s.count))
                   : solve_constrained(response, free, a, std::span(frictions).first(s.count));
      converged_ = converged_ && found.converged;
      if (!found.solved || !found.converged) set_status(s, Status::kNoSolution);
      sticks = found.sticks;
      put(s, found.solved ? found.p : ContactVector::Zero(free.size()));
      return found.solved;
    }
    const CoupledSolution found =
        s.impact ? solve_coupled_impact(a, free, std::span(laws).first(s.count))
                 : solve_coupled(a, free, std::span(sets).first(s.count));
    if (found.solutions != 1) {
      set_status(s, found.solutions == 0 ? Status::kNoSolution : Status::kAmbiguous);
      return false;
    }
    sticks = found.sticks;
    put(s, found.p);
    return true;
  }

  void set_status(const Subset& s, Status status) {
    for (std::size_t k = 0; k < s.count; ++k) contacts_[s.index[k]].result.status = status;
  }

  bool solve_closed() {
    Subset lasting, all;
    for (std::size_t i = 0; i < size(); ++i) {
      Closing& c = contacts_[i];
      c.lasting = c.sudden = Eigen::Vector2d::Zero();
      c.result = {};
      if (!c.closed) continue;
      const CoupledMember& at = *members_[i];
      c.e_r = c.result.e_r = contact_normal(at.step, at.contact->clearance);
      c.w = columns(c.e_r, at.contact->radius);
      c.impact = is_impact(at.step, c.e_r, *at.contact);
    }
    find_ends();
    for (std::size_t i = 0; i < size(); ++i) {
      Closing& c = contacts_[i];
      if (!c.closed || c.impact) continue;
      lasting.offset[lasting.count] = offset(i);
      lasting.index[lasting.count++] = i;
    }
    std::array<bool, kMaxPairs> sticks{};
    if (lasting.count > 0) {
      if (!solve_subset(lasting, sticks)) return false;
      find_ends();
      for (std::size_t k = 0; k < lasting.count; ++k) {
        Closing& c = contacts_[lasting.index[k]];
        if (c.lasting.x() > 0.0) c.result.mode = sticks[k] ? Mode::kStick : Mode::kSlide;
      }
    }
    bool impacts = false;
    all.impact = true;
    for (std::size_t i = 0; i < size(); ++i) {
      Closing& c = contacts_[i];
      if (!c.closed) continue;
      // What the lasting contacts hold back has no blow in this step.
      if (c.impact && !reaches_ring(ended(i), members_[i]->contact->clearance)) continue;
      impacts = impacts || c.impact;
      all.offset[all.count] = c.impact ? 0.0 : offset(i);
      all.index[all.count++] = i;
    }
    if (impacts && !solve_impacts(all)) return false;
    for (std::size_t i = 0; i < size(); ++i) {
      Closing& c = contacts_[i];
      c.result.converged = converged_;
      c.result.normal = c.lasting.x() + c.sudden.x();
      c.result.friction = c.lasting.y() + c.sudden.y();
    }
    return true;
  }

  bool solve_impacts(const Subset& s) {
    const ContactVector before = rates(s);
    std::array<bool, kMaxPairs> sticks{};
    if (!solve_subset(s, sticks)) return false;
    find_ends();
    const ContactVector after = rates(s);
    for (std::size_t k = 0; k < s.count; ++k) {
      Closing& c = contacts_[s.index[k]];
      if (!(c.sudden.x() > 0.0)) continue;
      const auto row = static_cast<Eigen::Index>(2 * k);
      // A lasting contact that the blow has not opened lasts.
      const double changed = std::abs(after[row]) + before.cwiseAbs().maxCoeff();
      if (!c.impact && after[row] <= 1e-9 * changed) {
        c.result.mode = sticks[k] ? Mode::kStick : Mode::kSlide;
        continue;
      }
      c.result.mode = Mode::kFree;
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
    return gap_over_step(step, *members_[i]->contact) + contacts_[i].e_r.dot(step.free.head<2>());
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
      if (c.closed || !reaches_ring(ended(i), members_[i]->contact->clearance)) continue;
      c.closed = any = true;
    }
    return any;
  }

  mjData* d_;
  std::span<CoupledMember* const> members_;
  ConstraintProbe* probe_;
  double h_;
  bool converged_ = true;
  std::array<Closing, kMaxPairs> contacts_;
};

void note_results(const CoupledStep& step, const mjModel* m, mjData* d,
                  std::span<CoupledMember* const> members) {
  const CoupledMember* held = nullptr;
  bool warned = false;
  for (std::size_t i = 0; i < members.size(); ++i) {
    ContactMemory memory(d, members[i]->data);
    warned = warned || memory.warned();
    if (members[i]->held) held = members[i];
    memory.note(step.result(i), m->opt.timestep);
  }
  if (!step.converged() && held && !warned) warn_unsolved(m, d, *held->space);
}

}  // namespace

bool moves_with(const CoupledMember& a, const CoupledMember& b) {
  if (a.held && b.held) return true;
  return !a.space->admittance(*b.space).isZero(0.0);
}

void apply_coupled_step(const mjModel* m, mjData* d, std::span<CoupledMember* const> members) {
  for (CoupledMember* at : members) at->step.was_in_contact = ContactMemory(d, at->data).was_in_contact();
  if (!contact_enabled(m)) {
    for (const CoupledMember* at : members) ContactMemory(d, at->data).note({}, m->opt.timestep);
    return;
  }
  const bool held = std::any_of(members.begin(), members.end(),
                                [](const CoupledMember* at) { return at->held; });
  std::optional<ConstraintProbe> probe;
  if (held) {
    mj_fwdAcceleration(m, d);
    probe.emplace(m, d);
  }
  CoupledStep step(m, d, members, held ? &*probe : nullptr);
  step.solve();
  step.keep();
  probe.reset();
  note_results(step, m, d, members);
  step.add_forces(d->qfrc_passive);
}

}  // namespace rotorub::plugin
