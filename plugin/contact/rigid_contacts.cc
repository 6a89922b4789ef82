#include "plugin/contact/rigid_contacts.h"

#include <algorithm>
#include <cmath>

#include "native_model/contact/impact.h"

namespace rotorub::plugin {

// The response of the step to the impulses of a subset, beside constraints.
class RigidContacts::Response final : public ContactResponse {
 public:
  Response(RigidContacts& contacts, const ContactSubset& subset)
      : contacts_(contacts), subset_(subset) {}
  ContactVector at(const ContactVector& p) override {
    contacts_.put(subset_, p);
    contacts_.find_ends();
    return contacts_.rates(subset_);
  }
  ContactVector sudden(const ContactVector& p) override {
    return contacts_.sudden_change(subset_, p);
  }
  double accuracy() const override { return contacts_.h_ * contacts_.probe_->accuracy(); }

 private:
  RigidContacts& contacts_;
  const ContactSubset& subset_;
};

RigidContacts::RigidContacts(const mjModel* m, mjData* d, std::span<RigidContact* const> members,
                             ConstraintProbe* probe)
    : d_(d), members_(members), probe_(probe), h_(m->opt.timestep) {
  for (std::size_t i = 0; i < members.size(); ++i) {
    const RigidContact& at = *members[i];
    contacts_[i].rows = {at.space, at.axial, {1.0, 0.0}, at.pair->contact.radius};
    if (at.axial) rows_ = 3;
  }
}

bool RigidContacts::any_closed() const {
  return std::any_of(contacts_.begin(), contacts_.begin() + static_cast<std::ptrdiff_t>(size()),
                     [](const Closing& c) { return c.closed; });
}

void RigidContacts::give_none() {
  for (Closing& c : contacts_) {
    const Status status = c.result.status;
    c.lasting = c.sudden = Eigen::Vector3d::Zero();
    c.result = {};
    c.result.status = status;
    c.result.converged = converged_;
  }
}

void RigidContacts::add_forces(mjtNum* to) const {
  for (std::size_t i = 0; i < size(); ++i) {
    for (const bool impact : {false, true}) {
      const Eigen::Vector3d& p = impact ? contacts_[i].sudden : contacts_[i].lasting;
      if (!contacts_[i].closed || p.isZero(0.0)) continue;
      contacts_[i].rows.for_each_load(
          p / h_, [&](const ContactSpace& at, const auto& load) { at.add(load, impact, to); });
    }
  }
}

Eigen::Vector3d RigidContacts::end_of(const ContactSpace& at, const Eigen::Vector3d& start) const {
  if (probe_) return start + h_ * probe_->acceleration(at);
  Eigen::Vector3d end = start + h_ * at.response(d_->qfrc_smooth);
  for (std::size_t j = 0; j < size(); ++j) {
    for (const bool impact : {false, true}) {
      const Eigen::Vector3d& p = impact ? contacts_[j].sudden : contacts_[j].lasting;
      if (!contacts_[j].closed || p.isZero(0.0)) continue;
      contacts_[j].rows.for_each_load(p, [&](const ContactSpace& from, const auto& load) {
        end += (impact ? at.admittance(from) : at.flexibility(from)) * load;
      });
    }
  }
  return end;
}

void RigidContacts::find_ends() {
  if (probe_) probe_->solve([this](mjtNum* force) { add_forces(force); });
  for (std::size_t i = 0; i < size(); ++i) {
    const RigidContact& at = *members_[i];
    contacts_[i].end = end_of(*at.space, at.step.start);
    if (at.axial) contacts_[i].axial_end = end_of(*at.axial, at.axial_start);
  }
}

ContactVector RigidContacts::rates(const ContactSubset& s) const {
  ContactVector y(rows_ * static_cast<Eigen::Index>(s.count));
  for (std::size_t k = 0; k < s.count; ++k) {
    const Closing& c = contacts_[s.index[k]];
    const Eigen::Index row = rows_ * static_cast<Eigen::Index>(k);
    const auto end = [&c](const ContactSpace& at) {
      return &at == c.rows.axial ? c.axial_end : c.end;
    };
    y.segment(row, rows_) = c.rows.along(end).head(rows_);
    y[row] += s.offset[k];
  }
  return y;
}

ContactVector RigidContacts::sudden_change(const ContactSubset& s, const ContactVector& p) {
  put(s, p);
  probe_->solve_sudden([this](mjtNum* to) {
    for (const Closing& c : std::span(contacts_).first(size())) {
      if (!c.closed || c.sudden.isZero(0.0)) continue;
      c.rows.for_each_load(
          c.sudden / h_, [&](const ContactSpace& at, const auto& load) { at.add(load, true, to); });
    }
  });
  const auto change = [this](const ContactSpace& at) -> Eigen::Vector3d {
    return h_ * probe_->acceleration(at);
  };
  ContactVector y(rows_ * static_cast<Eigen::Index>(s.count));
  for (std::size_t k = 0; k < s.count; ++k) {
    const Eigen::Index row = rows_ * static_cast<Eigen::Index>(k);
    y.segment(row, rows_) = contacts_[s.index[k]].rows.along(change).head(rows_);
  }
  return y;
}

ContactMatrix RigidContacts::matrix(const ContactSubset& s) const {
  std::array<const ContactRows*, kMaxContacts> all{};
  for (std::size_t k = 0; k < s.count; ++k) all[k] = &contacts_[s.index[k]].rows;
  return contact_matrix({all.data(), s.count}, rows_, s.impact);
}

void RigidContacts::put(const ContactSubset& s, const ContactVector& p) {
  for (std::size_t k = 0; k < s.count; ++k) {
    const Eigen::Index row = rows_ * static_cast<Eigen::Index>(k);
    Closing& c = contacts_[s.index[k]];
    (s.impact ? c.sudden : c.lasting) = {p[row], p[row + 1],
                                         members_[s.index[k]]->axial ? p[row + 2] : 0.0};
  }
}

void RigidContacts::set_status(const ContactSubset& s, Status status) {
  for (std::size_t k = 0; k < s.count; ++k) contacts_[s.index[k]].result.status = status;
}

bool RigidContacts::solve(const ContactSubset& s, SubsetSolution& out) {
  const ContactMatrix a = matrix(s);
  const ContactVector free = rates(s);
  std::array<ImpactLaw, kMaxContacts> all{};
  for (std::size_t k = 0; k < s.count; ++k) all[k] = members_[s.index[k]]->pair->contact.law();
  const std::span<const ImpactLaw> laws(all.data(), s.count);
  if (probe_) return solve_held(s, a, free, laws, out);
  // Impact times count only for a planar contact that is alone on its bodies, without constraints.
  const std::size_t first = s.index[0];
  const bool over_time =
      s.impact && size() == 1 && rows_ == 2 && members_[first]->pair->contact.impact_time() > 0.0;
  const CoupledSolution found = over_time  ? solve_impact_over_time(first)
                                : s.impact ? solve_coupled_impact(a, free, laws)
                                           : solve_lasting(a, free, laws, slips_before(s));
  if (found.solutions != 1) {
    set_status(s, status_of(found.solutions));
    return false;
  }
  out.sticks = found.sticks;
  put(s, found.p);
  return true;
}

CoupledSolution RigidContacts::solve_impact_over_time(std::size_t i) const {
  const RigidContact& at = *members_[i];
  const ContactParameters& contact = at.pair->contact;
  ImpactInput in;
  in.admittance = at.space->admittance();
  in.e_r = contacts_[i].rows.e_r;
  in.radius = contact.radius;
  in.delta = contact.clearance;
  in.acceleration = (contacts_[i].end - at.step.start) / h_;
  in.compression_time = contact.compression_time;
  in.expansion_time = contact.expansion_time;
  // `end` includes the loads of the whole step; the impact law adds those during the impact itself.
  in.velocity = contacts_[i].end - in.acceleration * contact.impact_time();
  const ImpactResult r = solve_impact(in, contact.law());
  CoupledSolution out;
  out.solutions = r.status == Status::kOk ? 1 : r.status == Status::kNoSolution ? 0 : 2;
  out.p = Eigen::Vector2d(r.normal(), r.friction());
  return out;
}

ContactList<double> RigidContacts::slips_before(const ContactSubset& s) const {
  ContactList<double> slips;
  for (std::size_t k = 0; k < s.count; ++k) {
    const RigidContact& at = *members_[s.index[k]];
    const auto start = [&at](const ContactSpace& space) {
      return &space == at.axial ? at.axial_start : at.step.start;
    };
    const Eigen::Vector3d y = contacts_[s.index[k]].rows.along(start);
    slips.push_back(rows_ == 3 ? std::hypot(y[1], y[2]) : y[1]);
  }
  return slips;
}

bool RigidContacts::solve_held(const ContactSubset& s, const ContactMatrix& a,
                               const ContactVector& free, std::span<const ImpactLaw> laws,
                               SubsetSolution& out) {
  Response response(*this, s);
  const ConstrainedContact found = s.impact ? solve_constrained_impact(response, free, a, laws)
                                            : solve_constrained(response, free, a, laws);
  converged_ = converged_ && found.converged;
  if (!found.solved || !found.converged) set_status(s, Status::kNoSolution);
  out.sticks = found.sticks;
  out.lasts = found.lasts;
  if (s.impact) out.after = found.after;
  put(s, found.solved ? found.p : ContactVector::Zero(free.size()));
  return found.solved;
}

}  // namespace rotorub::plugin
