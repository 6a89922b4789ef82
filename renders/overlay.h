// Flat things over the pictures: text, bars, the curves of gap and force.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>
#include <vector>

#include "renders/canvas.h"

namespace rotorub::renders {

// Text in MuJoCo's own fonts, ASCII, placed by pixels from the left and from the top of a
// rectangle.
class Pen {
 public:
  Pen(const mjrContext& context, const mjrRect& area) : context_(&context), area_(area) {}
  // Writes to the right of x; returns the x after the text.
  int write(int x, int y, const std::string& text, const Color& color) const;
  int write_big(int x, int y, const std::string& text, const Color& color) const;
  int width(const std::string& text) const;
  int line_height() const;
  // A filled rectangle.
  void bar(int x, int y, int width, int height, const Color& color) const;

 private:
  int put(int font, int x, int y, const std::string& text, const Color& color) const;
  const mjrContext* context_;
  mjrRect area_;
};

// One curve over the whole film, with the present marked.
class Chart {
 public:
  // The height shows values from `scale_from` on, but for the largest 1 %, which leave it at the
  // top. Longer series are thinned to the least and largest value of each bucket. `stems`: values
  // stand alone, each a line from 0, rather than on a curve.
  struct Options {
    double from = 0.0, to = 1.0;  // s
    double scale_from = 0.0;      // s
    double least_height = 0.0;    // of the scale, so that noise about 0 stays small
    Color color{0.0F, 0.0F, 0.0F};
    std::string unit;
    bool stems = false;
  };
  Chart(const std::vector<double>& t, const std::vector<double>& values, const Options& options);
  // `title` and `reading` stand above the curve, the reading in the curve's colour. Returns where
  // further text may begin, pixels from the left of `area`.
  int draw(const mjrContext& context, const mjrRect& area, double now, const std::string& title,
           const std::string& reading) const;

 private:
  struct Bucket {
    double t, least, largest;
  };
  void set_scale(const std::vector<double>& t, const std::vector<double>& values);

  Options options_;
  std::vector<Bucket> buckets_;
  double least_ = 0.0, largest_ = 0.0, grid_ = 0.0;
};

}  // namespace rotorub::renders
