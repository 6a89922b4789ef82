// A native run that is driven from outside. Commands of rings, currents and loads are inputs that
// hold until they are set again; the columns of the series are outputs, available at any time. The
// integrator is `event`. Without new inputs the outputs equal the rows of run_native to the bit,
// wherever the run is asked to stop.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "native_model/event/driver.h"
#include "native_model/scene/forward.h"

namespace rotorub {

class StepwiseRun {
 public:
  // Throws scene::SceneError for impacts that take time. The caller must have libraries left
  // unopened (set_scene_libraries in control/library_file.h).
  explicit StepwiseRun(const scene::Scene& scene);
  StepwiseRun(const StepwiseRun&) = delete;
  StepwiseRun& operator=(const StepwiseRun&) = delete;

  struct Port {
    std::string name, unit, meaning;
    bool whole = false;  // whether its values are whole numbers
    bool modal = false;  // whether it is a coordinate of one mode of the rotor
  };
  // The inputs are the command of each ring that has no controller, a passive one without stiffness
  // and damping, or a library, which is not opened; the currents of magnetic bearings whose control
  // is a library; and a load on the rotor at each contact.
  const std::vector<Port>& inputs() const { return inputs_; }
  // The outputs are the columns of the series except the time, the deflections at the sensors of
  // magnetic bearings, the normal impulse of each contact so far, and the number of impacts.
  const std::vector<Port>& outputs() const { return outputs_; }

  // Takes effect from the present time on, at the next now() or advance().
  void set_input(std::size_t input, double value);
  double input(std::size_t input) const { return now_.given[input]; }

  // Starts at t = 0 with the present inputs. end: s, > 0; advance() may go beyond it.
  void begin(double end);
  double time() const { return now_.t; }  // s
  // Advances to the time `to`, s; with `events`, at most to the next event, which then waits for
  // pass_event(). Returns false if the run has failed, see status().
  bool advance(double to, bool events = false);
  bool event_waits() const { return now_.event_waits; }
  bool pass_event();
  // The outputs at the present time, before a waiting event.
  const std::vector<double>& now();
  Status status() const { return integrator_.result().status; }
  const std::string& message() const { return integrator_.result().message; }

  // The whole state of the run, valid for this run only. A SavedState may outlive the run.
  struct SavedState;
  std::shared_ptr<const SavedState> save() const;
  void restore(const SavedState& saved);

 private:
  Model model_with_inputs(const scene::Scene& scene);
  void find_outputs();
  void add_vector(const std::string& name, const char* unit, const std::string& meaning);
  void apply_inputs();
  bool apply_new_inputs();
  void count_impacts();
  void put(const Snapshot& at);
  bool good() const { return status() == Status::kOk; }

  std::vector<Port> inputs_, outputs_;
  struct RingCommand {
    std::size_t ring;  // index of the auxiliary bearing
    std::shared_ptr<CommandRecord> record;
  };
  // The parts of the model that the inputs drive, in the order of the inputs. Each takes pairs of
  // consecutive numbers.
  struct Driven {
    std::vector<RingCommand> commands;
    std::vector<std::shared_ptr<std::vector<double>>> currents;  // A, of each sampled control
    std::size_t first_load = 0;                                  // index among the forces
  };
  Driven driven_;
  Model model_;  // built with its inputs before others refer to it
  Recorder recorder_;
  EventIntegrator integrator_;
  std::vector<Column> row_;
  struct Now {
    std::vector<double> given, in_effect;  // inputs as set, and those in effect
    std::vector<double> values;            // of the outputs
    double t = 0.0, end = 0.0;             // s
    double impacts = 0.0;
    bool new_inputs = false, event_waits = false;
    bool known = false;  // the values belong to t
  };
  Now now_;
};

}  // namespace rotorub
