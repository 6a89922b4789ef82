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
  // Half of the smaller side of what is seen, drawing units.
  double half_size() const { return half_size_; }
  // Pixels of a drawing unit there.
  double pixels(const Area& area) const;

 private:
  // Where drawing units are on a sheet.
  struct Place {
    Eigen::Vector2d middle;
    double pixels;
    Sheet::Point operator()(const Eigen::Vector2d& yz) const {
      return {middle[0] + pixels * yz[0], middle[1] - pixels * yz[1]};
    }
  };
  void draw_axes(Sheet& sheet, const Place& at) const;
  void draw_support(Sheet& sheet, const Place& at, const DrawnSection& section) const;
  void draw_spring(Sheet& sheet, const Place& at, const Eigen::Vector2d& from,
                   const Eigen::Vector2d& to) const;
  void draw_ring(Sheet& sheet, const Place& at, const DrawnSection& section, double angle) const;
  void draw_rotor(Sheet& sheet, const Place& at, const DrawnSection& section, double angle) const;
  void draw_ghost(Sheet& sheet, const Place& at, const DrawnSection& ghost) const;
  void draw_path(Sheet& sheet, const Place& at, const Instant& instant,
                 const DrawnSection& section) const;
  void draw_currents(Sheet& sheet, const Place& at, const Instant& instant) const;
  void draw_forces(Sheet& sheet, const Place& at, const Instant& instant,
                   const DrawnSection& section) const;

  Machine machine_;
  double wall_;  // radius where springs and actuators end
  double half_size_;
};

}  // namespace rotorub::renders
