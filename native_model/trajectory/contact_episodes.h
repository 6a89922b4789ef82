// Impacts and changes of mode of a soft contact. An impact is an episode of contact, from the
// instant the gap closes to the first step without a force, with the impulses integrated over it.
// An episode shorter than the window of impulses (native_model/trajectory/recorder.h) is not a
// lasting contact.
#pragma once

#include "native_model/contact/kinematics.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {

// One fixed step: the states at both ends and the contact force held over it. If the forces are
// known at the instants of the states, `t` is such an instant, `before` and `after` are both its
// state, and `approach` is the state before it.
struct SoftStep {
  double t = 0.0, h = 0.0;  // s, begin and length
  ContactPoint before, after;
  double normal = 0.0;    // N, >= 0
  double friction = 0.0;  // N, on the rotor along e_t
  ContactMode mode = ContactMode::kFree;
  // State that gives the rates of the approach; null: `before`.
  const ContactPoint* approach = nullptr;
};

class ContactEpisodes {
 public:
  explicit ContactEpisodes(Recorder& recorder, int contact = 0)
      : recorder_(&recorder), contact_(contact) {}
  void step(const SoftStep& step);
  void finish();  // closes an open episode

 private:
  Recorder* recorder_;
  int contact_;
  bool open_ = false;
  Impact impact_;
  ContactMode mode_ = ContactMode::kFree;
  double last_gap_ = 0.0;              // m, one step earlier
  double begin_ = 0.0, lasted_ = 0.0;  // s, begin and duration of the episode
};

}  // namespace rotorub
