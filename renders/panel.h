// One run in its part of the picture: curves and words; its views are those of the whole film.
#pragma once

#include <optional>
#include <string>

#include "renders/chart.h"
#include "renders/layout.h"
#include "renders/section_view.h"
#include "renders/unrolled_view.h"

namespace rotorub::renders {

// A run that is shown, or its ghost.
struct ShownRun {
  Playback playback;
  std::string label;
};

// What all panels of a film share.
struct FilmParts {
  double from = 0.0, to = 1.0;  // s, what is shown
  Scales scales;
  Machine machine, section;  // the same machine, each magnified for its view
  std::optional<SectionView> section_view;
  std::optional<UnrolledView> unrolled_view;
  double clearance = 0.0;  // m
  int text_size = 17;
  bool has_contact() const { return section_view.has_value(); }
  int charts() const { return !has_contact() ? 0 : scales.control.high > 0.0 ? 3 : 2; }
};

class Panel {
 public:
  // All must outlive it; the ghost may be null.
  Panel(const FilmParts& film, const PanelLayout& layout, const Trajectory& trajectory,
        const ShownRun& run, const ShownRun* ghost);

  // Everything but MuJoCo's picture of the machine, which is there already.
  void draw(const Sheet& picture, const Instant& instant, const Pose* ghost,
            double trail_time) const;
  const Area& machine_area() const { return layout_.machine; }

 private:
  void make_charts(const Trajectory& trajectory);
  void draw_charts(const Sheet& picture, const Pose& pose) const;
  void write_caption(Sheet sheet, const Pose& pose) const;
  void write_machine_text(Sheet sheet) const;
  void write_scale_bars(Sheet sheet) const;

  const FilmParts* film_;
  PanelLayout layout_;
  const ShownRun* run_;
  const ShownRun* ghost_;
  std::vector<Chart> charts_;  // gap, force or impulse, control
};

}  // namespace rotorub::renders
