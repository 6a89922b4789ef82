#include "plugin/own/coupled_contacts.h"

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

CoupledContacts::CoupledContacts(const mjModel* m, mjData* d, std::span<CoupledMember* const> members,
                                 ConstraintProbe* probe)
    : d_(d), members_(members), probe_(probe), h_(m->opt.timestep) {
  for (Closing& c : contacts_) c.lasting = c.sudden = Eigen::Vector2d::Zero();
}

bool CoupledContacts::any_closed() const {
  return std::any_of(contacts_.begin(), contacts_.begin() + static_cast<std::ptrdiff_t>(size()),
                     [](const Closing& c) { return c.closed; });
}

void CoupledContacts::give_none() {
  for (Closing& c : contacts_) {
    const Status status = c.result.status;
    c.lasting = c.sudden = Eigen::Vector2d::Zero();
    c.result = {};
    c.result.status = status;
    c.result.converged = converged_;
  }
}

void CoupledContacts::add_forces(mjtNum* to) const {
  for (std::size_t i = 0; i < size(); ++i) {
    const Closing& c = contacts_[i];
    if (!c.closed) continue;
    if (!c.lasting.isZero(0.0)) members_[i]->space->add_load(c.w * c.lasting / h_, to);
    if (!c.sudden.isZero(0.0)) members_[i]->space->add_impact(c.w * c.sudden / h_, to);
  }
}

void CoupledContacts::find_ends() {
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

ContactVector CoupledContacts::rates(const ContactSubset& s) const {
  ContactVector y(2 * static_cast<Eigen::Index>(s.count));
  for (std::size_t k = 0; k < s.count; ++k) {
    const Closing& c = contacts_[s.index[k]];
    const auto row = static_cast<Eigen::Index>(2 * k);
    y.segment<2>(row) = c.w.transpose() * c.end;
    y[row] += s.offset[k];
  }
  return y;
}

ContactMatrix CoupledContacts::matrix(const ContactSubset& s) const {
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

void CoupledContacts::put(const ContactSubset& s, const ContactVector& p) {
  for (std::size_t k = 0; k < s.count; ++k) {
    Closing& c = contacts_[s.index[k]];
    (s.impact ? c.sudden : c.lasting) = p.segment<2>(static_cast<Eigen::Index>(2 * k));
  }
}

void CoupledContacts::set_status(const ContactSubset& s, Status status) {
  for (std::size_t k = 0; k < s.count; ++k) contacts_[s.index[k]].result.status = status;
}

bool CoupledContacts::solve(const ContactSubset& s, std::array<bool, kMaxPairs>& sticks) {
  const ContactMatrix a = matrix(s);
  const ContactVector free = rates(s);
  if (probe_) return solve_held(s, a, free, sticks);
  std::array<ImpactLaw, kMaxPairs> laws{};
  std::array<ContactSet, kMaxPairs> sets{};
  for (std::size_t k = 0; k < s.count; ++k) {
    const ContactParameters& c = *members_[s.index[k]]->contact;
    sets[k].friction = c.friction;
    laws[k] = {c.friction, c.restitution, c.tangential_restitution};
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

bool CoupledContacts::solve_held(const ContactSubset& s, const ContactMatrix& a, const ContactVector& free,
                                 std::array<bool, kMaxPairs>& sticks) {
  std::array<double, kMaxPairs> frictions{};
  std::array<ImpactLaw, kMaxPairs> laws{};
  for (std::size_t k = 0; k < s.count; ++k) {
    const ContactParameters& c = *members_[s.index[k]]->contact;
    frictions[k] = c.friction;
    laws[k] = {c.friction, c.restitution, c.tangential_restitution};
  }
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

}  // namespace rotorub::plugin
