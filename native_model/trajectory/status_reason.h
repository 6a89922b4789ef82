// Words about the end of a step, for messages.
#pragma once

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Why a run in fixed steps ended; empty for what is said elsewhere.
const char* status_reason(Status status);

// The event that a contact's new mode is.
EventKind mode_event(Mode mode);

}  // namespace rotorub
