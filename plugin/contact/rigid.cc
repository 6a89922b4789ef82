#include "plugin/contact/rigid.h"

#include <array>
#include <span>

#include "native_model/contact/coupled_law.h"
#include "native_model/contact/kinematics.h"
#include "native_model/scene/mujoco.h"
#include "plugin/contact/constraint_probe.h"
#include "plugin/contact/contact_memory.h"
#include "plugin/contact/contact_space.h"
#include "plugin/contact/noted_contact.h"
#include "plugin/contact/relative_motion.h"
#include "plugin/contact/rigid_solver.h"
#include "plugin/model/actuators.h"
#include "plugin/model/options.h"

namespace rotorub::plugin {
namespace {

// True if an impulse of one may change the rates of the other.
bool moves_with(const RigidContact& a, const RigidContact& b) {
  if (a.held && b.held) return true;
  const auto answers = [](const ContactSpace* at, const ContactSpace* to) {
    return at && to && !at->admittance(*to).isZero(0.0);
  };
  return answers(a.space, b.space) || answers(a.space, b.axial) || answers(a.axial, b.space) ||
         answers(a.axial, b.axial);
}

using Group = std::array<RigidContact*, kMaxContacts>;

// Finds the first remaining contact and all contacts coupled to it, directly or through others,
// because their bodies are in one tree or constraints act on them. Removes them from `left`.
std::size_t take_group(std::span<RigidContact> all, std::array<bool, kMaxContacts>& left,
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

void note_results(const mjModel* m, mjData* d, std::span<RigidContact* const> group) {
  const double h = m->opt.timestep;
  const RigidContact* unsolved = nullptr;
  bool warned = false;
  for (const RigidContact* at : group) {
    ContactMemory memory(d, *at->pair, h);
    warned = warned || memory.warned();
    if (at->held && !at->result.converged) unsolved = at;
    memory.note(at->result, h);
    if (at->axial) note_contact(d, at->pair->data, at->result.e_r, at->axial_friction / h);
  }
  if (unsolved && !warned) warn_unsolved(m, d, *unsolved->space);
}

void solve_groups(const mjModel* m, mjData* d, std::span<RigidContact> all) {
  std::array<bool, kMaxContacts> left{};
  left.fill(true);
  Group group{};
  while (const std::size_t count = take_group(all, left, group)) {
    const std::span<RigidContact* const> members(group.data(), count);
    solve_rigid_contacts(m, d, members, d->qfrc_passive);
    note_results(m, d, members);
  }
}

// Solves all contacts that face each other, in a step in which at least one may close.
void solve_facing(const Config& config, std::span<const ContactPair* const> pairs, const mjModel* m,
                  mjData* d) {
  const double h = m->opt.timestep;
  ContactSpaces spaces(config, m, d);
  std::array<RigidContact, kMaxContacts> members;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ContactPair& pair = *pairs[i];
    const auto [place, plane, axial] = spaces.add(pair);
    RigidContact& member = members[i];
    member.pair = &pair;
    member.space = plane;
    member.axial = axial;
    member.step.h = h;
    member.step.d = place.d;
    member.step.bend = 0.5 * h * h * turning_of(pair, place, m, d);
    member.step.start = plane->rates(d->qvel);
    member.step.start.z() += pair.held_spin;
    ContactMemory memory(d, pair, h);
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
    ContactMemory memory(d, pair, m->opt.timestep);
    if (!face_each_other(pair, d)) {
      memory.begin_anew();
      memory.note({}, m->opt.timestep);
      continue;
    }
    facing[count++] = &pair;
    near = near || memory.was_in_contact() || reach.may_reach(pair);
  }
  if (near && contact_enabled(m)) {
    solve_facing(config, {facing.data(), count}, m, d);
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    ContactMemory memory(d, *facing[i], m->opt.timestep);
    // The rotor is well within its ring; the exact gap does not matter.
    if (!near) memory.watch(0.0, facing[i]->contact);
    memory.note({}, m->opt.timestep);
  }
}

}  // namespace rotorub::plugin
