// The cross-section at the contact, seen from the shaft's far end: x to the right, y up, spin
// counter-clockwise. It shows rotor and ring with the clearance magnified, the ring's support, the
// path of the rotor's centre in the clearance circle, the point of contact and the forces.
#pragma once

#include "renders/instant.h"
#include "renders/machine.h"
#include "renders/sheet.h"

namespace rotorub::renders {

inline constexpr double kCurrentShare =
    0.38;  // relative to the rotor's radius: bar length of the largest coil current

class SectionView {
 public:
  // `motion`: largest distance of the ring or the free rotor from the centre, m. The machine must
  // have a contact.
  SectionView(const Machine& machine, double motion);

  // `ghost`: a second pose drawn translucent, or null.
  void draw(Sheet& sheet, const Instant& instant, const Pose* ghost) const;
  // Pixels per drawing unit in this area.
  double pixels(const Area& area) const;
  // Pixels from the middle of this area that the ring, or its housing, can reach.
  double reach(const Area& area) const { return reach_ * pixels(area); }

 private:
  Machine machine_;
  double reach_;      // of the ring, from the middle, drawing units
  double wall_;       // radius where springs and actuators end
  double half_size_;  // of the shorter side of the visible region, drawing units
};

}  // namespace rotorub::renders
