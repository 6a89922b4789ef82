#include "plugin/contact/rigid.h"

#include <array>
#include <span>

#include "native_model/contact/coupled_law.h"
#include "native_model/contact/kinematics.h"
#include "native_model/scene/mujoco.h"
#include "plugin/contact/constraint_probe.h"
#include "plugin/contact/contact_memory.h"
#include "plugin/contact/contact_space.h"
#include "plugin/contact/coupled_step.h"
#include "plugin/contact/noted_contact.h"
#include "plugin/contact/relative_motion.h"
#include "plugin/model/actuators.h"
#include "plugin/model/options.h"

namespace rotorub::plugin {
namespace {

// A rotor that can neither slip nor spin (one slide) has G_TT = 0: a trace of it, that of a spin
// that nothing is asked of, leaves the 2x2 problem solvable.
Eigen::Matrix3d with_spin(Eigen::Matrix3d admittance, double radius) {
  constexpr double kTrace = 1e-12;
  if (admittance(2, 2) == 0.0) {
    admittance(2, 2) = kTrace * (admittance(0, 0) + admittance(1, 1)) / (radius * radius);
  }
  return admittance;
}

// False: no impulse of the contact opens the gap. Nothing that moves is beside the normal.
bool can_open(const RigidStep& step, double clearance) {
  const Eigen::Vector2d e_r = contact_normal(step, clearance);
  const Eigen::Matrix2d g = step.lasting_admittance.topLeftCorner<2, 2>();
  return e_r.dot(g * e_r) > 1e-12 * g.trace();
}

// From `free` of the step on.
RigidResult solve(CoupledMember& at, StepResponse* held) {
  RigidStep& step = at.step;
  const ContactParameters& contact = at.pair->contact;
  if (!reaches_ring(step, contact.clearance)) return {};
  step.lasting_admittance = with_spin(at.space->flexibility(), contact.radius);
  // Only what was open has an impact.
  if (!step.was_in_contact) {
    step.impact_admittance = with_spin(at.space->admittance(), contact.radius);
  }
  if (!can_open(step, contact.clearance)) {
    RigidResult none;
    none.status = Status::kNoSolution;
    return none;
  }
  return solve_rigid_step(step, contact, held);
}

RigidResult solve_held(const mjModel* m, mjData* d, CoupledMember& at) {
  mj_fwdAcceleration(m, d);
  ConstraintProbe probe(m, d);
  ProbedStep held(probe, *at.space, at.step.start, at.step.h);
  at.step.free = held.end(Eigen::Vector3d::Zero(), false);
  const RigidResult r = solve(at, &held);
  if (r.normal > 0.0) {
    held.end(contact_load(r.e_r, at.pair->contact.radius, r.normal, r.friction), r.impact);
    probe.keep();
  }
  return r;
}

// A contact by itself, without motion along the axis.
void apply_one(const mjModel* m, mjData* d, CoupledMember& at) {
  const double h = at.step.h;
  if (at.held) {
    at.result = solve_held(m, d, at);
  } else {
    at.step.free = at.step.start + h * at.space->response(d->qfrc_smooth);
    at.result = solve(at, nullptr);
  }
  const RigidResult& r = at.result;
  if (!(r.normal > 0.0)) return;
  const Eigen::Vector3d load =
      contact_load(r.e_r, at.pair->contact.radius, r.normal / h, r.friction / h);
  at.space->add(load, r.impact, d->qfrc_passive);
}

// True where an impulse of one changes the rates of the other: for what is held, it may.
bool moves_with(const CoupledMember& a, const CoupledMember& b) {
  if (a.held && b.held) return true;
  const auto answers = [](const ContactSpace* at, const ContactSpace* to) {
    return at && to && !at->admittance(*to).isZero(0.0);
  };
  return answers(a.space, b.space) || answers(a.space, b.axial) || answers(a.axial, b.space) ||
         answers(a.axial, b.axial);
}

using Group = std::array<CoupledMember*, kMaxContacts>;

// Those of `all` that the first one left moves with, by way of others too; taken off `left`. Bodies
// of one tree, or held by constraints.
std::size_t take_group(std::span<CoupledMember> all, std::array<bool, kMaxContacts>& left,
                       Group& group) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < all.size() && count == 0; ++i) {
    if (!left[i]) continue;
    left[i] = false;
    group[count++] = &all[i];
  }
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t j = 0; j < all.size(); ++j) {
      if (!left[j] || !moves_with(*group[k], all[j])) continue;
      left[j] = false;
      group[count++] = &all[j];
    }
  }
  return count;
}

void note_results(const mjModel* m, mjData* d, std::span<CoupledMember* const> group) {
  const double h = m->opt.timestep;
  const CoupledMember* unsolved = nullptr;
  bool warned = false;
  for (const CoupledMember* at : group) {
    ContactMemory memory(d, at->pair->data, h);
    warned = warned || memory.warned();
    if (at->held && !at->result.converged) unsolved = at;
    memory.note(at->result, h);
    if (at->axial) note_contact(d, at->pair->data, at->result.e_r, at->axial_friction / h);
  }
  if (unsolved && !warned) warn_unsolved(m, d, *unsolved->space);
}

void solve_groups(const mjModel* m, mjData* d, std::span<CoupledMember> all) {
  std::array<bool, kMaxContacts> left{};
  left.fill(true);
  Group group{};
  while (const std::size_t count = take_group(all, left, group)) {
    const std::span<CoupledMember* const> members(group.data(), count);
    if (count == 1 && !group[0]->axial) {
      apply_one(m, d, *group[0]);
    } else {
      apply_coupled_step(m, d, members, d->qfrc_passive);
    }
    note_results(m, d, members);
  }
}

// The contacts that may close in this step.
void solve_near(const Config& config, std::span<const ContactPair* const> pairs, const mjModel* m,
                mjData* d) {
  const double h = m->opt.timestep;
  ContactSpaces spaces(config, m, d);
  std::array<CoupledMember, kMaxContacts> members;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ContactPair& pair = *pairs[i];
    const auto [place, plane, axial] = spaces.add(pair);
    CoupledMember& member = members[i];
    member.pair = &pair;
    member.space = plane;
    member.axial = axial;
    member.step.h = h;
    member.step.d = place.d;
    member.step.bend = 0.5 * h * h * turning_of(pair, place, m, d);
    member.step.start = plane->rates(d->qvel);
    member.step.start.z() += pair.held_spin;
    ContactMemory memory(d, pair.data, h);
    memory.watch(place.d.norm(), pair.contact);
    member.step.was_in_contact = memory.was_in_contact(place.d.norm(), pair.contact.clearance);
    member.held = constraints_couple(m, d, *plane);
    if (!axial) continue;
    member.axial_start = axial->rates(d->qvel);
    member.held = member.held || constraints_couple(m, d, *axial);
  }
  solve_groups(m, d, {members.data(), pairs.size()});
}

}  // namespace

void apply_rigid(const Config& config, const mjModel* m, mjData* d) {
  update_smooth_force(m, d);
  Reach reach(m, d);
  std::array<const ContactPair*, kMaxContacts> facing{};
  std::size_t count = 0;
  bool near = false;
  for (const ContactPair& pair : config.pairs) {
    if (pair.law != scene::ContactModel::kRigid) continue;
    ContactMemory memory(d, pair.data, m->opt.timestep);
    if (!face_each_other(pair, d)) {
      memory.begin_anew();
      memory.note({}, m->opt.timestep);
      continue;
    }
    facing[count++] = &pair;
    near = near || memory.was_in_contact() || pair.on_chain || reach.may_reach(pair);
  }
  if (near && contact_enabled(m)) {
    solve_near(config, {facing.data(), count}, m, d);
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    ContactMemory memory(d, facing[i]->data, m->opt.timestep);
    // Within its ring, as far as that matters.
    if (!near) memory.watch(0.0, facing[i]->contact);
    memory.note({}, m->opt.timestep);
  }
}

}  // namespace rotorub::plugin
