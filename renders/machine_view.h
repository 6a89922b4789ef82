// The whole machine in perspective: bent shaft, discs, bearings, ring cut open towards the viewer.
#pragma once

#include <vector>

#include "renders/contact_marks.h"
#include "renders/machine.h"
#include "renders/stage.h"

namespace rotorub::renders {

class MachineView {
 public:
  // Adds its meshes to `meshes`; the stage made of them must be given to draw().
  MachineView(const Machine& machine, std::vector<Mesh>& meshes);

  // `force_length`: drawn length of one newton. `ghost`: a second pose drawn translucent, or null.
  void draw(const Stage& stage, mjvScene& scene, const Instant& instant, const Pose* ghost,
            double force_length) const;
  // Sets camera and light for a picture of this shape (width / height).
  void set_up(mjvScene& scene, double aspect) const;

 private:
  double plate_left() const;
  double plate_right() const;
  void draw_base(const Stage& stage, Canvas& canvas) const;
  void draw_pedestal(Canvas& canvas, double z, double top, double half_width,
                     double half_depth) const;
  void draw_shaft(Canvas& canvas, const Eigen::Matrix2Xd& line, const Color& color,
                  double thickness) const;
  void draw_bodies(const Stage& stage, Canvas& canvas, const Pose& pose,
                   const Eigen::Matrix2Xd& line) const;
  void draw_ring(const Stage& stage, Canvas& canvas, const DrawnSection& section,
                 const Color& color) const;
  void draw_contact(Canvas& canvas, const Instant& instant, const DrawnSection& section,
                    double force_length) const;

  Machine machine_;
  // Meshes by number; a body and the mark that turns with it.
  struct Body {
    int solid = -1, mark = -1;
  };
  int ring_ = -1, bearing_ = -1, magnet_ = -1;
  Body rotor_;
  std::vector<Body> discs_;
};

}  // namespace rotorub::renders
