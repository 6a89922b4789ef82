// Impacts and changes of mode of a soft contact: an impact is an episode of contact, from the
// instant the gap closes to the first step without a force, the impulses integrated over it. One
// that is shorter than the window of impulses (native_model/trajectory/recorder.h) is no
// lasting contact.
#pragma once

#include "native_model/contact/kinematics.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {

// One fixed step: the states at both ends and the contact force held over it; or, where forces are
// known about the instants of the states, t and that state twice, and the one before it.
struct SoftStep {
  double t = 0.0, h = 0.0;  // s, begin and length
  ContactPoint before, after;
  double normal = 0.0;    // N, >= 0
  double friction = 0.0;  // N, on the rotor along e_t
  Mode mode = Mode::kFree;
  const ContactPoint* approach = nullptr;  // whose rates are those of the approach; null: `before`
};

class ContactEpisodes {
 public:
  explicit ContactEpisodes(Recorder& recorder, int contact = 0)
      : recorder_(&recorder), contact_(contact) {}
  void step(const SoftStep& step);
  void finish();  // closes the episode that is open

 private:
  Recorder* recorder_;
  int contact_;
  bool open_ = false;
  Impact impact_;
  Mode mode_ = Mode::kFree;
  double last_gap_ = 0.0;              // m, one step earlier
  double begin_ = 0.0, lasted_ = 0.0;  // s, of the episode
};

}  // namespace rotorub
