// The distributions of a run's contact forces and impulses, for the page.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// is_compliant: whether the scene's contacts are compliant; their episodes always count as impacts.
// With other soft contacts, an episode longer than the impulse window is a rub and does not count.
//
// {"force": {"width": N, "share": [% of the whole time]}, "impulse": {"value": [mN s, descending],
// "count": [number of counted impacts that reach it]}}; a member without data is null.
nlohmann::json contact_distribution(const Trajectory& run, std::size_t contact, bool is_compliant);

}  // namespace rotorub
