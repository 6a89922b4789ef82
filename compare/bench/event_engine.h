// `event` at a tolerance of one's own: the work-precision ladder of an engine without a step, and
// the reference.
#pragma once

#include <memory>

#include "compare/engine/engine.h"
#include "native_model/event/parameters.h"

namespace rotorub::bench {

// The settings of `event` for a relative tolerance: what is distinguished from 0 by the tolerance
// follows it.
EventParameters event_parameters(double tolerance);

// RunRequest::step is not read: forces are averaged over the bins of the parameters.
std::unique_ptr<Engine> event_engine(const EventParameters& parameters);

}  // namespace rotorub::bench
