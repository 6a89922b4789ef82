// A native run that is fed from outside: commands of rings, currents and loads go in, and stay
// until they are given anew; what a series has comes out, at any time. The integrator is `event`.
// Without new inputs its outputs are the rows of run_native, to the bit, wherever it is asked to
// stop.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "native_model/event/driver.h"
#include "native_model/scene/forward.h"

namespace rotorub {

class StepwiseRun {
 public:
  // Throws scene::SceneError for what cannot be run so: impacts that take time. Libraries are to be
  // left out (control/library.h).
  explicit StepwiseRun(const scene::Scene& scene);
  StepwiseRun(const StepwiseRun&) = delete;
  StepwiseRun& operator=(const StepwiseRun&) = delete;

  struct Port {
    std::string name, unit, meaning;
    bool whole = false;  // its values are whole numbers
  };
  // The command of each ring whose controller the scene leaves to others: it has none, a passive
  // one, or a library, which is not opened; the currents of magnetic bearings whose control is a
  // library; a load on the rotor at each contact.
  const std::vector<Port>& inputs() const { return inputs_; }
  // The columns of the series but the time, deflections that the sensors of magnetic bearings see,
  // the normal impulse of each contact, and the number of impacts.
  const std::vector<Port>& outputs() const { return outputs_; }

  // Holds from the present time on, once `now()` or advance() is asked.
  void set_input(std::size_t input, double value);
  double input(std::size_t input) const { return given_[input]; }

  // At t = 0, with the inputs as they are. end: s, > 0; one can go beyond it.
  void begin(double end);
  double time() const { return t_; }  // s
  // To the time `to`, s; `events`: at most to the next event, which then waits for pass_event().
  // False: the run has failed, see status().
  bool advance(double to, bool events = false);
  bool event_waits() const { return event_waits_; }
  bool pass_event();
  // The outputs at the present time, before an event that waits.
  const std::vector<double>& now();
  Status status() const { return integrator_.result().status; }
  const std::string& message() const { return integrator_.result().message; }

  // All of it, for this run alone. A saved one may outlive the run.
  struct Saved;
  std::shared_ptr<const Saved> save() const;
  void restore(const Saved& saved);

 private:
  Model with_inputs(const scene::Scene& scene);
  void find_outputs();
  void add_vector(const std::string& name, const char* unit, const std::string& meaning);
  void give_inputs();
  bool take_inputs();
  void count_impacts();
  void put(const Snapshot& at);
  bool good() const { return status() == Status::kOk; }

  std::vector<Port> inputs_, outputs_;
  // Where inputs go: pairs of numbers from the first of each on.
  std::vector<std::pair<std::size_t, std::shared_ptr<CommandRecord>>> commands_;  // of which ring
  std::vector<std::shared_ptr<std::vector<double>>> currents_;
  std::size_t first_load_ = 0;  // among the forces
  Model model_;                 // knows its inputs before anybody knows the model
  Recorder recorder_;
  EventIntegrator integrator_;
  std::vector<double> given_, taken_;  // inputs, and those that hold
  std::vector<Column> row_;
  std::vector<double> values_;
  double t_ = 0.0, end_ = 0.0;  // s
  double impacts_ = 0.0;
  bool new_inputs_ = false, event_waits_ = false, known_ = false;
};

}  // namespace rotorub
