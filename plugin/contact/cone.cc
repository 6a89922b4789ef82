#include "plugin/contact/cone.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "plugin/contact/cone_rows.h"
#include "plugin/contact/constraint_probe.h"
#include "plugin/model/actuators.h"
#include "plugin/model/mujoco_dynamics.h"

namespace rotorub::plugin {

// aref = -B v in a friction row, where v is the velocity of geom 2 against geom 1 along the frame's
// second axis. It is minus the slip of the rotor's surface if the rotor is geom 1; if it is not,
// e_t is reversed.
void add_prescribed_slip(double surface_speed, const mjModel* m, mjData* d,
                         const mjContact& contact) {
  const double slip = -surface_speed;
  const auto add = [d](int row, double rate) {
    d->efc_vel[row] += rate;
    d->efc_aref[row] -= d->efc_KBIP[4 * row + 1] * rate;
  };
  const int first = contact.efc_address;
  if (!is_pyramid(m, contact)) {
    add(first + 1, slip);
    return;
  }
  // The two edges of the pyramid along this axis: v_N +- mu v_T.
  add(first, contact.friction[0] * slip);
  add(first + 1, -contact.friction[0] * slip);
}

// For a pyramid, changes the reference of the edges in the tangential part of v.
void set_friction_reference(const mjModel* m, mjData* d, const mjContact& contact,
                            double reference) {
  const int first = contact.efc_address;
  if (!is_pyramid(m, contact)) {
    for (int row = first + 1; row < first + contact.dim; ++row)
      d->efc_aref[row] = -reference * d->efc_vel[row];
    return;
  }
  for (int edge = first; edge < first + 2 * (contact.dim - 1); edge += 2) {
    const double tangential = 0.5 * (d->efc_vel[edge] - d->efc_vel[edge + 1]);
    const double change = (d->efc_KBIP[4 * edge + 1] - reference) * tangential;
    d->efc_aref[edge] += change;
    d->efc_aref[edge + 1] -= change;
  }
}

namespace {

void shift_reference(const mjModel* m, mjData* d, const ConeRows& rows, double by) {
  const int shifted = is_pyramid(m, *rows.contact) ? rows.count : 1;
  for (int i = 0; i < shifted; ++i) d->efc_aref[rows.first + i] -= by;
}

// Sets the reference of a contact on its ring as described in cone.h. False: the step leaves the
// gap open, and the contact has no force.
bool follow_ring(const mjModel* m, mjData* d, const ConeRows& rows, double curvature,
                 const mjtNum* free) {
  constexpr double kResting = -1e12;  // m/s^2
  const double h = m->opt.timestep, lag = m->opt.integrator == mjINT_RK4 ? 0.0 : 0.5 * h;
  const mjtNum* kbip = d->efc_KBIP + 4 * rows.first;
  const double gap = d->efc_pos[rows.first];
  // The velocity of a semi-implicit step is half a step old: on a circle it points outward by h/2
  // v_t^2 / delta.
  const double rate = along(m, rows, d->efc_vel, 0);
  const double stays = gap + h * (rate + h * (along(m, rows, free, 0) - curvature));
  if (gap > 0.0 && stays > 0.0) {
    shift_reference(m, d, rows, -kResting);
    return false;
  }
  shift_reference(
      m, d, rows,
      kbip[0] * kbip[2] * d->efc_margin[rows.first] - curvature * (1.0 - lag * kbip[1]));
  return true;
}

// The model with the solver of the trials, if it is not MuJoCo's own one. PGS changes one force at
// a time, and with an elliptic cone it does not find the force of a contact that slides from 0
// (cone_rows.cc), so Newton solves the trials. MuJoCo's PGS then starts from their solution.
std::optional<mjModel> with_solver_of_trials(const mjModel* m) {
  if (m->opt.solver != mjSOL_PGS || mj_isPyramidal(m)) return std::nullopt;
  mjModel copy = *m;  // with the arrays of m
  copy.opt.solver = mjSOL_NEWTON;
  return copy;
}

// MuJoCo's solver, tried with shifted references. Uses the stack of mjData during its lifetime.
class ShiftedSolver {
 public:
  ShiftedSolver(const mjModel* m, mjData* d)
      : m_(m),
        d_(d),
        of_trials_(with_solver_of_trials(m)),
        probe_(of_trials_ ? &*of_trials_ : m, d),
        room_(d),
        y_(room_.numbers(d->nefc)) {}
  ShiftedSolver(const ShiftedSolver&) = delete;
  ShiftedSolver& operator=(const ShiftedSolver&) = delete;

  // Solves with the present shifts of the contacts.
  void solve(std::span<const ConeRows> contacts) {
    for (const ConeRows& c : contacts) shift_reference(m_, d_, c, c.shift);
    probe_.solve([](mjtNum*) {});
    mj_mulJacVec(m_, d_, y_, d_->qacc);
    for (int i = 0; i < d_->nefc; ++i) y_[i] += d_->efc_R[i] * d_->efc_force[i] - d_->efc_aref[i];
    for (const ConeRows& c : contacts) shift_reference(m_, d_, c, -c.shift);
  }
  // |z| of a contact in the last solution, in the norm of the dual cone.
  double lift(const ConeRows& rows) const {
    double sum = 0.0, largest = 0.0;
    for (int i = 1; i < rows.contact->dim; ++i) {
      const double z = along(m_, rows, y_, i);
      sum += z * z;
      largest = std::max(largest, std::abs(z));
    }
    return is_pyramid(m_, *rows.contact) ? largest : std::sqrt(sum);
  }
  // True if the contact sticks or is open in the last solution.
  bool rests(const ConeRows& c) const {
    constexpr double kStuck = 1e-10;  // relative to the terms of y
    double terms = 0.0, force = 0.0;
    for (int row = c.first; row < c.first + c.count; ++row) {
      terms = std::max(terms, std::abs(d_->efc_aref[row]) + std::abs(y_[row]));
      force = std::max(force, std::abs(d_->efc_force[row]));
    }
    return force == 0.0 || lift(c) <= kStuck * terms;
  }
  // Call it if the last solution is the solution of the pass.
  void keep() { probe_.keep(); }

 private:
  const mjModel* m_;
  mjData* d_;
  std::optional<mjModel> of_trials_;
  ConstraintProbe probe_;
  StackFrame room_;
  mjtNum* y_;
};

// The first trial, without a shift. True if each contact sticks or is open in its solution, which
// then obeys Coulomb's law.
bool none_slides(const mjModel* m, mjData* d, std::span<const ConeRows> contacts) {
  ShiftedSolver solver(m, d);
  solver.solve(contacts);
  const bool none = std::all_of(contacts.begin(), contacts.end(),
                                [&solver](const ConeRows& c) { return solver.rests(c); });
  if (none) solver.keep();
  return none;
}

// True if the shifts of all groups are exact without MuJoCo's solver. Otherwise they are guesses
// for its further trials.
bool solve_groups(const mjModel* m, mjData* d, std::span<ConeRows> contacts) {
  bool exact = true;
  const bool alone = row_count(contacts) == d->nefc;
  for (const std::span<ConeRows> group : groups_of(m, contacts)) {
    exact = solve_group(m, d, group, alone) && exact;
  }
  return exact;
}

// Further trials from the present shifts, until they equal the |z| of MuJoCo's solution, by the
// secant method. The plain iteration converges while mu^2 A_TT < A_NN; the secant method converges
// beyond that too.
void settle_shifts(const mjModel* m, mjData* d, std::span<ConeRows> contacts) {
  constexpr int kMostTrials = 12;
  constexpr double kSettled = 1e-7;  // relative to the shift
  struct Answer {
    double shift, lift;
  };
  std::vector<Answer> last;
  ShiftedSolver solver(m, d);
  for (int trial = 0; trial < kMostTrials; ++trial) {
    solver.solve(contacts);
    bool settled = true;
    std::vector<Answer> now;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      ConeRows& c = contacts[k];
      now.push_back({c.shift, solver.lift(c)});
      const Answer& answer = now.back();
      settled = settled && std::abs(answer.lift - answer.shift) <=
                               kSettled * std::max(answer.lift, answer.shift);
      c.shift = answer.lift;
      if (last.empty() || answer.shift == last[k].shift) continue;
      const double slope = (answer.lift - last[k].lift) / (answer.shift - last[k].shift);
      if (std::abs(1.0 - slope) > 0.05) {
        c.shift = std::max(0.0, (answer.lift - slope * answer.shift) / (1.0 - slope));
      }
    }
    if (settled) break;
    last = std::move(now);
  }
  solver.keep();
}

}  // namespace

void correct_cones(const mjModel* m, mjData* d, std::span<const SlidingContact> contacts) {
  if (contacts.empty()) return;
  compute_actuators(m, d);
  mj_fwdAcceleration(m, d);
  StackFrame room(d);
  mjtNum* free = room.numbers(d->nefc);
  mj_mulJacVec(m, d, free, d->qacc_smooth);
  std::vector<ConeRows> cones;
  for (const SlidingContact& c : contacts) {
    const ConeRows rows{c.contact, c.contact->efc_address, row_count(m, *c.contact)};
    if (c.curvature && !follow_ring(m, d, rows, *c.curvature, free)) continue;
    if (c.contact->dim >= 3) cones.push_back(rows);
  }
  if (cones.empty()) return;
  // For a single contact its own solution costs less than this trial.
  if (cones.size() > 1 && none_slides(m, d, cones)) return;
  if (!solve_groups(m, d, cones)) settle_shifts(m, d, cones);
  for (const ConeRows& c : cones) shift_reference(m, d, c, c.shift);
}

}  // namespace rotorub::plugin
