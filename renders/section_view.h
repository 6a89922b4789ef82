// The cross-section at the contact, seen from the shaft's far end: x to the right, y up, spin
// counter-clockwise. Rotor and ring with the clearance magnified, what holds the ring, the path of
// the rotor's centre in the clearance circle, the point of contact and the forces.
#pragma once

#include "renders/instant.h"
#include "renders/machine.h"
#include "renders/sheet.h"

namespace rotorub::renders {

inline constexpr double kCurrentShare =
    0.38;  // of the rotor's radius: the bar of the largest coil current

class SectionView {
 public:
  // `motion`: the farthest that ring or free rotor get from the centre, m. The machine has a
  // contact.
  SectionView(const Machine& machine, double motion);

  // `ghost`: a second pose drawn translucent, or null.
  void draw(Sheet& sheet, const Instant& instant, const Pose* ghost) const;
  // Pixels of a drawing unit there.
  double pixels(const Area& area) const;

 private:
  Machine machine_;
  double wall_;       // radius where springs and actuators end
  double half_size_;  // of the smaller side of what is seen, drawing units
};

}  // namespace rotorub::renders
