#include "compare/measured/record.h"

#include <algorithm>

namespace rotorub {
namespace {

using namespace scene;

constexpr bool kHasLimit = true;

constexpr Measurable kMeasurables[] = {
    {"rotor_x", "", "rotor_x", "rotor_vx", kLength, Axis::kX, 0, kHasLimit,
     "rotor centre at the contact, along x"},
    {"rotor_y", "", "rotor_y", "rotor_vy", kLength, Axis::kY, 0, kHasLimit,
     "the same along y; the spin turns x to y"},
    {"ring_x", "stator_x", "stator_x", "stator_vx", kLength, Axis::kX, 0, kHasLimit,
     "centre of the ring, along x"},
    {"ring_y", "stator_y", "stator_y", "stator_vy", kLength, Axis::kY, 0, kHasLimit,
     "the same along y"},
    {"gap", "", "gap", "gap_rate", kLength, Axis::kNone, 0, kHasLimit,
     "between rotor and ring; 0: touching, negative: penetration"},
    {kContactForce, "", "", "", kForce, Axis::kNone, 1, kHasLimit,
     "normal force of the contact, impacts included, averaged over a sample"},
    {"normal_force", "", "normal_force", "", kForce, Axis::kNone, 2, false,
     "as in series.csv: of lasting contact, at the instant"},
    {"friction_force", "", "friction_force", "", kForce, Axis::kNone, 2, false,
     "as in series.csv: of lasting contact, at the instant"},
    {"control_x", "", "control_x", "", kForce, Axis::kX, 3, false,
     "force of the actuator on the ring, along x"},
    {"control_y", "", "control_y", "", kForce, Axis::kY, 3, false, "the same along y"},
    {"current_1", "", "current_1", "", kCurrent, Axis::kNone, 3, false,
     "of the actuator's first axis, beyond the bias"},
    {"current_2", "", "current_2", "", kCurrent, Axis::kNone, 3, false, "of its second axis"},
    {"spin_speed", "", "spin_speed", "", kSpin, Axis::kNone, 4, false,
     "of the rotor, positive from x to y"},
};

}  // namespace

std::span<const Measurable> measurables() { return kMeasurables; }

std::size_t MeasuredColumn::count(Sample kind) const {
  return static_cast<std::size_t>(std::count(sample.begin(), sample.end(), kind));
}

const MeasuredColumn* MeasuredRecord::find(std::string_view name) const {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const MeasuredColumn& c) { return c.what->name == name; });
  return found == columns.end() ? nullptr : &*found;
}

}  // namespace rotorub
