// What the contacts did in a fixed step (step_contacts.h), and the results of a step in two parts.
#include "native_model/stepping/step_contacts.h"

namespace rotorub {

// ------------------------------------------------------------------ a step in two parts
bool StepContacts::alike(const State& part, const State& was) const {
  for (std::size_t i = 0; i < count(); ++i) {
    if (!contacts_[i].rigid || !was[i].closed) continue;
    if (!part[i].closed || part[i].slip_sign != was[i].slip_sign) return false;
  }
  return true;
}

StepContacts::State StepContacts::second_part(const State& was, const State& first) const {
  State second = was;
  for (std::size_t i = 0; i < count(); ++i) {
    if (contacts_[i].rigid) second[i].slip_sign = first[i].slip_sign;
  }
  return second;
}

void StepContacts::join_parts(double share, double rest, const State& first, double kick) {
  for (std::size_t i = 0; i < count(); ++i) {
    Kept& c = now[i];
    c.normal_at_end = c.normal / kick;
    c.friction_at_end = c.friction / kick;
    c.normal = share * first[i].normal + rest * c.normal;
    c.friction = share * first[i].friction + rest * c.friction;
  }
  note_lasting();
}

void StepContacts::go_on_as(const State& mean) {
  now = mean;
  note_lasting();
}

// ------------------------------------------------------------------ what the step did
void StepContacts::note_lasting() {
  did_ = true;
  for (std::size_t i = 0; i < count(); ++i) {
    const Kept& c = now[i];
    ContactStep& done = done_[i];
    done = {};
    if (!c.closed || !(c.normal > 0.0)) continue;
    done.mode = c.slip_sign == 0.0 ? Mode::kStick : Mode::kSlide;
    done.reversed = contacts_[i].last_sign * c.slip_sign < 0.0;
    done.normal_impulse = c.normal;
    done.friction_impulse = c.friction;
    done.lasting = {c.normal, c.friction};
  }
}

void StepContacts::set_closed(std::size_t i, bool closed) {
  if (now[i].closed != closed) now[i].slip_sign = 0.0;
  now[i].closed = closed;
}

void StepContacts::note_impact(const Impact& impact, bool listed) {
  ContactStep& done = done_[static_cast<std::size_t>(impact.contact)];
  impacted_ = did_ = true;
  done.normal_impulse += impact.normal_impulse;
  done.friction_impulse += impact.friction_impulse;
  if (listed) impacts.push_back(impact);
}

void StepContacts::tell(FixedStep& out) const {
  static_cast<ContactStep&>(out) = done_[0];
  out.others = std::span(done_).subspan(1);
  out.impacts = impacts;
}

double StepContacts::lasting_work(const StepState& x) const {
  const double *start = x.start.data(), *end = end_without_impacts(x);
  double mean[kMaxCoordinates], work = 0.0;
  if (did_) {
    for (int j = 0; j < x.nq(); ++j) mean[j] = 0.5 * (start[j] + end[j]);
  }
  for (std::size_t i = 0; i < count(); ++i) {
    if (!(done_[i].lasting.x() > 0.0)) continue;
    const Contact& c = contacts_[i];
    work += rotorub::lasting_work(m_, i, {c.e_r.x, c.e_r.y}, done_[i].lasting, rates(i, mean));
  }
  return work;
}

}  // namespace rotorub
