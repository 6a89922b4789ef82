// The contact unrolled: gap over the angle around the ring, the gap logarithmic from a tenth of a
// micrometre to the clearance, so that a bounce of 3 um is seen beside an orbit of 0.5 mm.
// Penetration of a soft contact goes down from the ring's line by the same law.
#pragma once

#include "renders/instant.h"
#include "renders/playback.h"
#include "renders/sheet.h"

namespace rotorub::renders {

class UnrolledView {
 public:
  static constexpr double kLeast = 1e-7;  // m: nearer is on the ring's line

  // `clearance` and `penetration`, the deepest of the runs that are shown, m.
  UnrolledView(double clearance, double penetration);

  // The path of the last `trail_time` s, the impacts, and where the contact is now.
  void draw(Sheet& sheet, int text_size, const Playback& playback, const Instant& instant,
            double trail_time, const Playback* ghost) const;
  // Share of the height, from the top, of a gap: m, negative for a penetration.
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
