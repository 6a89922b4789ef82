// The event-driven reference: DOP853 between events, impacts and lift-off located to round-off on
// its dense output, the impact map in closed form, lasting contact as constrained modes, Zeno
// accumulation closed. Works with every force, drive and controller of a Model.
//
//   smooth_step  moves between events         contact_state  decides what contact does
//   location     finds where they are         observer       sees rows, energy, figures
//   impact       what happens at a closing contact
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

  // The same a stretch at a time (run/stepwise_run.h): what is passed in whole is what run() does,
  // to the bit. A stretch is known before it is passed: a step, up to the event in it.
  void begin(const State& start, double end, Recorder& recorder);
  // Knows the stretch that comes; false: there is none, at the end or for what status() says.
  bool look_ahead();
  double now() const { return motion_.t; }           // s
  double stretch_end() const { return ahead_.end; }  // s
  bool ends_in_event() const { return ahead_.event.has_value(); }
  // At a time within the stretch, before the event at its end; now. Valid until the next call.
  Snapshot within(double t);
  Snapshot here();
  // N s, normal, of a contact up to one of these, with its impacts.
  double normal_impulse(const Snapshot& at, std::size_t contact) const {
    return observer_.normal_impulse(at, contact);
  }
  void pass();
  // Only up to t (s), where `jump` changes loads or held commands.
  void cut(double t, const std::function<void()>& jump);
  // The end lies later, s; now it is a break like any other.
  void put_off_end(double end);
  const Result& result() const { return result_; }

  // All that moves but the recorder, for this integrator alone.
  struct Moving;
  std::shared_ptr<const Moving> save() const;
  void restore(const Moving& saved);

 private:
  void begin_in_walls();
  void arrive_at_break();
  void book_switches();
  void sample_controllers();
  void controller_failed(const std::string& why);
  void move_to(double now, std::optional<double> theta);
  bool still_held(std::size_t contact) const;
  void lose();

  // Contact. A list of contacts says what is known of their velocities: of one that is kept, which
  // is about to come to rest, nothing.
  using Closed = ContactList<Constraint::Closed>;
  struct Found {
    double theta;  // within the step
    std::size_t contact;
    bool rejoins = false;  // it was held on its circle, and is pressed again
  };
  struct Ahead {
    bool known = false;
    double limit = 0.0, end = 0.0;  // s, of the step, of the stretch
    std::optional<Found> event{};
    std::optional<double> loss{};  // within the step: rotor or ring leaves its range
    std::optional<double> theta() const {
      return loss ? loss : event ? std::optional(event->theta) : std::nullopt;
    }
  };
  std::optional<Found> find_event();
  Closed on_circles() const;
  Closed in_contact() const;
  void begin_on_circles(const Closed& touching);
  void impact(std::size_t contact);
  void margin_reached(std::size_t contact);
  void rejoin(std::size_t contact);
  // Of contacts that give.
  void press(std::size_t contact, double hunt_crossley);
  double parting_acceleration(std::size_t contact);
  void press_on(std::size_t contact);
  void press_margin_reached(std::size_t contact);
  void release(const ClosedContact& at);
  bool no_longer_presses(std::size_t contact);
  void decide(const Closed& resting);
  void decide_all(const Closed& closed_here);
  void settle(const Closed& decided);
  bool is_no_gap_rate(const ContactPoint& point) const;
  bool is_no_slip(std::size_t contact, const ContactPoint& point, double share) const;
  void change_to(std::size_t contact, const ContactState& next);
  void first_touch(std::size_t contact);
  void project(const Closed& closed);
  static Constraint::Velocity velocity_of(Mode mode);
  MarginScales margin_scales(std::size_t contact) const;

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
  EventImpact impacts_;

  Ahead ahead_;
  Result result_;
  std::vector<SampledCommand> sampled_;  // of each auxiliary bearing
  double end_ = 0.0;                     // s
  std::vector<double> force_scale_;  // N, largest force met at each contact, carried or balanced
  int stalled_ = 0;                  // events since the clock went on
  double last_event_ = 0.0;          // s
  double booked_ = 0.0;              // s, up to here the work of what is switched has been counted
};

}  // namespace rotorub
