// The contact unrolled: the gap over the angle around the ring. The gap is logarithmic from a tenth
// of a micrometre to the clearance, so that a bounce of 3 um is visible beside an orbit of 0.5 mm.
// Penetration of a compliant contact extends below the ring's line with the same scale.
#pragma once

#include "renders/instant.h"
#include "renders/playback.h"
#include "renders/sheet.h"

namespace rotorub::renders {

class UnrolledView {
 public:
  static constexpr double kLeast = 1e-7;  // m: smaller gaps lie on the ring's line

  // `clearance`, and `penetration`: the deepest of the shown runs, m.
  UnrolledView(double clearance, double penetration);

  // Draws the path of the last `trail_time` s, the impacts and the present position.
  void draw(Sheet& sheet, int text_size, const Playback& playback, const Instant& instant,
            double trail_time, const Playback* ghost) const;
  // Fraction of the height, from the top, of a gap in m; negative gaps are penetration.
  double height_of(double gap) const;

 private:
  void draw_grid(Sheet& sheet, int text_size, const Area& plot) const;
  void draw_path(Sheet& sheet, const Area& plot, const Playback& playback, double t,
                 double trail_time, const Color& color) const;
  Sheet::Point place(const Area& plot, const Pose& pose) const;

  double decades_up_, decades_down_;  // from kLeast
  double clearance_;
};

}  // namespace rotorub::renders
