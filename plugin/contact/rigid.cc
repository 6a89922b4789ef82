#include "plugin/contact/rigid.h"

#include <array>
#include <optional>

#include "native_model/contact/coupled_law.h"
#include "native_model/contact/kinematics.h"
#include "plugin/actuators.h"
#include "plugin/contact/constraint_probe.h"
#include "plugin/contact/contact_memory.h"
#include "plugin/contact/contact_space.h"
#include "plugin/contact/coupled_step.h"
#include "plugin/contact/relative_motion.h"
#include "plugin/passes.h"

namespace rotorub::plugin {

namespace {

RigidStep begin_step(const ContactPair& pair, const ContactPlace& place, const BodySpace& space,
                     const mjModel* m, const mjData* d) {
  RigidStep step;
  step.h = m->opt.timestep;
  step.d = place.d;
  step.bend = 0.5 * step.h * step.h * turning_of(pair, place, m, d);
  step.start = space.rates(d->qvel);
  step.start.z() += pair.held_spin;
  return step;
}

void apply_one(const ContactPair& pair, const mjModel* m, mjData* d) {
  const ContactPlace place = contact_place(pair, d);
  const StepMatrix matrix(m, d);
  BodySpace space(pair, place, m, d, matrix);
  space.solve();
  RigidStep step = begin_step(pair, place, space, m, d);
  apply_rigid_step(m, d, space, step, pair.contact, pair.data);
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

void apply_several(std::span<const ContactPair* const> pairs, const mjModel* m, mjData* d) {
  const StepMatrix matrix(m, d);
  // On the stack of mjData: the last made goes first.
  std::array<std::optional<BodySpace>, kMaxContacts> spaces, axial;
  std::array<CoupledMember, kMaxContacts> members;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ContactPlace place = contact_place(*pairs[i], d);
    BodySpace& space = spaces[i].emplace(*pairs[i], place, m, d, matrix);
    space.solve();
    CoupledMember& member = members[i];
    member.space = &space;
    member.contact = &pairs[i]->contact;
    member.data = pairs[i]->data;
    member.step = begin_step(*pairs[i], place, space, m, d);
    member.held = contact_enabled(m) && constraints_couple(m, d, space);
    if (!pairs[i]->axial) continue;
    BodySpace& along = axial[i].emplace(*pairs[i], place, m, d, matrix, BodyRows::kAxis);
    along.solve();
    member.axial = &along;
    member.axial_start = along.rates(d->qvel);
    member.held = member.held || (contact_enabled(m) && constraints_couple(m, d, along));
  }
  const std::span<CoupledMember> all(members.data(), pairs.size());
  std::array<bool, kMaxContacts> left{};
  left.fill(true);
  Group group{};
  while (const std::size_t count = take_group(all, left, group)) {
    if (count == 1 && !group[0]->axial) {
      CoupledMember& one = *group[0];
      apply_rigid_step(m, d, *one.space, one.step, *one.contact, one.data);
    } else {
      apply_coupled_step(m, d, {group.data(), count});
    }
  }
  for (std::size_t i = pairs.size(); i-- > 0;) {
    axial[i].reset();
    spaces[i].reset();
  }
}

}  // namespace

void apply_rigid(std::span<const ContactPair> pairs, const mjModel* m, mjData* d) {
  update_smooth_force(m, d);
  Reach reach(m, d);
  std::array<const ContactPair*, kMaxContacts> facing{};
  std::size_t count = 0;
  bool near = false;
  for (const ContactPair& pair : pairs) {
    if (pair.law != scene::ContactModel::kRigid) continue;
    ContactMemory memory(d, pair.data, m->opt.timestep);
    if (!face_each_other(pair, d)) {
      memory.begin_anew();
      memory.note({}, m->opt.timestep);
      continue;
    }
    facing[count++] = &pair;
    near = near || memory.was_in_contact() || reach.may_reach(pair);
  }
  if (!near) {
    for (std::size_t i = 0; i < count; ++i) {
      ContactMemory memory(d, facing[i]->data, m->opt.timestep);
      memory.watch(0.0, facing[i]->contact);  // within its ring, as far as that matters
      memory.note({}, m->opt.timestep);
    }
  } else if (count == 1 && !facing[0]->axial) {
    apply_one(*facing[0], m, d);
  } else {
    apply_several({facing.data(), count}, m, d);
  }
}

namespace {

void add_impulses(const RigidResult& r, const RigidStep& step, const ContactParameters& contact,
                  const ContactSpace& space, mjData* d) {
  if (!(r.normal > 0.0)) return;
  const Eigen::Vector3d load =
      contact_load(r.e_r, contact.radius, r.normal / step.h, r.friction / step.h);
  space.add(load, r.impact, d->qfrc_passive);
}

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

RigidResult solve(RigidStep& step, const ContactParameters& contact, const ContactSpace& space,
                  ContactMemory& memory, StepResponse* held) {
  if (!reaches_ring(step, contact.clearance)) return {};
  step.was_in_contact = memory.was_in_contact(step.d.norm(), contact.clearance);
  step.lasting_admittance = with_spin(space.flexibility(), contact.radius);
  // Only what was open has an impact.
  if (!step.was_in_contact) step.impact_admittance = with_spin(space.admittance(), contact.radius);
  if (!can_open(step, contact.clearance)) {
    RigidResult none;
    none.status = Status::kNoSolution;
    return none;
  }
  return solve_rigid_step(step, contact, held);
}

RigidResult solve_held(const mjModel* m, mjData* d, const ContactSpace& space, RigidStep& step,
                       const ContactParameters& contact, ContactMemory& memory) {
  mj_fwdAcceleration(m, d);
  ConstraintProbe probe(m, d);
  ProbedStep held(probe, space, step.start, step.h);
  step.free = held.end(Eigen::Vector3d::Zero(), false);
  const RigidResult r = solve(step, contact, space, memory, &held);
  if (r.normal > 0.0) {
    held.end(contact_load(r.e_r, contact.radius, r.normal, r.friction), r.impact);
    probe.keep();
  }
  return r;
}

}  // namespace

void apply_rigid_step(const mjModel* m, mjData* d, const ContactSpace& space, RigidStep& step,
                      const ContactParameters& contact, int data) {
  ContactMemory memory(d, data, step.h);
  step.free = step.start + step.h * space.response(d->qfrc_smooth);
  RigidResult r;
  if (!contact_enabled(m)) {
    memory.note(r, step.h);
    return;
  }
  memory.watch(step.d.norm(), contact);
  if (!constraints_couple(m, d, space)) {
    r = solve(step, contact, space, memory, nullptr);
  } else {
    r = solve_held(m, d, space, step, contact, memory);
    if (!r.converged && !memory.warned()) warn_unsolved(m, d, space);
  }
  memory.note(r, step.h);
  add_impulses(r, step, contact, space, d);
}

}  // namespace rotorub::plugin
