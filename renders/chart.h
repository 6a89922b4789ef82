// One curve over the whole film, with the present marked.
#pragma once

#include <string>
#include <vector>

#include "renders/scales.h"
#include "renders/sheet.h"

namespace rotorub::renders {

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

}  // namespace rotorub::renders
