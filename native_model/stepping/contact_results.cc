// Records the results of the contacts in a fixed step (step_contacts.h), also if the step is taken
// in two parts.
#include "native_model/stepping/step_contacts.h"

namespace rotorub {

// ------------------------------------------------------------------ a step in two parts
bool StepContacts::lasts_unchanged(const States& before, const States& part) const {
  for (std::size_t i = 0; i < count(); ++i) {
    if (!contacts_[i].rigid || !before[i].closed) continue;
    if (!part[i].closed || part[i].slip_sign != before[i].slip_sign) return false;
  }
  return true;
}

StepContacts::States StepContacts::second_part_start(const States& before,
                                                     const States& first) const {
  States second = before;
  for (std::size_t i = 0; i < count(); ++i) {
    if (contacts_[i].rigid) second[i].slip_sign = first[i].slip_sign;
  }
  return second;
}

void StepContacts::join_parts(double share, double rest, const States& first, double kick_length) {
  for (std::size_t i = 0; i < count(); ++i) {
    State& c = states[i];
    c.normal_at_end = c.normal / kick_length;
    c.friction_at_end = c.friction / kick_length;
    c.normal = share * first[i].normal + rest * c.normal;
    c.friction = share * first[i].friction + rest * c.friction;
  }
  record_lasting();
}

void StepContacts::restore_whole_step(const States& mean) {
  states = mean;
  record_lasting();
}

// ------------------------------------------------------------------ results of the step
void StepContacts::record_lasting() {
  has_results_ = true;
  for (std::size_t i = 0; i < count(); ++i) {
    const State& c = states[i];
    ContactStep& done = results_[i];
    done = {};
    if (!c.closed || !(c.normal > 0.0)) continue;
    done.mode = c.slip_sign == 0.0 ? ContactMode::kStick : ContactMode::kSlide;
    done.reversed = contacts_[i].last_sign * c.slip_sign < 0.0;
    done.normal_impulse = c.normal;
    done.friction_impulse = c.friction;
    done.lasting = {c.normal, c.friction};
  }
}

void StepContacts::set_closed(std::size_t i, bool closed) {
  if (states[i].closed != closed) states[i].slip_sign = 0.0;
  states[i].closed = closed;
}

void StepContacts::add_impact(const Impact& impact, bool listed) {
  ContactStep& done = results_[static_cast<std::size_t>(impact.contact)];
  impacted_ = has_results_ = true;
  done.normal_impulse += impact.normal_impulse;
  done.friction_impulse += impact.friction_impulse;
  if (listed) impacts.push_back(impact);
}

void StepContacts::write_results(const Eigen::Vector2d& impact_force, FixedStep& out) {
  results_[0].impact_force = impact_force;
  out.contacts = results_;
  out.impacts = impacts;
}

double StepContacts::lasting_work(const double* mean) const {
  if (!has_results_) return 0.0;
  double work = 0.0;
  for (std::size_t i = 0; i < count(); ++i) {
    if (!(results_[i].lasting.x() > 0.0)) continue;
    const Contact& c = contacts_[i];
    work += rotorub::lasting_work(m_, i, {c.e_r.x, c.e_r.y}, results_[i].lasting, rates(i, mean));
  }
  return work;
}

}  // namespace rotorub
