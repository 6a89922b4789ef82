// One run in its part of the picture: curves and words; its views are those of the whole film.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renders/instant.h"
#include "renders/layout.h"
#include "renders/section_view.h"
#include "renders/sheet.h"
#include "renders/unrolled_view.h"

namespace rotorub::renders {

// One curve over the whole film, with the present marked.
class Chart {
 public:
  struct Options {
    double from = 0.0, to = 1.0;  // s
    ValueScale scale;
    Color color{0.0F, 0.0F, 0.0F};
    std::string unit;
    bool mark_clipped = true;  // say so where values are beyond the scale
    bool stems = false;        // values stand alone, each a line from 0, rather than on a curve
  };
  // What a chart says of the present, in its own colour.
  struct Reading {
    std::string text;
    Color color{0.0F, 0.0F, 0.0F};
  };

  // Values beyond the scale are cut off at the top; marked there, with the peak in words. Longer
  // series are thinned to the least and largest value of each of `kBuckets`.
  Chart(const std::vector<double>& t, const std::vector<double>& values, const Options& options);
  void draw(Sheet& sheet, int text_size, double now, const std::string& title,
            const std::vector<Reading>& readings) const;

 private:
  static constexpr int kBuckets = 600;
  struct Bucket {
    double t, least, largest;
  };
  void draw_scale(Sheet& sheet, int text_size, double top, double height, double width) const;
  std::vector<double> grid() const;

  Options options_;
  std::vector<Bucket> buckets_;
  double peak_ = 0.0;
};

// A run that is shown, or its ghost.
struct ShownRun {
  Playback playback;
  std::string label;
  std::vector<Playback> further;  // the same of each contact beside the first
};

// The cross-section at a contact beside the first, to the first one's scale.
struct FurtherSection {
  std::string name;
  Machine machine;
  SectionView view;
};

// What all panels of a film share.
struct FilmParts {
  double from = 0.0, to = 1.0;  // s, what is shown
  Scales scales;
  Machine machine, section;  // the same machine, each magnified for its view
  std::optional<SectionView> section_view;
  std::string contact_name;  // of the first; empty where it is the only one
  std::vector<FurtherSection> further;
  std::optional<UnrolledView> unrolled_view;
  double clearance = 0.0;  // m
  int text_size = 17;
  bool has_contact() const { return section_view.has_value(); }
  int charts() const { return !has_contact() ? 0 : scales.control.high > 0.0 ? 3 : 2; }
};

// "whirl -1,796 Hz, too fast to show: a place every 0.2 ms, 0.36 turns".
std::string strobe_text(const Strobe& strobe);

class Panel {
 public:
  // All must outlive it; the ghost may be null.
  Panel(const FilmParts& film, const PanelLayout& layout, const Trajectory& trajectory,
        const ShownRun& run, const ShownRun* ghost);

  // Everything but MuJoCo's picture of the machine, which is there already.
  // `further`: of each contact beside the first.
  void draw(const Sheet& picture, const Instant& instant, const std::vector<Instant>& further,
            const Pose* ghost, double trail_time) const;
  const Area& machine_area() const { return layout_.machine; }

 private:
  void make_charts(const Trajectory& trajectory);
  void draw_charts(const Sheet& picture, const Pose& pose) const;
  void draw_sections(const Sheet& picture, const Instant& instant,
                     const std::vector<Instant>& further, const Pose* ghost) const;
  void write_caption(Sheet sheet, const Instant& instant) const;
  void write_machine_text(Sheet sheet) const;
  void write_scale_bars(Sheet sheet) const;

  const FilmParts* film_;
  PanelLayout layout_;
  const ShownRun* run_;
  const ShownRun* ghost_;
  std::vector<Chart> charts_;  // gap, force or impulse, control
};

}  // namespace rotorub::renders
