#include "plugin/contact/constraint_probe.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace rotorub::plugin {
namespace {

// Squared cosine between row and contact, in the metric of M, below which they do not meet.
constexpr double kApart = 1e-20;

// Calls action(row) for each row that moves with the contact, until it says false.
template <typename Action>
void for_each_coupled(const mjModel* m, mjData* d, const ContactSpace& space, Action action) {
  const int n = d->nefc;
  StackFrame room(d);
  mjtNum* product = room.numbers(3 * n);
  const mjtNum* diagonal = constraint_diagonal(d);
  const Eigen::Matrix3d own = space.admittance();
  for (int k = 0; k < 3; ++k) mj_mulJacVec(m, d, product + k * n, space.acceleration_row(k));
  for (int i = 0; i < n; ++i) {
    bool meets = false;
    for (int k = 0; k < 3; ++k) {
      const double c = product[k * n + i];
      meets = meets || c * c > kApart * own(k, k) * diagonal[i];
    }
    if (meets && !action(i)) break;
  }
}

std::string named(const mjModel* m, int type, int id, const std::string& kind) {
  const char* name = id < 0 ? nullptr : mj_id2name(m, type, id);
  return name && *name ? kind + " " + name : kind + " number " + std::to_string(id);
}

std::string row_name(const mjModel* m, const mjData* d, int row) {
  const int id = d->efc_id[row];
  switch (d->efc_type[row]) {
    case mjCNSTR_EQUALITY:
      return named(m, mjOBJ_EQUALITY, id, "equality");
    case mjCNSTR_FRICTION_DOF:
      return named(m, mjOBJ_JOINT, m->dof_jntid[id], "friction loss of joint");
    case mjCNSTR_FRICTION_TENDON:
      return named(m, mjOBJ_TENDON, id, "friction loss of tendon");
    case mjCNSTR_LIMIT_JOINT:
      return named(m, mjOBJ_JOINT, id, "limit of joint");
    case mjCNSTR_LIMIT_TENDON:
      return named(m, mjOBJ_TENDON, id, "limit of tendon");
    default: {
      const mjContact& c = d->contact[id];
      return "contact of " + named(m, mjOBJ_GEOM, c.geom1, "geom") + " and " +
             named(m, mjOBJ_GEOM, c.geom2, "geom");
    }
  }
}

}  // namespace

bool constraints_couple(const mjModel* m, mjData* d, const ContactSpace& space,
                        std::span<const int> but) {
  bool any = false;
  if (d->nefc == 0) return false;
  for_each_coupled(m, d, space, [&](int row) {
    any = std::find(but.begin(), but.end(), row) == but.end();
    return !any;
  });
  return any;
}

void warn_unsolved(const mjModel* m, mjData* d, const ContactSpace& space) {
  std::string all, last;
  for_each_coupled(m, d, space, [&](int row) {
    const std::string name = row_name(m, d, row);
    if (name != last) all += (all.empty() ? "" : ", ") + name;
    last = name;
    return all.size() < 400;
  });
  const std::string text = "rotorub: contact beside " + all +
                           ": no impulse meets the contact laws; that of the least error is taken";
  plugin::warn(text.c_str());
}

ConstraintProbe::ConstraintProbe(const mjModel* m, mjData* d)
    : m_(m), d_(d), room_(d), solved_(d->timer[mjTIMER_CONSTRAINT].number) {
  const auto kept = [this](const mjtNum* from) {
    mjtNum* copy = room_.numbers(count(m_->nv));
    std::copy_n(from, m_->nv, copy);
    return copy;
  };
  force_ = kept(d->qfrc_smooth);
  warm_ = kept(d->qacc_warmstart);
  smooth_ = kept(d->qacc_smooth);
  total_ = room_.numbers(count(m->nv));
}

ConstraintProbe::~ConstraintProbe() {
  std::copy_n(force_, m_->nv, d_->qfrc_smooth);
  std::copy_n(smooth_, m_->nv, d_->qacc_smooth);
  std::copy_n(kept_ ? d_->qacc : warm_, m_->nv, d_->qacc_warmstart);
  d_->timer[mjTIMER_CONSTRAINT].number = solved_;  // a step's solution counts once
}

void ConstraintProbe::reset() { std::copy_n(force_, m_->nv, d_->qfrc_smooth); }

void ConstraintProbe::run() {
  mj_solveM(m_, d_, d_->qacc_smooth, d_->qfrc_smooth, 1);
  mj_fwdConstraint(m_, d_);
  mju_add(total_, d_->qfrc_smooth, d_->qfrc_constraint, count(m_->nv));
}

Eigen::Vector3d ConstraintProbe::acceleration(const ContactSpace& space) {
  return space.damped() ? space.response(total_) : space.rates(d_->qacc);
}

// The solver ends where the cost, an acceleration squared by a mass, falls by less than tolerance
// times the mean inertia by nv.
double ConstraintProbe::accuracy() const { return std::sqrt(m_->opt.tolerance * count(m_->nv)); }

}  // namespace rotorub::plugin
