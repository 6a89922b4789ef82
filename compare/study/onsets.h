// The onsets of contact in a MuJoCo run, as its steps go by: the state just before each, and what
// the contact that follows comes to.
//
// An onset is the first impulse after a free phase of at least kShortestFlight steps: a start on
// the circle is none. Its contact lasts until half-way through the next such phase (or to the run's
// end): bounces with shorter flights belong to it, and half-way two sides whose flights differ a
// little count the same bounces.
#pragma once

#include <vector>

#include "compare/engine/engine.h"
#include "native_model/system/model.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {

inline constexpr int kShortestFlight = 10;  // steps without an impulse

// One contact, from its onset on.
struct ContactResult {
  double impulse = 0.0;         // N s, normal, of all of it, >= 0
  double window_impulse = 0.0;  // N s, largest within 20 steps (recorder.h)
  double duration = 0.0;        // s, from the touch to the last force; 0 for a single rigid impact
  double rebound = 0.0;  // m/s, gap rate after the first impact; of a soft contact where its force
                         // first ends; 0 where it does not
};

struct Onset {
  State before;          // a step before the one that meets the ring; the native layout
  double touch = 0.0;    // s, the impact, or of a soft contact when the gap of `before` closes
  double closing = 0.0;  // m/s, of the gap there, > 0
  double end = 0.0;      // s, of the contact
  bool lasts = false;    // to the run's end
  ContactResult mujoco;
};

class OnsetWatch {
 public:
  // `model`: the scene's, coils included; it must outlive this.
  explicit OnsetWatch(const Model& model) : model_(&model) {}

  void step(const WatchedStep& step);
  // Ends the last contact. `end`: s, of the run.
  std::vector<Onset> finish(double end);
  // First impulses after a flight that are no onsets: the rotor still lay in the ring a step
  // before, as a soft contact's can.
  int left_out() const { return left_out_; }

 private:
  void meet(const WatchedStep& step);
  void add(const WatchedStep& step);
  void part(const WatchedStep& step);
  bool flew() const { return flight_ >= kShortestFlight; }

  const Model* model_;
  std::vector<Onset> onsets_;
  State before_;             // of the step before
  ImpulseWindow window_;     // over the last onset's contact
  bool open_ = false;        // the last onset's contact is under way
  bool rebounded_ = false;   // its rebound is known
  double last_force_ = 0.0;  // s
  int flight_ = 0;           // steps without an impulse
  int left_out_ = 0;
};

}  // namespace rotorub
