// Curves over the whole film, with a mark at the present time.
#pragma once

#include <string>
#include <vector>

#include "renders/instant.h"
#include "renders/sheet.h"

namespace rotorub::renders {

class Chart {
 public:
  struct Options {
    int width = 320, height = 160, text_size = 14;  // pixels
    double from = 0.0, to = 1.0;                    // s
    ValueScale scale;
    std::string title, unit;
    bool mark_clipped = true;  // marks values beyond the scale
    bool stems = false;        // separate values, each drawn as a line from 0, instead of a curve
    bool times = true;         // writes the times below the curves
  };
  struct Curve {
    std::vector<double> t, values;  // s, and in `unit`
    Color color{0.0F, 0.0F, 0.0F};
  };
  // A text for the present value, in its own colour.
  struct Reading {
    std::string text;
    Color color{0.0F, 0.0F, 0.0F};
  };

  // Values beyond the scale are clipped and marked at the top, with the peak as text. In each
  // column of pixels a curve goes through the least and the largest value of its rows there.
  Chart(const Options& options, const std::vector<Curve>& curves);
  void draw(Sheet& sheet, double now, const std::vector<Reading>& readings) const;

 private:
  struct Line {
    std::vector<Sheet::Point> points;  // pixels
    std::vector<double> clipped;       // columns
    Color color;
  };
  Line line_of(const Curve& curve) const;
  void paint(const std::vector<Line>& lines, bool reached);
  void paint_scale(Sheet& sheet) const;
  void paint_times(Sheet& sheet) const;
  std::vector<double> grid() const;
  double column(double t) const;
  double row(double value) const;

  Options options_;
  double peak_ = 0.0;
  double top_ = 0.0, width_ = 0.0, height_ = 0.0;  // pixels, of the area with the curves
  Picture reached_, future_;  // everything but mark and readings, in the colours of each part
};

}  // namespace rotorub::renders
