// The panel of one run in a picture: its curves and texts. All panels of a film share the views.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renders/chart.h"
#include "renders/instant.h"
#include "renders/layout.h"
#include "renders/section_view.h"
#include "renders/sheet.h"
#include "renders/unrolled_view.h"

namespace rotorub::renders {

// A run that is shown, or its ghost.
struct ShownRun {
  Playback playback;
  std::string label, remark;
  std::vector<Playback> further;  // the same run at each contact after the first
  const Playback& at_contact(std::size_t k) const { return k == 0 ? playback : further[k - 1]; }
};

// The cross-section at a further contact, in the scale of all contacts.
struct FurtherSection {
  std::string name;
  Machine machine;
  SectionView view;
};

// Data shared by all panels of a film.
struct FilmParts {
  double from = 0.0, to = 1.0;  // s, the shown part
  Scales scales;
  Machine machine, section;  // the same machine with the magnification of each view
  std::optional<SectionView> section_view;
  std::string contact_name;  // of the first contact; empty if it is the only one
  std::vector<FurtherSection> further;
  std::optional<UnrolledView> unrolled_view;
  double clearance = 0.0;  // m
  int text_size = 17;
  bool has_contact() const { return section_view.has_value(); }
  std::size_t contacts() const { return 1 + further.size(); }
  const std::string& name_of(std::size_t contact) const {
    return contact == 0 ? contact_name : further[contact - 1].name;
  }
  int charts() const { return !has_contact() ? 0 : scales.control.high > 0.0 ? 3 : 2; }
};

// "whirl -1,796 Hz: one position every 0.2 ms, 0.36 turns apart".
std::string strobe_text(const Strobe& strobe);

class Panel {
 public:
  // All arguments must outlive the panel; the ghost may be null.
  Panel(const FilmParts& film, const PanelLayout& layout, const Trajectory& trajectory,
        const ShownRun& run, const ShownRun* ghost);

  // Draws everything except MuJoCo's picture of the machine, which must already be there.
  // `further`: one for each contact after the first.
  void draw(const Sheet& picture, const Instant& instant, const std::vector<Instant>& further,
            const Pose* ghost, double trail_time) const;
  const Area& machine_area() const { return layout_.machine; }

 private:
  void make_charts(const Trajectory& trajectory);
  void draw_charts(const Sheet& picture, const Instant& instant,
                   const std::vector<Instant>& further) const;
  void draw_sections(const Sheet& picture, const Instant& instant,
                     const std::vector<Instant>& further, const Pose* ghost) const;
  void write_caption(Sheet sheet, const Instant& instant) const;
  void write_machine_text(Sheet sheet) const;
  void write_key(Sheet sheet, const std::string& heading) const;
  void write_scale_bars(Sheet sheet) const;

  const FilmParts* film_;
  PanelLayout layout_;
  const ShownRun* run_;
  const ShownRun* ghost_;
  std::vector<Chart> charts_;  // gap, force or impulse, control
};

}  // namespace rotorub::renders
