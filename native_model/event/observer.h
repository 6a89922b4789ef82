// What is seen of an event-driven run: rows at exact times, impacts and changes of mode, bins of
// the normal force, the energy balance and the other figures. It moves nothing.
#pragma once

#include <vector>

#include "native_model/event/smooth_step.h"
#include "native_model/model/constraint.h"
#include "native_model/model/finite_impact.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {

class Observer {
 public:
  Observer(const Model& model, const EventParameters& parameters, Phase& phase);

  void begin(const Motion& start, Recorder& recorder);
  // The rows of the start, after an impact of that very instant.
  void started(const Motion& motion);

  // Before the motion goes on to `now`: by a step, or by a part of an impact.
  void watch(const Motion& from, SmoothStep& step, Constraint& constraint, double now);
  void watch(const Motion& from, const FiniteImpact& impact, std::size_t phase, double now);
  // Where it has arrived.
  void arrive(const Motion& motion);
  // What is known at a time within a step, and where it has arrived. Valid until the next call.
  Snapshot within(const Motion& from, SmoothStep& step, Constraint& constraint, double t);
  Snapshot snapshot(double t, const double* y);
  // N s, normal, of a contact up to one of these, with its impacts.
  double normal_impulse(const Snapshot& at, std::size_t contact) const;
  // A contact that gives begins to press, and no longer does: an impact is all that it does
  // between.
  void press(const Motion& motion, const ClosedContact& at);
  void release(const Motion& motion, const ClosedContact& at);
  void meet_energy(const Motion& motion);

  // Impulses that change the rates (gdot_N, gdot_T) from `before` to `after`, and their work.
  void account(Impact& record, double normal, double friction, const Eigen::Vector2d& before,
               const Eigen::Vector2d& after);
  void record_impact(const Impact& record);
  void record(double t, EventKind kind, std::size_t contact) {
    recorder_->add(Event{t, kind, static_cast<int>(contact)});
  }

  // All figures of the run. Asked once, at its end.
  void finish(const Motion& end);

 private:
  ContactList<Constraint::Closed> held() const;
  ContactSnapshot snapshot_of(std::size_t contact, double t, const double* y) const;
  double normal_impulse(const Motion& motion) const;  // N s, of lasting contact, of all
  double contact_work(const Motion& motion) const;    // J, on the coordinates, of the same
  double held_speed(std::size_t contact) const;       // m/s, of a surface whose speed is prescribed
  void follow(std::size_t contact, const Motion& from, SmoothStep& step, double last);
  void follow_mark(const Motion& from, SmoothStep& step, Constraint& constraint, double now);
  void watch_press(std::size_t contact, SmoothStep& step, double last);
  template <class F>
  void bins_until(double now, bool flies, F&& impulses_at);

  const Model* model_;
  const EventParameters* parameters_;
  Phase* phase_;
  Recorder* recorder_ = nullptr;
  std::vector<double> row_, slope_;
  // Of each contact, beside what the integrals know: of impacts; and the time that all were closed,
  // s.
  std::vector<ContactStatistics> of_contacts_;
  // Of each contact that gives and presses.
  struct Touch {
    bool open = false;
    Impact impact{};
    double normal = 0.0, friction = 0.0, work = 0.0;  // the integrals where it began
  };
  std::vector<Touch> touches_;
  bool all_give_ = false;  // every contact
  std::vector<ContactSnapshot> others_;
  double contact_time_ = 0.0;                       // s
  double impact_work_ = 0.0;                        // J, on the coordinates
  double impact_impulse_ = 0.0;                     // N s, normal, of all impacts so far
  double bin_ = 0.0;                                // index of the current force bin
  double bin_start_ = 0.0;                          // N s, total normal impulse at its start
  double energy_start_ = 0.0, energy_scale_ = 0.0;  // J, at the start; the largest met
};

}  // namespace rotorub
