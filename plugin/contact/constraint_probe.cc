#include "plugin/contact/constraint_probe.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "plugin/model/mujoco_dynamics.h"

namespace rotorub::plugin {
namespace {

// Squared cosine between row and contact, in the metric of M, below which they are not coupled.
constexpr double kApart = 1e-20;

// Calls action(row) for each row that is coupled to the contact, until it returns false.
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
  return name && *name ? kind + " " + name : kind + " number " + std::to_string(id + 1);
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

const mjtNum* kept(StackFrame& room, const mjtNum* from, int n) {
  mjtNum* copy = room.numbers(n);
  std::copy_n(from, n, copy);
  return copy;
}

// The friction losses that MuJoCo's solver reads when it solves islands separately (since 3.3);
// null if it does not.
template <typename Data>
mjtNum* losses_of_islands(const Data* d) {
  if constexpr (requires { d->iefc_frictionloss; }) {
    return d->nisland > 0 ? d->iefc_frictionloss : nullptr;
  } else {
    return nullptr;
  }
}

// Makes the rows' response to a load in no time homogeneous (twice the load has twice the
// response), except for rows that are already opening: a limit or a contact does not respond to
// accelerations above its negative reference. The references for the state itself and the friction
// losses are set to 0. All is restored at the end of the scope.
class SuddenRows {
 public:
  explicit SuddenRows(mjData* d)
      : d_(d),
        room_(d),
        reference_(kept(room_, d->efc_aref, d->nefc)),
        loss_(kept(room_, d->efc_frictionloss, d->nefc)),
        losses_of_islands_(losses_of_islands(d)),
        island_loss_(losses_of_islands_ ? kept(room_, losses_of_islands_, d->nefc) : nullptr) {
    for (int row = 0; row < d->nefc; ++row) {
      d->efc_aref[row] = is_one_sided(row) ? std::min(d->efc_aref[row], 0.0) : 0.0;
    }
    std::fill_n(d->efc_frictionloss, d->nefc, 0.0);
    if (losses_of_islands_) std::fill_n(losses_of_islands_, d->nefc, 0.0);
  }
  ~SuddenRows() {
    std::copy_n(reference_, d_->nefc, d_->efc_aref);
    std::copy_n(loss_, d_->nefc, d_->efc_frictionloss);
    if (losses_of_islands_) std::copy_n(island_loss_, d_->nefc, losses_of_islands_);
  }
  SuddenRows(const SuddenRows&) = delete;
  SuddenRows& operator=(const SuddenRows&) = delete;

 private:
  bool is_one_sided(int row) const {
    switch (d_->efc_type[row]) {
      case mjCNSTR_EQUALITY:
      case mjCNSTR_FRICTION_DOF:
      case mjCNSTR_FRICTION_TENDON:
        return false;
      case mjCNSTR_CONTACT_ELLIPTIC:
        return d_->contact[d_->efc_id[row]].efc_address == row;  // the row of its normal
      default:
        return true;
    }
  }

  mjData* d_;
  StackFrame room_;
  const mjtNum *reference_, *loss_;
  mjtNum* losses_of_islands_;  // null: the solver does not read it
  const mjtNum* island_loss_;
};

}  // namespace

bool constraints_couple(const mjModel* m, mjData* d, const ContactSpace& space,
                        std::span<const int> but) {
  bool any = false;
  if (std::count_if(but.begin(), but.end(), [](int row) { return row >= 0; }) == d->nefc) {
    return false;
  }
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
  const std::string text =
      "rotorub: contact beside " + all +
      ": no impulse satisfies the contact laws; the impulse with the least error is used";
  plugin::warn(text.c_str());
}

ConstraintProbe::ConstraintProbe(const mjModel* m, mjData* d)
    : m_(m),
      d_(d),
      room_(d),
      solved_(d->timer[mjTIMER_CONSTRAINT].number),
      force_(kept(room_, d->qfrc_smooth, count(m->nv))),
      warm_(kept(room_, d->qacc_warmstart, count(m->nv))),
      smooth_(kept(room_, d->qacc_smooth, count(m->nv))),
      total_(room_.numbers(count(m->nv))) {}

ConstraintProbe::~ConstraintProbe() {
  std::copy_n(force_, m_->nv, d_->qfrc_smooth);
  std::copy_n(smooth_, m_->nv, d_->qacc_smooth);
  std::copy_n(kept_ ? d_->qacc : warm_, m_->nv, d_->qacc_warmstart);
  d_->timer[mjTIMER_CONSTRAINT].number = solved_;  // the solution of a step counts once
}

void ConstraintProbe::run() {
  mj_solveM(m_, d_, d_->qacc_smooth, d_->qfrc_smooth, 1);
  mj_fwdConstraint(m_, d_);
  mju_add(total_, d_->qfrc_smooth, d_->qfrc_constraint, count(m_->nv));
}

void ConstraintProbe::run_instant() {
  const SuddenRows rows(d_);
  run();
}

Eigen::Vector3d ConstraintProbe::acceleration(const ContactSpace& space) {
  return space.damped() ? space.response(total_) : space.rates(d_->qacc);
}

// The solver stops when the cost, a squared acceleration times a mass, falls by less than tolerance
// times the mean inertia times nv.
double ConstraintProbe::accuracy() const { return std::sqrt(m_->opt.tolerance * count(m_->nv)); }

}  // namespace rotorub::plugin
