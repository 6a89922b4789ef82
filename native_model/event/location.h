// The location of events within a step: theta in (0, 1]; empty if there is none.
#pragma once

#include <optional>

#include "native_model/event/smooth_step.h"

namespace rotorub {

// For a contact in free flight from `start`: the instant at which it closes. No contact is missed,
// not even a grazing one.
std::optional<double> locate_contact(const Model& model, std::size_t contact, SmoothStep& step,
                                     const Motion& start, Departure departure);

// For a contact that others hold on its circle (ContactState::held): the instant at which its gap
// has closed from `held_gap` (m) by more than round-off. flew: the gap had opened by more than
// round-off before, so the contact comes from a flight.
inline constexpr double kHeldGap = 1e-11;  // of the clearance, of either sign
struct HeldEnd {
  double theta;
  bool flew;
};
std::optional<HeldEnd> locate_held_end(const Model& model, std::size_t contact, SmoothStep& step,
                                       const Motion& start, double held_gap);

// For a lasting contact: the instant at which the first of its margins is crossed.
std::optional<double> locate_margin(std::size_t contact, SmoothStep& step, Mode mode,
                                    const MarginScales& scales, const EventParameters& parameters);

// For a compliant contact, from the start of the step to `last`: the largest normal force, N, at
// least `known`; and the least gap, m.
double locate_largest_force(std::size_t contact, SmoothStep& step, double last, double known);
double locate_least_gap(const Model& model, std::size_t contact, SmoothStep& step, double last);

// If the step is out of range (trajectory/range_check.h) at `last`: the instant at which it has
// just left.
std::optional<double> locate_loss(const Model& model, SmoothStep& step, double last);

}  // namespace rotorub
