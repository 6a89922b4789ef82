// The cross-section at the contact, seen from the shaft's far end: x to the right, y up, spin
// counter-clockwise. Rotor and ring with the clearance magnified, the path of the rotor's centre in
// the clearance circle, the point of contact and the forces on the rotor.
#pragma once

#include <vector>

#include "renders/contact_marks.h"
#include "renders/machine.h"
#include "renders/stage.h"

namespace rotorub::renders {

class SectionView {
 public:
  // `motion`: the farthest that ring or free rotor get from the centre, m. The machine has a
  // contact.
  SectionView(const Machine& machine, double motion, std::vector<Mesh>& meshes);

  // `force_length`: drawn length of one newton. `ghost`: a second pose drawn translucent, or null.
  void draw(const Stage& stage, mjvScene& scene, const Instant& instant, const Pose* ghost,
            double force_length) const;
  void set_up(mjvScene& scene) const;
  // Half of the height (and width) that is seen, drawing units.
  double half_size() const { return half_size_; }

 private:
  // Depth of flat things, from the back to the front.
  enum Layer { kBack, kBody, kEdge, kMark, kPath, kForce };
  double depth(Layer layer) const { return 0.02 * half_size_ * static_cast<double>(layer); }
  void circle(Canvas& canvas, const Eigen::Vector2d& centre, double radius, double x, double pixels,
              const Color& color, bool dashed) const;
  void draw_ring(const Stage& stage, Canvas& canvas, const DrawnSection& section,
                 double ring_angle) const;
  void draw_rotor(const Stage& stage, Canvas& canvas, const DrawnSection& section,
                  double spin_angle) const;
  void draw_path(Canvas& canvas, const Instant& instant, const DrawnSection& section) const;
  void draw_forces(Canvas& canvas, const Instant& instant, const DrawnSection& section,
                   double force_length) const;
  void draw_ghost(const Stage& stage, Canvas& canvas, const DrawnSection& ghost) const;

  Machine machine_;
  double half_size_;
  int ring_ = -1, rotor_ = -1, mark_ = -1;  // meshes by number
  int ring_mark_ = -1;                      // of a ring that turns
};

}  // namespace rotorub::renders
