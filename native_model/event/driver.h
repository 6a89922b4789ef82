// The event-driven reference integrator: DOP853 between events, impacts and lift-off located to
// round-off on its dense output, impacts in closed form, lasting contact as constrained modes, and
// closure of Zeno accumulations. It works with every force, drive and controller of a Model.
//
//   smooth_step  advances between events         contact_state  decides what contacts do
//   location     finds the events                observer       records rows, energy, figures
//   impact       solves impacts
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "native_model/event/impact.h"
#include "native_model/event/schedule.h"
#include "native_model/event/smooth_step.h"
#include "native_model/model/actuation.h"

namespace rotorub {

class EventIntegrator {
 public:
  // The model must outlive this object.
  EventIntegrator(const Model& model, const EventParameters& parameters = {});
  EventIntegrator(const EventIntegrator&) = delete;
  EventIntegrator& operator=(const EventIntegrator&) = delete;

  // Runs from `start` to `end` (s), into the recorder. progress: gets the fraction that is done.
  RunEnd run(const State& start, double end, Recorder& recorder,
             const std::function<void(double)>& progress = {},
             const std::atomic<bool>* interrupt = nullptr);

  // The same in stretches (run/stepwise_run.h). If every stretch is passed as a whole, the result
  // is bitwise equal to that of run(). A stretch is one step, up to the first event in it; it is
  // computed before it is passed.
  void begin(const State& start, double end, Recorder& recorder);
  // Computes the next stretch. False if there is none: at the end, or because of result().status.
  bool compute_stretch();
  double now() const { return motion_.t; }             // s
  double stretch_end() const { return stretch_.end; }  // s
  bool ends_in_event() const { return stretch_.event.has_value(); }
  // The contact whose event ends the stretch; empty if there is none.
  std::optional<std::size_t> event_contact() const {
    return stretch_.event ? std::optional(stretch_.event->contact) : std::nullopt;
  }
  // The states of the contacts at the present time, and within the next stretch.
  const SmoothSystem& system() const { return system_; }
  // within() returns the state at a time within the stretch, before the event at its end; here()
  // returns the present state. A result is valid until the next call of either.
  Snapshot within(double t);
  Snapshot here();
  // N s, normal impulse of a contact up to a snapshot of within() or here(), impacts included.
  double normal_impulse(const Snapshot& at, std::size_t contact) const {
    return observer_.normal_impulse(at, contact);
  }
  void pass();
  // Passes the stretch only up to t (s), where `jump` changes loads or held commands.
  void cut(double t, const std::function<void()>& jump);
  // Moves the end to a later time, s; the old end becomes a break like any other.
  void extend_end(double end);
  const RunEnd& result() const { return result_; }

  // The complete changing state except the recorder; only this integrator can restore it.
  struct Moving;
  std::shared_ptr<const Moving> save() const;
  void restore(const Moving& saved);

 private:
  // References to the members that change during a run, except the recorder.
  template <class Self>
  static auto moving_members(Self& self);
  void begin_in_walls();
  void arrive_at_break();
  void count_switching_work();
  void sample_controllers();
  void controller_failed(const std::string& why);
  void move_to(double now, std::optional<double> theta);
  bool still_redundant(std::size_t contact) const;
  void fail_out_of_range();

  // Contacts on their circles, each with what is known about its velocity. kAny: nothing is known,
  // because the contact is about to come to rest.
  using Closed = ContactList<Constraint::Closed>;
  // An event within the step: a contact that closes, or a margin that is crossed.
  struct FoundEvent {
    double theta;  // fraction of the step
    std::size_t contact;
    bool rejoins = false;  // it was redundant and has a force again
  };
  // The stretch that compute_stretch() has computed.
  struct NextStretch {
    bool known = false;
    double limit = 0.0, end = 0.0;  // s, limit of the step; end of the stretch
    std::optional<FoundEvent> event{};
    std::optional<double> loss{};  // fraction of the step: rotor or ring leaves its range
    std::optional<double> theta() const {
      return loss ? loss : event ? std::optional(event->theta) : std::nullopt;
    }
  };
  std::optional<FoundEvent> find_event();
  Closed on_circles() const;
  void begin_on_circles(const Closed& closed);
  void impact(std::size_t contact);
  void margin_reached(std::size_t contact);
  // Compliant contacts.
  void begin_touch(std::size_t contact, double hunt_crossley);
  double parting_acceleration(std::size_t contact);
  void compliant_margin_reached(std::size_t contact);
  void hold_without_slip(std::size_t contact);
  void release(const ClosedContact& at);
  bool release_if_unloaded(std::size_t contact);
  void decide(const Closed& resting);
  void decide_one(std::size_t contact, Constraint::Velocity velocity);
  void decide_all(const Closed& closed_here);
  void settle(const Closed& decided);
  bool gap_rate_is_zero(const ContactPoint& point) const;
  bool slip_is_zero(std::size_t contact, const ContactPoint& point, double share) const;
  void change_to(std::size_t contact, const ContactState& next);
  void first_touch(std::size_t contact);
  void project(const Closed& closed);
  MarginScales margin_scales(std::size_t contact) const;

  void count_event();
  void fail_step();
  void fail(Status status, const std::string& why);

  const Model* model_;
  EventParameters parameters_;
  Motion motion_;
  Schedule schedule_;
  SmoothSystem system_;
  SmoothStep step_;
  StiffnessWatch stiffness_;
  Constraint constraint_;
  Observer observer_;
  EventImpact impacts_;

  NextStretch stretch_;
  RunEnd result_;
  std::vector<SampledCommand> sampled_;  // one per auxiliary bearing
  double end_ = 0.0;                     // s
  std::vector<double> force_scale_;      // N, largest force at each contact so far, also balanced
  int stalled_ = 0;                      // number of events since time advanced
  double last_event_ = 0.0;              // s
  double switching_work_until_ = 0.0;    // s, the work of switched loads is counted up to here
};

}  // namespace rotorub
