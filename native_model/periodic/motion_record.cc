#include "native_model/periodic/motion_record.h"

#include "native_model/event/driver.h"
#include "native_model/periodic/essential_state.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub::periodic {
namespace {

// q and v are stored one after the other.
std::vector<double> state_of(const Snapshot& at, int nq) {
  return std::vector<double>(at.q, at.q + 2 * nq);
}

ContactStates states_of(const SmoothSystem& system) {
  ContactStates all;
  for (std::size_t k = 0; k < system.contacts(); ++k) all.push_back(system.state(k));
  return all;
}

}  // namespace

MotionRecord record_motion(const Model& model, const State& start, double end,
                           const EventParameters& parameters) {
  MotionRecord record;
  Recorder recorder(model, {});
  EventIntegrator run(model, parameters);
  run.begin(start, end, recorder);
  record.begin_time = start.t;
  record.start = record.end = state_of(run.here(), model.nq());
  record.first = states_of(run.system());
  while (run.compute_stretch()) {
    Stretch stretch{run.now(), run.stretch_end() - run.now(), record.end, states_of(run.system())};
    if (const auto contact = run.event_contact()) {
      stretch.jump = Jump{*contact, state_of(run.within(run.stretch_end()), model.nq()), {}, {}};
    }
    run.pass();
    record.end = state_of(run.here(), model.nq());
    if (stretch.jump) {
      stretch.jump->after = record.end;
      stretch.jump->states = states_of(run.system());
    }
    record.stretches.push_back(std::move(stretch));
  }
  record.last = states_of(run.system());
  record.end_time = run.now();
  record.status = run.result().status;
  record.message = run.result().message;
  return record;
}

Eigen::VectorXd sizes_along(const Model& model, const MotionRecord& motion) {
  std::vector<const double*> states{motion.start.data(), motion.end.data()};
  for (const Stretch& s : motion.stretches) states.push_back(s.y.data());
  Eigen::VectorXd sizes = EssentialState::sizes(model, states);
  if (motion.status == Status::kOk) {
    EssentialState::widen_control_states(model, motion.end_time, motion.end, sizes);
  }
  return sizes;
}

}  // namespace rotorub::periodic
