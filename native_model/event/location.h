// The location of events within a step: theta in (0, 1]; empty if there is none.
#pragma once

#include <optional>

#include "native_model/event/smooth_step.h"

namespace rotorub {

// For a contact in free flight from `start`: the instant at which it closes. No contact is missed,
// not even a grazing one.
std::optional<double> locate_contact(const Model& model, std::size_t contact, SmoothStep& step,
                                     const Motion& start, Departure departure);

// For a redundant contact (ContactState::redundant): the instant at which its gap has closed from
// `redundant_gap` (m) by more than round-off. flew: the gap had opened by more than round-off
// before, so the contact comes from a flight.
inline constexpr double kRedundantGap = 1e-11;  // of the clearance, of either sign
struct RedundantEnd {
  double theta;
  bool flew;
};
std::optional<RedundantEnd> locate_redundant_end(const Model& model, std::size_t contact,
                                                 SmoothStep& step, const Motion& start,
                                                 double redundant_gap);

// For a lasting contact: the instant at which the first of its margins is crossed.
std::optional<double> locate_margin(std::size_t contact, SmoothStep& step, ContactMode mode,
                                    const MarginScales& scales, const EventParameters& parameters);

// For a compliant contact, from the start of the step to `last`: the largest normal force, N, at
// least `known`; and the least gap, m.
double locate_largest_force(std::size_t contact, SmoothStep& step, double last, double known);
double locate_least_gap(const Model& model, std::size_t contact, SmoothStep& step, double last);

// If the step is out of range (trajectory/range_check.h) at `last`: the instant at which it has
// just left, 0 if it had left before.
std::optional<double> locate_loss(const Model& model, SmoothStep& step, double last);

}  // namespace rotorub
