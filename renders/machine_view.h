// The whole machine in perspective: bent shaft, discs, bearings, and the ring cut open towards the
// viewer. Camera, base and shaft are in machine_view.cc; ring, forces and shadows are in
// machine_marks.cc.
#pragma once

#include <vector>

#include "renders/canvas.h"
#include "renders/instant.h"
#include "renders/machine.h"

namespace rotorub::renders {

class MachineView {
 public:
  // Appends its meshes to `meshes`. The canvas of draw() must belong to a stage made of them.
  MachineView(const Machine& machine, std::vector<Mesh>& meshes);

  // `ghost`: a second pose drawn translucent, or null.
  void draw(Canvas canvas, const Instant& instant, const Pose* ghost) const;
  // Draws only the contact, on a shaft with this centre line that has already been drawn.
  void draw_bearing(Canvas canvas, const Instant& instant, const Eigen::Matrix2Xd& line) const;
  // Sets camera and light for a picture with this aspect (width / height), of the whole machine or
  // close to the contact.
  void set_up(mjvScene& scene, double aspect, bool close) const;

 private:
  // Mesh numbers of a body and of the mark that turns with it.
  struct Body {
    int solid = -1, mark = -1;
  };

  double plate_left() const;
  double plate_right() const;
  void draw_base(Canvas& canvas) const;
  void draw_pedestal(Canvas& canvas, double z, double top, double half_width,
                     double half_depth) const;
  void draw_shaft(Canvas& canvas, const Eigen::Matrix2Xd& line, const Color& color,
                  double thickness) const;
  void draw_body(Canvas& canvas, double z, const Body& body, const Color& color, const Pose& pose,
                 const Eigen::Matrix2Xd& line) const;
  void draw_bodies(Canvas& canvas, const Pose& pose, const Eigen::Matrix2Xd& line) const;
  void draw_ring_and_forces(Canvas& canvas, const Instant& instant) const;
  void draw_ring(Canvas& canvas, const DrawnSection& section, const Color& color) const;
  void draw_support(Canvas& canvas, const DrawnSection& section) const;
  void draw_strut(Canvas& canvas, const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  void draw_contact(Canvas& canvas, const Instant& instant, const DrawnSection& section) const;
  void draw_shadows(Canvas& canvas, const Pose& pose, const Eigen::Matrix2Xd& line) const;
  void draw_loads(Canvas& canvas, const Pose& pose, const Eigen::Matrix2Xd& line) const;

  Machine machine_;
  double side_ = 1.0;  // side of the contact that the camera sees, +1 or -1 along X
  // Mesh numbers.
  int ring_ = -1, housing_ = -1, bearing_ = -1;
  std::vector<int> magnets_;  // one per magnetic bearing
  Body rotor_;
  std::vector<Body> discs_;
};

}  // namespace rotorub::renders
