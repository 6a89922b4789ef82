#include "plugin/contact/rigid_contacts.h"

#include <algorithm>
#include <cmath>

#include "native_model/contact/impact.h"

namespace rotorub::plugin {

// The response of the step to the impulses of a subset, with constraints.
class RigidContacts::Response final : public ContactResponse {
 public:
  Response(RigidContacts& contacts, const ContactSubset& subset)
      : contacts_(contacts), subset_(subset) {}
  ContactVector at(const ContactVector& p) override {
    contacts_.set_impulses(subset_, p);
    contacts_.update_ends();
    return contacts_.rates(subset_);
  }
  ContactVector instant_change(const ContactVector& p) override {
    return contacts_.instant_change(subset_, p);
  }
  double accuracy() const override { return contacts_.h_ * contacts_.probe_->accuracy(); }

 private:
  RigidContacts& contacts_;
  const ContactSubset& subset_;
};

namespace {

void set_status(const ContactSubset& s, Status status) {
  for (const ContactSubset::Member& member : s.members) member.at->result.status = status;
}

}  // namespace

RigidContacts::RigidContacts(const mjModel* m, mjData* d, std::span<RigidContact* const> members,
                             ConstraintProbe* probe)
    : d_(d), members_(members), probe_(probe), h_(m->opt.timestep) {
  for (const RigidContact* c : members) {
    if (c->rows.axial) rows_ = 3;
  }
}

bool RigidContacts::any_closed() const {
  return std::any_of(members_.begin(), members_.end(),
                     [](const RigidContact* c) { return c->closed; });
}

void RigidContacts::clear_impulses() {
  for (RigidContact* c : members_) {
    const Status status = c->result.status;
    c->lasting_impulse = c->impact_impulse = Eigen::Vector3d::Zero();
    c->result = {};
    c->result.status = status;
    c->result.converged = converged_;
  }
}

template <typename Action>
void RigidContacts::for_each_load(double by, Action action) const {
  for (const RigidContact* c : members_) {
    for (const bool impact : {false, true}) {
      const Eigen::Vector3d& p = impact ? c->impact_impulse : c->lasting_impulse;
      if (!c->closed || p.isZero(0.0)) continue;
      c->rows.for_each_load(p / by, [&](const ContactSpace& at, const Eigen::Vector3d& load) {
        action(at, load, impact);
      });
    }
  }
}

void RigidContacts::add_forces(mjtNum* to) const {
  for_each_load(h_, [to](const ContactSpace& at, const Eigen::Vector3d& load, bool impact) {
    at.add(load, impact, to);
  });
}

Eigen::Vector3d RigidContacts::end_of(const ContactSpace& at, const Eigen::Vector3d& start) const {
  if (probe_) return start + h_ * probe_->acceleration(at);
  Eigen::Vector3d end = start + h_ * at.response(d_->qfrc_smooth);
  for_each_load(1.0, [&](const ContactSpace& from, const Eigen::Vector3d& load, bool impact) {
    end += (impact ? at.admittance(from) : at.step_admittance(from)) * load;
  });
  return end;
}

void RigidContacts::update_ends() {
  if (probe_) probe_->solve([this](mjtNum* force) { add_forces(force); });
  for (RigidContact* c : members_) {
    c->end = end_of(*c->rows.plane, c->step.start);
    if (c->rows.axial) c->axial_end = end_of(*c->rows.axial, c->axial_start);
  }
}

template <typename RatesIn>
ContactVector RigidContacts::contact_rates(const ContactSubset& s, RatesIn rates_in) const {
  ContactVector y(row(s.members.size()));
  for (std::size_t k = 0; k < s.members.size(); ++k) {
    const RigidContact& c = *s.members[k].at;
    const auto in_space = [&](const ContactSpace& at) -> Eigen::Vector3d {
      return rates_in(c, at);
    };
    y.segment(row(k), rows_) = c.rows.contact_rates(in_space).head(rows_);
  }
  return y;
}

ContactVector RigidContacts::rates(const ContactSubset& s) const {
  ContactVector y = contact_rates(s, [](const RigidContact& c, const ContactSpace& at) {
    return &at == c.rows.axial ? c.axial_end : c.end;
  });
  for (std::size_t k = 0; k < s.members.size(); ++k) y[row(k)] += s.members[k].offset;
  return y;
}

ContactVector RigidContacts::instant_change(const ContactSubset& s, const ContactVector& p) {
  set_impulses(s, p);
  probe_->solve_instant([this](mjtNum* to) {
    for_each_load(h_, [to](const ContactSpace& at, const Eigen::Vector3d& load, bool impact) {
      if (impact) at.add(load, true, to);
    });
  });
  return contact_rates(s, [this](const RigidContact&, const ContactSpace& at) -> Eigen::Vector3d {
    return h_ * probe_->acceleration(at);
  });
}

ContactMatrix RigidContacts::matrix(const ContactSubset& s) const {
  ContactList<const ContactRows*> all;
  for (const ContactSubset::Member& member : s.members) all.push_back(&member.at->rows);
  return contact_matrix(all, rows_, s.impact);
}

void RigidContacts::set_impulses(const ContactSubset& s, const ContactVector& p) {
  for (std::size_t k = 0; k < s.members.size(); ++k) {
    RigidContact& c = *s.members[k].at;
    (s.impact ? c.impact_impulse : c.lasting_impulse) = {p[row(k)], p[row(k) + 1],
                                                         c.rows.axial ? p[row(k) + 2] : 0.0};
  }
}

bool RigidContacts::solve(const ContactSubset& s, SubsetSolution& out) {
  const ContactMatrix a = matrix(s);
  const ContactVector free = rates(s);
  ContactList<ImpactLaw> laws;
  for (const ContactSubset::Member& member : s.members) {
    laws.push_back(member.at->pair->contact.impact_law());
  }
  if (probe_) return solve_with_constraints(s, a, free, laws, out);
  // Impact times count only for a planar contact that is alone on its bodies, without constraints.
  const RigidContact& first = *s.members[0].at;
  const bool over_time =
      s.impact && members_.size() == 1 && rows_ == 2 && first.pair->contact.impact_time() > 0.0;
  const CoupledSolution found = over_time  ? solve_impact_over_time(first)
                                : s.impact ? solve_coupled_impact(a, free, laws)
                                           : solve_coupled_lasting(a, free, laws, slips_before(s));
  if (!found.is_unique()) {
    set_status(s, status_of(found.solutions));
    return false;
  }
  out.sticks = found.sticks;
  set_impulses(s, found.p);
  return true;
}

CoupledSolution RigidContacts::solve_impact_over_time(const RigidContact& at) const {
  const ContactParameters& contact = at.pair->contact;
  ImpactInput in;
  in.admittance = at.rows.plane->admittance();
  in.e_r = at.rows.e_r;
  in.radius = contact.radius;
  in.delta = contact.clearance;
  in.acceleration = (at.end - at.step.start) / h_;
  in.compression_time = contact.compression_time;
  in.expansion_time = contact.expansion_time;
  // `end` includes the loads of the whole step; the impact law adds those during the impact itself.
  in.velocity = at.end - in.acceleration * contact.impact_time();
  const ImpactResult r = solve_impact(in, contact.impact_law());
  CoupledSolution out;
  out.solutions = r.status == Status::kOk ? 1 : r.status == Status::kNoSolution ? 0 : 2;
  out.p = Eigen::Vector2d(r.normal(), r.friction());
  return out;
}

ContactList<double> RigidContacts::slips_before(const ContactSubset& s) const {
  const ContactVector y = contact_rates(s, [](const RigidContact& c, const ContactSpace& at) {
    return &at == c.rows.axial ? c.axial_start : c.step.start;
  });
  ContactList<double> slips;
  for (std::size_t k = 0; k < s.members.size(); ++k) {
    const double slip = y[row(k) + 1];
    slips.push_back(rows_ == 3 ? std::hypot(slip, y[row(k) + 2]) : slip);
  }
  return slips;
}

bool RigidContacts::solve_with_constraints(const ContactSubset& s, const ContactMatrix& a,
                                           const ContactVector& free,
                                           std::span<const ImpactLaw> laws, SubsetSolution& out) {
  Response response(*this, s);
  const ConstrainedContact found = s.impact ? solve_constrained_impact(response, free, a, laws)
                                            : solve_constrained(response, free, a, laws);
  converged_ = converged_ && found.converged;
  if (!found.solved || !found.converged) set_status(s, Status::kNoSolution);
  out.sticks = found.sticks;
  out.lasts = found.lasts;
  if (s.impact) out.after = found.after;
  set_impulses(s, found.solved ? found.p : ContactVector::Zero(free.size()));
  return found.solved;
}

}  // namespace rotorub::plugin
