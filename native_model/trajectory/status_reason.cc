#include "native_model/trajectory/status_reason.h"

namespace rotorub {

const char* status_reason(Status status) {
  switch (status) {
    case Status::kDiverged:
      return "the state is no longer finite";
    case Status::kNoSolution:
      return "the contact laws have no solution (frictional jamming, Painleve)";
    case Status::kAmbiguous:
      return "the contact laws have several solutions (frictional jamming, Painleve)";
    case Status::kStepTooLarge:
      return "the equations of one step do not converge: the step is too large for the loads that "
             "depend on the spin, or for the whirl of a contact";
    case Status::kInterrupted:
      return "interrupted";
    default:
      return "";
  }
}

EventKind mode_event(ContactMode mode) {
  if (mode == ContactMode::kFree) return EventKind::kLiftOff;
  return mode == ContactMode::kSlide ? EventKind::kSlide : EventKind::kStick;
}

}  // namespace rotorub
