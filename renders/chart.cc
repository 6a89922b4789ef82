#include "renders/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renders/machine.h"
#include "renders/palette.h"

namespace rotorub::renders {

namespace {

// The least of 1, 2, 5, 10, ... times a power of ten that is not below `value` > 0.
double plain_step_above(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double plain : {1.0, 2.0, 5.0}) {
    if (plain * power >= value) return plain * power;
  }
  return 10.0 * power;
}

}  // namespace

Chart::Chart(const Options& options, const std::vector<Curve>& curves)
    : options_(options),
      reached_(options.width, options.height),
      future_(options.width, options.height) {
  for (const Curve& curve : curves) {
    for (std::size_t i = 0; i < curve.t.size(); ++i) {
      if (curve.t[i] < options.from || curve.t[i] > options.to) continue;
      peak_ = std::max(peak_, curve.values[i]);
    }
  }
  const int size = options.text_size;
  const bool clipped = options.mark_clipped && options.scale.clips(peak_);
  // The peak stands next to title and readings if there is room for the longest of them.
  const bool below = clipped && options.width < 30.0 * size;
  top_ = (below ? 3.2 : 1.9) * size;
  height_ = options.height - top_ - (options.times ? 1.4 * size : 3.0);
  // Charts below each other have the same width, unless a label is wider.
  const Sheet sheet(future_, {0, 0, options.width, options.height});
  double label = sheet.text_width("10,000 N s", size);
  for (const double value : grid()) {
    label = std::max(label, sheet.text_width(value_text(value, options.unit), size));
  }
  width_ = options.width - label - 1.2 * size;

  std::vector<Line> lines;
  for (const Curve& curve : curves) lines.push_back(line_of(curve));
  paint(lines, true);
  paint(lines, false);
}

double Chart::column(double t) const {
  return (width_ - 2.0) * (t - options_.from) / (options_.to - options_.from);
}

double Chart::row(double value) const {
  return top_ + height_ * (1.0 - options_.scale.share(value));
}

Chart::Line Chart::line_of(const Curve& curve) const {
  Line line;
  line.color = curve.color;
  // The rows of one column of pixels from `first` on, with the least and the largest value.
  std::size_t least = 0, largest = 0;
  int filled = -1;
  const auto add = [&](std::size_t i) {
    line.points.emplace_back(column(curve.t[i]), row(curve.values[i]));
  };
  const auto close = [&] {
    if (filled < 0) return;
    add(std::min(least, largest));
    if (least != largest && !options_.stems) add(std::max(least, largest));
    if (options_.mark_clipped && options_.scale.clips(curve.values[largest])) {
      line.clipped.push_back(column(curve.t[largest]));
    }
  };
  for (std::size_t i = 0; i < curve.t.size(); ++i) {
    if (curve.t[i] < options_.from || curve.t[i] > options_.to) continue;
    const int at = static_cast<int>(column(curve.t[i]));
    if (at != filled || options_.stems) {
      close();
      filled = at;
      least = largest = i;
    }
    if (curve.values[i] < curve.values[least]) least = i;
    if (curve.values[i] > curve.values[largest]) largest = i;
  }
  close();
  return line;
}

// Zero and a plain number on each side of the scale, the larger first. For a logarithmic scale
// every decade, from the top.
std::vector<double> Chart::grid() const {
  const ValueScale& scale = options_.scale;
  if (!scale.logarithmic) {
    std::vector<double> lines = {0.0};
    if (scale.high > 0.0) lines.push_back(plain_number_below(scale.high));
    if (scale.low < 0.0) lines.push_back(-plain_number_below(-scale.low));
    std::sort(lines.begin(), lines.end(),
              [](double a, double b) { return std::abs(a) > std::abs(b); });
    return lines;
  }
  std::vector<double> lines;
  for (double value = scale.high; value >= 0.999 * scale.low; value /= 10.0) lines.push_back(value);
  return lines;
}

void Chart::paint_scale(Sheet& sheet) const {
  const int size = options_.text_size;
  std::vector<double> written;
  for (const double value : grid()) {
    const double y = std::floor(row(value));
    sheet.fill(0.0, y, width_, 1.0, palette::kGrid);
    const double label = std::clamp(y - 0.45 * size, top_, top_ + height_ - 0.8 * size);
    const bool covers = std::any_of(written.begin(), written.end(), [&](double other) {
      return std::abs(label - other) < 1.1 * size;
    });
    // A label next to the line of 0 would be read as its label.
    const bool is_zero =
        value != 0.0 && options_.scale.low < 0.0 && std::abs(y - std::floor(row(0.0))) < size;
    if (value == 0.0 || covers || is_zero) continue;
    sheet.text(width_ + 6.0, label, value_text(value, options_.unit), size, palette::kFaintInk);
    written.push_back(label);
  }
}

void Chart::paint_times(Sheet& sheet) const {
  const int size = options_.text_size;
  const double most = std::max(1.0, width_ / (6.0 * size));  // labels for which there is room
  const double step = plain_step_above((options_.to - options_.from) / most);
  const bool seconds = options_.to >= 1.0;
  for (double k = std::ceil(options_.from / step); k * step <= options_.to; k += 1.0) {
    const double x = std::floor(column(k * step));
    sheet.fill(x, top_, 1.0, height_, palette::kGrid);
    if (!options_.times) continue;
    const std::string text =
        seconds ? fmt::format("{:.6g} s", k * step) : fmt::format("{:.6g} ms", 1e3 * k * step);
    const double half = 0.5 * sheet.text_width(text, size);
    sheet.text(std::max(2.0, x - half), top_ + height_ + 0.3 * size, text, size,
               palette::kFaintInk);
  }
}

void Chart::paint(const std::vector<Line>& lines, bool reached) {
  const int size = options_.text_size;
  Sheet sheet(reached ? reached_ : future_, {0, 0, options_.width, options_.height});
  sheet.text(0.6 * size, 0.35 * size, options_.title, size, palette::kInk);
  if (options_.mark_clipped && options_.scale.clips(peak_)) {
    sheet.text_to(options_.width - 0.6 * size, top_ - 1.55 * size,
                  "▲ peak " + value_text(peak_, options_.unit), size,
                  lines.size() == 1 ? lines.front().color : palette::kInk, Weight::kBold);
  }
  paint_times(sheet);
  paint_scale(sheet);
  for (const Line& line : lines) {
    const Color color = reached ? line.color : palette::kFuture;
    if (options_.stems) {
      for (const Sheet::Point& p : line.points) {
        sheet.fill(p[0], p[1], 2.0, row(0.0) - p[1], color);
      }
    } else {
      sheet.polyline(line.points, 1.6, color);
    }
    // A clipped value has a bar above the top.
    for (const double x : line.clipped) {
      sheet.fill(x, top_ - 0.25 * size, 2.0, 0.2 * size, color);
    }
  }
}

void Chart::draw(Sheet& sheet, double now, const std::vector<Reading>& readings) const {
  const int size = options_.text_size;
  const double at = column(std::clamp(now, options_.from, options_.to));
  sheet.show(reached_, 0.0, at);
  sheet.show(future_, at, options_.width);
  double x = 0.6 * size + sheet.text_width(options_.title, size);
  for (const Reading& reading : readings) {
    x = sheet.text(x + 0.6 * size, 0.35 * size, reading.text, size, reading.color);
  }
  sheet.fill(at, top_, 2.0, height_, palette::kInk);
}

}  // namespace rotorub::renders
