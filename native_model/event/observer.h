// The observer of an event-driven run: rows at exact times, impacts and changes of mode, bins of
// the normal force, the energy balance and the other figures. It does not change the motion.
#pragma once

#include <vector>

#include "native_model/event/smooth_step.h"
#include "native_model/model/constraint.h"
#include "native_model/model/finite_impact.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {

class Observer {
 public:
  Observer(const Model& model, const EventParameters& parameters, SmoothSystem& system);

  void begin(const Motion& start, Recorder& recorder);
  // Writes the rows of the start, after an impact at that very instant.
  void started(const Motion& motion);

  // Call it before the motion advances to `now`, by a step or by a part of an impact. Rows at
  // `now`, up to round-off, are left to arrive().
  void watch(const Motion& from, SmoothStep& step, Constraint& constraint, double now);
  void watch(const Motion& from, const FiniteImpact& impact, std::size_t phase, double now);
  // Call it after the motion has advanced.
  void arrive(const Motion& motion);
  // The state at a time within a step, and at the present time. Valid until the next call.
  Snapshot within(const Motion& from, SmoothStep& step, Constraint& constraint, double t);
  Snapshot snapshot(double t, const double* y);
  // N s, normal impulse of a contact up to this snapshot of within() or snapshot(), including its
  // impacts.
  double normal_impulse(const Snapshot& at, std::size_t contact) const;
  // Call them when the force of a compliant contact begins and when it ends. The time between is
  // recorded as one impact.
  void begin_touch(const Motion& motion, const ClosedContact& at);
  void release(const Motion& motion, const ClosedContact& at);
  void update_energy_scale(const Motion& motion);

  // Adds impulses that change the rates (gdot_N, gdot_T) from `before` to `after`, and their work.
  void account(Impact& record, double normal, double friction, const Eigen::Vector2d& before,
               const Eigen::Vector2d& after);
  void record_impact(const Impact& record);
  void record(double t, EventKind kind, std::size_t contact) {
    recorder_->add(Event{t, kind, static_cast<int>(contact)});
  }

  // Computes all figures of the run. Call it once, at the end.
  void finish(const Motion& end);

 private:
  ContactSnapshot snapshot_of(std::size_t contact, double t, const double* y) const;
  double normal_impulse(const Motion& motion) const;   // N s, lasting contact, all contacts
  double contact_work(const Motion& motion) const;     // J, on the coordinates, likewise
  double prescribed_speed(std::size_t contact) const;  // m/s, of a surface with prescribed speed
  void follow(std::size_t contact, const Motion& from, SmoothStep& step, double last);
  void follow_mark(const Motion& from, SmoothStep& step, Constraint& constraint, double now);
  void watch_touch(std::size_t contact, SmoothStep& step, double last);
  template <class F>
  void bins_until(double now, bool flies, F&& impulses_at);

  const Model* model_;
  const EventParameters* parameters_;
  SmoothSystem* system_;
  Recorder* recorder_ = nullptr;
  std::vector<double> row_, slope_;
  // For each contact, the figures that the integrals do not contain: impacts, time in contact (s),
  // full passes, peak force.
  std::vector<ContactStatistics> of_contacts_;
  // For each compliant contact that has a force.
  struct Touch {
    bool active = false;
    Impact impact{};
    double normal = 0.0, friction = 0.0, work = 0.0;  // integrals at its start
  };
  std::vector<Touch> touches_;
  std::vector<ContactSnapshot> shown_;              // of the last snapshot
  double contact_time_ = 0.0;                       // s
  double impact_work_ = 0.0;                        // J, on the coordinates
  double impact_impulse_ = 0.0;                     // N s, normal, all impacts so far
  double bin_ = 0.0;                                // index of the current force bin
  double bin_start_ = 0.0;                          // N s, total normal impulse at its start
  double energy_start_ = 0.0, energy_scale_ = 0.0;  // J, at the start; largest so far
};

}  // namespace rotorub
