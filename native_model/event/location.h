// Where within a step events are: theta in (0, 1], empty where there is none.
#pragma once

#include <optional>

#include "native_model/event/smooth_step.h"

namespace rotorub {

// Free flight of one contact from `start`: where it closes. Nothing is overlooked, grazing
// included.
std::optional<double> locate_contact(const Model& model, std::size_t contact, SmoothStep& step,
                                     const Motion& start, Departure departure);

// A contact that others hold on its circle (ContactState::held): where its gap has closed by more
// than round-off from `held_gap` (m) on, and whether it had opened before by more than that, so
// that it comes from a flight.
inline constexpr double kHeldGap = 1e-11;  // of the clearance, of either sign
struct HeldEnd {
  double theta;
  bool flew;
};
std::optional<HeldEnd> locate_held_end(const Model& model, std::size_t contact, SmoothStep& step,
                                       const Motion& start, double held_gap);

// Lasting contact: the first of its margins that is crossed.
std::optional<double> locate_margin(std::size_t contact, SmoothStep& step, Mode mode,
                                    const MarginScales& scales, const EventParameters& parameters);

// Of a contact that gives, from the step's start to `last`: the largest normal force, N, where it
// may be larger than `known`; and the least gap, m.
double locate_largest_force(std::size_t contact, SmoothStep& step, double last, double known);
double locate_least_gap(const Model& model, std::size_t contact, SmoothStep& step, double last);

// The step is out of range (trajectory/range_check.h) at `last`: where it has just left.
std::optional<double> locate_loss(const Model& model, SmoothStep& step, double last);

}  // namespace rotorub
