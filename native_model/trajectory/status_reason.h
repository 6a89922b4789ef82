// Texts and events for the outcome of a step.
#pragma once

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Reason why a fixed-step run ended; empty if the reason is reported elsewhere.
const char* status_reason(Status status);

// Event that marks a contact's change to `mode`.
EventKind mode_event(ContactMode mode);

}  // namespace rotorub
