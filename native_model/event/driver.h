// The event-driven reference: DOP853 between events, impacts and lift-off located to round-off on
// its dense output, the impact map in closed form, lasting contact as constrained modes, Zeno
// accumulation closed. Works with every force, drive and controller of a Model.
//
//   smooth_step    moves between events                 contact_state  decides what contact does
//   location       finds where they are                 observer       sees rows, energy, figures
//   impact         what happens at a closing contact
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "native_model/event/impact.h"
#include "native_model/event/schedule.h"
#include "native_model/event/stiffness.h"
#include "native_model/system/sampled_command.h"

namespace rotorub {

class EventIntegrator {
 public:
  // The model must outlive it.
  EventIntegrator(const Model& model, const EventParameters& parameters = {});
  EventIntegrator(const EventIntegrator&) = delete;
  EventIntegrator& operator=(const EventIntegrator&) = delete;

  struct Result {
    Status status = Status::kOk;
    std::string message;
    std::int64_t steps = 0;  // accepted
    std::int64_t rejected = 0;
    double end = 0.0;  // s, reached
  };
  // From `start` to `end`, into the recorder. progress: fraction done.
  Result run(const State& start, double end, Recorder& recorder,
             const std::function<void(double)>& progress = {},
             const std::atomic<bool>* interrupt = nullptr);

 private:
  void begin(const State& start, Recorder& recorder);
  void begin_on_circle(const ContactPoint& point);
  void advance(double limit);
  void arrive_at_break();
  void book_switches();
  void sample_controller();

  // Contact.
  void impact();
  void margin_reached();
  void decide(bool slip_is_zero, Departure parting);
  void change_to(const ContactState& next);
  void first_touch();
  MarginScales margin_scales() const;

  void count_event();
  void fail_step();
  void fail(Status status, const std::string& why);

  const Model* model_;
  EventParameters parameters_;
  Motion motion_;
  Schedule schedule_;
  Phase phase_;
  SmoothStep step_;
  StiffnessWatch stiffness_;
  Constraint constraint_;
  Observer observer_;
  EventImpact impact_;

  Result result_;
  SampledCommand sampled_;
  double end_ = 0.0;          // s
  double force_scale_ = 0.0;  // N, largest force met at the contact, carried or balanced
  int stalled_ = 0;           // events since the clock went on
  double last_event_ = 0.0;   // s
  double booked_ = 0.0;       // s, up to here the work of what is switched has been counted
};

}  // namespace rotorub
