#include "plugin/contact/coupled_contacts.h"

#include <algorithm>

#include "native_model/contact/kinematics.h"

namespace rotorub::plugin {

ContactColumns contact_columns(const Eigen::Vector2d& e_r, double radius) {
  ContactColumns w;
  w.col(0) = contact_load(e_r, radius, 1.0, 0.0);
  w.col(1) = contact_load(e_r, radius, 0.0, 1.0);
  return w;
}

// The step's answer to impulses of a subset, for those whom constraints hold.
class CoupledContacts::Response final : public ContactResponse {
 public:
  Response(CoupledContacts& contacts, const ContactSubset& subset)
      : contacts_(contacts), subset_(subset) {}
  ContactVector at(const ContactVector& p) override {
    contacts_.put(subset_, p);
    contacts_.find_ends();
    return contacts_.rates(subset_);
  }
  double accuracy() const override { return contacts_.h_ * contacts_.probe_->accuracy(); }

 private:
  CoupledContacts& contacts_;
  const ContactSubset& subset_;
};

CoupledContacts::CoupledContacts(const mjModel* m, mjData* d,
                                 std::span<CoupledMember* const> members, ConstraintProbe* probe)
    : d_(d), members_(members), probe_(probe), h_(m->opt.timestep) {
  for (Closing& c : contacts_) c.lasting = c.sudden = Eigen::Vector3d::Zero();
  for (const CoupledMember* at : members) {
    if (at->axial) rows_ = 3;
  }
}

bool CoupledContacts::any_closed() const {
  return std::any_of(contacts_.begin(), contacts_.begin() + static_cast<std::ptrdiff_t>(size()),
                     [](const Closing& c) { return c.closed; });
}

void CoupledContacts::give_none() {
  for (Closing& c : contacts_) {
    const Status status = c.result.status;
    c.lasting = c.sudden = Eigen::Vector3d::Zero();
    c.result = {};
    c.result.status = status;
    c.result.converged = converged_;
  }
}

void CoupledContacts::add_forces(mjtNum* to) const {
  for (std::size_t i = 0; i < size(); ++i) {
    const Closing& c = contacts_[i];
    if (!c.closed) continue;
    const CoupledMember& at = *members_[i];
    if (!c.lasting.isZero(0.0)) at.space->add_load(c.w * c.lasting.head<2>() / h_, to);
    if (!c.sudden.isZero(0.0)) at.space->add_impact(c.w * c.sudden.head<2>() / h_, to);
    if (c.lasting.z() != 0.0) at.axial->add_load(c.w_axial * (c.lasting.z() / h_), to);
    if (c.sudden.z() != 0.0) at.axial->add_impact(c.w_axial * (c.sudden.z() / h_), to);
  }
}

Eigen::Vector3d CoupledContacts::end_of(const ContactSpace& at,
                                        const Eigen::Vector3d& start) const {
  if (probe_) return start + h_ * probe_->acceleration(at);
  Eigen::Vector3d end = start + h_ * at.response(d_->qfrc_smooth);
  for (std::size_t j = 0; j < size(); ++j) {
    const Closing& c = contacts_[j];
    if (!c.closed) continue;
    const ContactSpace &plane = *members_[j]->space, *axial = members_[j]->axial;
    if (!c.lasting.isZero(0.0)) end += at.flexibility(plane) * (c.w * c.lasting.head<2>());
    if (!c.sudden.isZero(0.0)) end += at.admittance(plane) * (c.w * c.sudden.head<2>());
    if (c.lasting.z() != 0.0) end += at.flexibility(*axial) * (c.w_axial * c.lasting.z());
    if (c.sudden.z() != 0.0) end += at.admittance(*axial) * (c.w_axial * c.sudden.z());
  }
  return end;
}

void CoupledContacts::find_ends() {
  if (probe_) probe_->solve([this](mjtNum* force) { add_forces(force); });
  for (std::size_t i = 0; i < size(); ++i) {
    const CoupledMember& at = *members_[i];
    contacts_[i].end = end_of(*at.space, at.step.start);
    if (at.axial) contacts_[i].axial_end = end_of(*at.axial, at.axial_start);
  }
}

ContactVector CoupledContacts::rates(const ContactSubset& s) const {
  ContactVector y = ContactVector::Zero(rows_ * static_cast<Eigen::Index>(s.count));
  for (std::size_t k = 0; k < s.count; ++k) {
    const Closing& c = contacts_[s.index[k]];
    const Eigen::Index row = rows_ * static_cast<Eigen::Index>(k);
    y.segment<2>(row) = c.w.transpose() * c.end;
    y[row] += s.offset[k];
    if (members_[s.index[k]]->axial) y[row + 2] = c.w_axial.dot(c.axial_end);
  }
  return y;
}

ContactMatrix CoupledContacts::matrix(const ContactSubset& s) const {
  const Eigen::Index n = rows_ * static_cast<Eigen::Index>(s.count);
  ContactMatrix a = ContactMatrix::Zero(n, n);
  const auto g = [&](const ContactSpace& at, const ContactSpace& from) {
    return s.impact ? at.admittance(from) : at.flexibility(from);
  };
  for (std::size_t i = 0; i < s.count; ++i) {
    for (std::size_t j = 0; j < s.count; ++j) {
      const Closing &one = contacts_[s.index[i]], &two = contacts_[s.index[j]];
      const CoupledMember &at = *members_[s.index[i]], &from = *members_[s.index[j]];
      const Eigen::Index row = rows_ * static_cast<Eigen::Index>(i),
                         column = rows_ * static_cast<Eigen::Index>(j);
      a.block<2, 2>(row, column) = one.w.transpose() * g(*at.space, *from.space) * two.w;
      if (from.axial)
        a.block<2, 1>(row, column + 2) =
            one.w.transpose() * g(*at.space, *from.axial) * two.w_axial;
      if (at.axial)
        a.block<1, 2>(row + 2, column) =
            one.w_axial.transpose() * g(*at.axial, *from.space) * two.w;
      if (at.axial && from.axial)
        a(row + 2, column + 2) = one.w_axial.dot(g(*at.axial, *from.axial) * two.w_axial);
    }
  }
  return 0.5 * (a + a.transpose());
}

void CoupledContacts::put(const ContactSubset& s, const ContactVector& p) {
  for (std::size_t k = 0; k < s.count; ++k) {
    const Eigen::Index row = rows_ * static_cast<Eigen::Index>(k);
    Closing& c = contacts_[s.index[k]];
    (s.impact ? c.sudden : c.lasting) = {p[row], p[row + 1],
                                         members_[s.index[k]]->axial ? p[row + 2] : 0.0};
  }
}

void CoupledContacts::set_status(const ContactSubset& s, Status status) {
  for (std::size_t k = 0; k < s.count; ++k) contacts_[s.index[k]].result.status = status;
}

bool CoupledContacts::solve(const ContactSubset& s, std::array<bool, kMaxContacts>& sticks) {
  const ContactMatrix a = matrix(s);
  const ContactVector free = rates(s);
  if (probe_) return solve_held(s, a, free, sticks);
  std::array<ImpactLaw, kMaxContacts> all{};
  for (std::size_t k = 0; k < s.count; ++k) {
    all[k] = members_[s.index[k]]->contact->law();
  }
  const std::span<const ImpactLaw> laws(all.data(), s.count);
  const CoupledSolution found =
      s.impact ? solve_coupled_impact(a, free, laws) : solve_compression(a, free, laws);
  if (found.solutions != 1) {
    set_status(s, status_of(found.solutions));
    return false;
  }
  sticks = found.sticks;
  put(s, found.p);
  return true;
}

bool CoupledContacts::solve_held(const ContactSubset& s, const ContactMatrix& a,
                                 const ContactVector& free,
                                 std::array<bool, kMaxContacts>& sticks) {
  std::array<ImpactLaw, kMaxContacts> laws{};
  for (std::size_t k = 0; k < s.count; ++k) laws[k] = members_[s.index[k]]->contact->law();
  Response response(*this, s);
  const ConstrainedContact found =
      s.impact ? solve_constrained_impact(response, free, a, std::span(laws).first(s.count))
               : solve_constrained(response, free, a, std::span(laws).first(s.count));
  converged_ = converged_ && found.converged;
  if (!found.solved || !found.converged) set_status(s, Status::kNoSolution);
  sticks = found.sticks;
  put(s, found.solved ? found.p : ContactVector::Zero(free.size()));
  return found.solved;
}

}  // namespace rotorub::plugin
