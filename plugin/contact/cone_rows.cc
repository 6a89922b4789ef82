#include "plugin/contact/cone_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "native_model/contact/disc_law.h"
#include "plugin/contact/constraint_probe.h"
#include "plugin/model/mujoco_dynamics.h"

namespace rotorub::plugin {

bool is_pyramid(const mjModel* m, const mjContact& c) { return c.dim > 1 && mj_isPyramidal(m); }
int row_count(const mjModel* m, const mjContact& c) {
  return is_pyramid(m, c) ? 2 * (c.dim - 1) : c.dim;
}
int row_count(std::span<const ConeRows> cones) {
  int rows = 0;
  for (const ConeRows& c : cones) rows += c.count;
  return rows;
}

double along(const mjModel* m, const ConeRows& rows, const mjtNum* y, int direction) {
  const mjtNum* own = y + rows.first;
  if (!is_pyramid(m, *rows.contact))
    return direction == 0 ? own[0] : rows.contact->friction[direction - 1] * own[direction];
  const int edge = direction == 0 ? 0 : 2 * (direction - 1);
  return 0.5 * (own[edge] + (direction == 0 ? 1.0 : -1.0) * own[edge + 1]);
}

namespace {

constexpr Eigen::Index kDirections = 3;  // the normal, and two tangents scaled by mu

// The transpose of `along`, added to a vector of all rows.
void add_along(const mjModel* m, const ConeRows& rows, int direction, mjtNum* vector) {
  mjtNum* own = vector + rows.first;
  if (!is_pyramid(m, *rows.contact)) {
    own[direction] += direction == 0 ? 1.0 : rows.contact->friction[direction - 1];
    return;
  }
  const int edge = direction == 0 ? 0 : 2 * (direction - 1);
  own[edge] += 0.5;
  own[edge + 1] += direction == 0 ? 0.5 : -0.5;
}

// The contacts alone, without other constraints, from the free acceleration.
class OwnCones {
 public:
  OwnCones(const mjModel* m, mjData* d, std::span<ConeRows> contacts)
      : m_(m),
        d_(d),
        contacts_(contacts),
        room_(d),
        nv_(count(m->nv)),
        n_(static_cast<Eigen::Index>(contacts.size()) * kDirections) {
    columns_ = room_.numbers(static_cast<int>(n_) * nv_);
    solved_ = room_.numbers(static_cast<int>(n_) * nv_);
    mjtNum* rows = room_.numbers(d->nefc);
    for (Eigen::Index i = 0; i < n_; ++i) {
      std::fill_n(rows, d->nefc, 0.0);
      add_along(m, of(i), direction(i), rows);
      mj_mulJacTVec(m, d, columns_ + i * nv_, rows);
    }
    mj_solveM(m, d, solved_, columns_, static_cast<int>(n_));
  }

  // Writes |z| of each contact to `shift`. Returns false if there is no solution, or if MuJoCo's
  // rows have another one, because of torsional or rolling friction or the corners of a pyramid.
  bool solve() {
    ContactMatrix a(n_, n_);
    ContactVector b(n_);
    for (Eigen::Index i = 0; i < n_; ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) {
        a(i, j) = a(j, i) = mju_dot(columns_ + i * nv_, solved_ + j * nv_, nv_);
      }
      b[i] = mju_dot(columns_ + i * nv_, d_->qacc_smooth, nv_) -
             along(m_, of(i), d_->efc_aref, direction(i));
      a(i, i) += softness(i);
    }
    std::array<DiscSet, kMaxContacts> sets{};
    for (DiscSet& set : sets) set.friction = 1.0;
    const CoupledSolution s = solve_discs(a, b, std::span(sets).first(contacts_.size()));
    if (s.solutions == 0) return false;
    start_from(s.p);
    bool exact = true;
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      const auto first = static_cast<Eigen::Index>(k) * kDirections + 1;
      const Eigen::Vector2d z = s.y.segment<2>(first), force = s.p.segment<2>(first);
      const bool pyramid = is_pyramid(m_, *contacts_[k].contact);
      contacts_[k].shift = pyramid ? z.cwiseAbs().maxCoeff() : z.norm();
      exact = exact && contacts_[k].contact->dim == 3 && (!pyramid || is_on_edges(z, force));
    }
    return exact;
  }

  // True if a row that belongs to none of them is coupled to them.
  bool is_coupled() {
    mjtNum* product = room_.numbers(d_->nefc);
    const mjtNum* diagonal = constraint_diagonal(d_);
    for (Eigen::Index i = 0; i < n_; ++i) {
      const double mobility = mju_dot(columns_ + i * nv_, solved_ + i * nv_, nv_);
      mj_mulJacVec(m_, d_, product, solved_ + i * nv_);
      for (int row = 0; row < d_->nefc; ++row) {
        if (!is_own(row) && product[row] * product[row] > kApart * mobility * diagonal[row])
          return true;
      }
    }
    return false;
  }

 private:
  static constexpr double kApart = 1e-20;  // squared cosine below which two rows are not coupled

  // True if slip and friction are along one tangent of a pyramid, where it equals the disc.
  static bool is_on_edges(const Eigen::Vector2d& z, const Eigen::Vector2d& force) {
    constexpr double kNone = 1e-10;  // relative
    const auto none = [&](Eigen::Index i) {
      return std::abs(z[i]) <= kNone * z.norm() && std::abs(force[i]) <= kNone * force.norm();
    };
    return none(0) || none(1);
  }
  const ConeRows& of(Eigen::Index i) const {
    return contacts_[static_cast<std::size_t>(i / kDirections)];
  }
  static int direction(Eigen::Index i) { return static_cast<int>(i % kDirections); }

  // Lets MuJoCo's solver start from the accelerations by these forces. PGS, which changes one force
  // at a time, does not find the solution from 0, because neither the normal force nor the friction
  // reduces the cost without the other.
  void start_from(const ContactVector& p) {
    for (int dof = 0; dof < nv_; ++dof) {
      double change = 0.0;
      for (Eigen::Index i = 0; i < p.size(); ++i) change += p[i] * solved_[i * nv_ + dof];
      if (change != 0.0) d_->qacc_warmstart[dof] = d_->qacc_smooth[dof] + change;
    }
  }

  // MuJoCo's R along a direction.
  double softness(Eigen::Index i) const {
    const mjtNum* r = d_->efc_R + of(i).first;
    const int k = direction(i);
    if (is_pyramid(m_, *of(i).contact)) {
      return 0.25 * (r[k == 0 ? 0 : 2 * (k - 1)] + r[k == 0 ? 1 : 2 * k - 1]);
    }
    const double mu = k == 0 ? 1.0 : of(i).contact->friction[k - 1];
    return mu * mu * r[k];
  }
  bool is_own(int row) const {
    return std::any_of(contacts_.begin(), contacts_.end(), [row](const ConeRows& c) {
      return row >= c.first && row < c.first + c.count;
    });
  }

  const mjModel* m_;
  mjData* d_;
  std::span<ConeRows> contacts_;
  StackFrame room_;
  int nv_;
  Eigen::Index n_;  // all directions of all contacts
  mjtNum *columns_, *solved_;
};

// True if the contacts move a kinematic tree in common.
bool share_a_tree(const mjModel* m, const mjContact& a, const mjContact& b) {
  const auto tree = [m](int geom) {
    const int body = m->geom_bodyid[geom];
    return m->body_weldid[body] == 0 ? -1 : m->body_rootid[body];
  };
  for (const int one : {a.geom1, a.geom2}) {
    for (const int other : {b.geom1, b.geom2}) {
      if (tree(one) >= 0 && tree(one) == tree(other)) return true;
    }
  }
  return false;
}

}  // namespace

std::vector<std::span<ConeRows>> groups_of(const mjModel* m, std::span<ConeRows> cones) {
  std::vector<std::span<ConeRows>> groups;
  while (!cones.empty()) {
    std::size_t size = 1;
    for (std::size_t k = 0; k < size; ++k) {
      const auto joins = [&](const ConeRows& c) {
        return share_a_tree(m, *cones[k].contact, *c.contact);
      };
      const auto rest = cones.begin() + static_cast<std::ptrdiff_t>(size);
      size = static_cast<std::size_t>(std::partition(rest, cones.end(), joins) - cones.begin());
    }
    groups.push_back(cones.first(size));
    cones = cones.subspan(size);
  }
  return groups;
}

bool solve_group(const mjModel* m, mjData* d, std::span<ConeRows> group, bool alone) {
  if (group.size() > kMaxContacts) return false;
  OwnCones own(m, d, group);
  return own.solve() && (alone || !own.is_coupled());
}

}  // namespace rotorub::plugin
