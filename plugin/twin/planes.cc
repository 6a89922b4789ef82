#include "plugin/twin/planes.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>

#include "native_model/numerics/eigenvalues.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNone = 1e-8;  // relative size below which an entry is the error of differences

bool is_in(const std::vector<int>& list, int dof) {
  return std::find(list.begin(), list.end(), dof) != list.end();
}

// Which degrees of freedom are coupled. Each pair is compared in units of its own diagonal.
class Links {
 public:
  explicit Links(const LinearMachine& machine) {
    const auto n = machine.mass.rows();
    linked_ = MatrixXd::Zero(n, n);
    add(machine.mass);
    add(machine.stiffness);
    add(machine.damping);
  }
  bool linked(int a, int b) const { return linked_(a, b) > 0.0; }

  // All degrees of freedom that are coupled to `first`, directly or through others, including
  // `first`.
  std::vector<int> group(int first, const std::vector<int>& among) const {
    std::vector<int> all{first};
    for (std::size_t k = 0; k < all.size(); ++k) {
      for (const int other : among) {
        if (linked(all[k], other) && !is_in(all, other)) all.push_back(other);
      }
    }
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  void add(const MatrixXd& a) {
    const double largest = a.diagonal().cwiseAbs().maxCoeff();
    for (int i = 0; i < a.rows(); ++i) {
      for (int j = 0; j < a.cols(); ++j) {
        double own = std::sqrt(std::abs(a(i, i) * a(j, j)));
        if (!(own > 0.0)) own = largest;
        if (i != j && std::abs(a(i, j)) + std::abs(a(j, i)) > kNone * own) {
          linked_(i, j) = linked_(j, i) = 1.0;
        }
      }
    }
  }

  MatrixXd linked_;
};

bool moves(const MatrixXd& rows, int row, int dof) {
  return std::abs(rows(row, dof)) > kNone * rows.cwiseAbs().maxCoeff();
}
bool moves(const MatrixXd& rows, int dof) { return moves(rows, 0, dof) || moves(rows, 1, dof); }
bool moves_rotor(const LinearMachine& machine, int row, int dof) {
  return std::any_of(machine.contacts.begin(), machine.contacts.end(),
                     [&](const LinearContact& c) { return moves(c.rotor, row, dof); });
}

// A ring's degrees of freedom: none, or two that move it in x and y and nothing else.
std::vector<int> ring_dofs(const mjModel* m, const LinearMachine& machine,
                           const LinearContact& contact, const Links& links) {
  std::vector<int> ring;
  for (int i = 0; i < m->nv; ++i) {
    if (!moves(contact.ring, i)) continue;
    if (moves_rotor(machine, 0, i) || moves_rotor(machine, 1, i)) {
      refuse(joint_of_dof(m, i), "moves rotor and ring; for `compare` a joint moves one of them");
    }
    for (const LinearContact& other : machine.contacts) {
      if (&other == &contact || !moves(other.ring, i)) continue;
      refuse(joint_of_dof(m, i), "moves two rings; for `compare` each ring has its own joints");
    }
    ring.push_back(i);
  }
  if (ring.empty()) return ring;
  if (ring.size() != 2) {
    refuse(joint_of_dof(m, ring.front()),
           "is one of " + text(static_cast<int>(ring.size())) +
               " that move the ring; `compare` needs two, along x and y of its geom, or none");
  }
  if (moves(contact.ring, 0, ring[1])) std::swap(ring[0], ring[1]);
  for (int k = 0; k < 2; ++k) {
    const int dof = ring[static_cast<std::size_t>(k)];
    if (moves(contact.ring, 1 - k, dof) || !moves(contact.ring, k, dof)) {
      refuse(
          joint_of_dof(m, dof),
          "does not move the ring along x or y of the first ring's geom; `compare` needs a joint "
          "along one of them (a round geom may be turned about its axis)");
    }
    for (int other = 0; other < m->nv; ++other) {
      if (other == dof || !links.linked(dof, other)) continue;
      refuse(joint_of_dof(m, dof),
             "acts on " + joint_of_dof(m, other) +
                 "; `compare` needs a ring whose two joints act on nothing else");
    }
  }
  return ring;
}

// Refuses a joint that turns the rotor and is coupled to another joint at rest.
void refuse_linked_spin(const mjModel* m, int spin, const Links& links,
                        const std::vector<int>& others) {
  for (const int i : others) {
    if (spin < 0 || !links.linked(spin, i)) continue;
    refuse(joint_of_dof(m, spin),
           "acts on " + joint_of_dof(m, i) +
               " at rest; for `compare` only unbalance couples spin and bending");
  }
}

// Refuses a joint that turns a ring and is coupled to another joint, or whose ring does not move
// (scene::Stator).
void refuse_linked_turn(const mjModel* m, int turn, const Links& links,
                        const std::vector<int>& ring) {
  if (turn < 0) return;
  if (ring.empty()) {
    refuse(
        joint_of_dof(m, turn),
        "turns a ring that does not move; for `compare` such a ring needs joints along x and y as "
        "well");
  }
  for (int i = 0; i < m->nv; ++i) {
    if (i == turn || !links.linked(turn, i)) continue;
    refuse(joint_of_dof(m, turn),
           "acts on " + joint_of_dof(m, i) +
               "; `compare` needs a ring whose turning acts on nothing else");
  }
}

TwinPlane modes_of(std::vector<int> dofs, const LinearMachine& machine, int row) {
  TwinPlane plane;
  std::sort(dofs.begin(), dofs.end());
  const auto n = static_cast<Eigen::Index>(dofs.size());
  const MatrixXd mass = machine.mass(dofs, dofs);
  const MatrixXd k = machine.stiffness(dofs, dofs);
  const MatrixXd even = 0.5 * (k + k.transpose());
  const std::optional<SymmetricModes> modes = symmetric_modes(even, mass);
  if (!modes)
    throw ConfigError(
        "rotorub: the modes of its rotor are not found, so there is no native model to compare "
        "with");
  plane.shapes = modes->vectors;  // with modal masses of 1
  for (const LinearContact& contact : machine.contacts) {
    plane.contacts.push_back(plane.shapes.transpose() * contact.rotor.row(row)(dofs).transpose());
  }
  plane.dofs = std::move(dofs);
  const VectorXd first = plane.contacts.front();
  const double largest = first.cwiseAbs().maxCoeff();
  plane.mass = VectorXd::Ones(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double c = first[j];
    if (std::abs(c) <= kNone * largest) {
      plane.contacts.front()[j] = 0.0;
      continue;
    }
    for (VectorXd& at : plane.contacts) at[j] /= c;
    plane.shapes.col(j) /= c;
    plane.mass[j] = 1.0 / (c * c);
  }
  plane.stiffness = modes->values.cwiseProduct(plane.mass);
  plane.inverse = plane.mass.cwiseInverse().asDiagonal() * plane.shapes.transpose() * mass;
  return plane;
}

// Adds modes without motion, so that both planes have the same number.
void pad(TwinPlane& plane, Eigen::Index modes) {
  const Eigen::Index had = plane.mass.size(), more = modes - had;
  if (more <= 0) return;
  const auto n = plane.shapes.rows();
  plane.shapes.conservativeResize(n, modes);
  plane.shapes.rightCols(more).setZero();
  plane.inverse.conservativeResize(modes, n);
  plane.inverse.bottomRows(more).setZero();
  const auto lengthen = [&](VectorXd& list, double value) {
    list.conservativeResize(modes);
    list.tail(more).setConstant(value);
  };
  lengthen(plane.mass, 1.0);
  lengthen(plane.stiffness, 0.0);
  for (VectorXd& at : plane.contacts) lengthen(at, 0.0);
}

}  // namespace

TwinPlanes part_planes(const mjModel* m, const LinearMachine& machine) {
  const Links links(machine);
  TwinPlanes planes;
  std::vector<int> left(static_cast<std::size_t>(count(m->nv)));
  std::iota(left.begin(), left.end(), 0);
  for (const LinearContact& contact : machine.contacts) {
    const std::vector<int>& ring = planes.rings.emplace_back(ring_dofs(m, machine, contact, links));
    std::erase_if(left, [&](int i) { return i == contact.ring_turn.dof || is_in(ring, i); });
  }
  std::erase(left, machine.spin.dof);
  refuse_linked_spin(m, machine.spin.dof, links, left);
  for (std::size_t k = 0; k < planes.rings.size(); ++k) {
    refuse_linked_turn(m, machine.contacts[k].ring_turn.dof, links, planes.rings[k]);
  }
  std::vector<int> of[2], rest;
  while (!left.empty()) {
    const std::vector<int> group = links.group(left.front(), left);
    std::erase_if(left, [&](int i) { return is_in(group, i); });
    int joint[2] = {-1, -1};
    for (const int i : group) {
      for (int k = 0; k < 2; ++k) {
        if (moves_rotor(machine, k, i)) joint[k] = i;
      }
    }
    if (joint[0] >= 0 && joint[1] >= 0) {
      refuse(
          joint_of_dof(m, joint[0]),
          "moves with " + joint_of_dof(m, joint[1]) +
              ", and they move the rotor in both planes of the ring's geom; `compare` needs planes "
              "that do not act on each other (a round geom may be turned about its axis)");
    }
    std::vector<int>& to = joint[0] >= 0 ? of[0] : joint[1] >= 0 ? of[1] : rest;
    to.insert(to.end(), group.begin(), group.end());
  }
  // A degree of freedom that only gyroscopics couple to a plane belongs to the other plane.
  const double largest = machine.gyroscopic.cwiseAbs().maxCoeff();
  const auto acts_on = [&](int dof, const std::vector<int>& plane) {
    return std::any_of(plane.begin(), plane.end(), [&](int i) {
      return !(std::abs(machine.gyroscopic(i, dof)) <= kNone * largest);
    });
  };
  for (auto dof = rest.begin(); dof != rest.end();) {
    const bool on_x = acts_on(*dof, of[0]);
    if (!on_x && !acts_on(*dof, of[1])) {
      ++dof;
      continue;
    }
    of[on_x ? 1 : 0].push_back(*dof);
    rest.erase(dof);
    dof = rest.begin();  // it may couple an earlier one
  }
  for (int k = 0; k < 2; ++k) {
    TwinPlane& plane = k == 0 ? planes.x : planes.y;
    if (!of[k].empty()) plane = modes_of(of[k], machine, k);
    if (!of[k].empty() && !plane.contacts.front().isZero(0.0)) continue;
    throw ConfigError("rotorub: no joint moves the rotor along " + std::string(k == 0 ? "x" : "y") +
                      " of the ring's geom; `compare` needs a rotor that moves in both planes");
  }
  const Eigen::Index modes = std::max(planes.x.mass.size(), planes.y.mass.size());
  pad(planes.x, modes);
  pad(planes.y, modes);
  planes.ignored = rest;
  return planes;
}

}  // namespace rotorub::plugin
