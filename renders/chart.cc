#include "renders/chart.h"

#include <algorithm>
#include <cmath>

#include "renders/machine.h"
#include "renders/palette.h"

namespace rotorub::renders {

Chart::Chart(const std::vector<double>& t, const std::vector<double>& values,
             const Options& options)
    : options_(options) {
  int filled = -1;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] < options.from || t[i] > options.to) continue;
    const double place = (t[i] - options.from) / (options.to - options.from);
    const int bucket = static_cast<int>(place * kBuckets);
    if (bucket != filled) buckets_.push_back({t[i], values[i], values[i]});
    filled = bucket;
    Bucket& last = buckets_.back();
    last.least = std::min(last.least, values[i]);
    last.largest = std::max(last.largest, values[i]);
    peak_ = std::max(peak_, values[i]);
  }
}

// Zero and one plain number; of a logarithmic scale every decade, from the top.
std::vector<double> Chart::grid() const {
  const ValueScale& scale = options_.scale;
  if (!scale.logarithmic) return {0.0, plain_number_below(scale.high)};
  std::vector<double> lines;
  for (double value = scale.high; value >= 0.999 * scale.low; value /= 10.0) lines.push_back(value);
  return lines;
}

void Chart::draw_scale(Sheet& sheet, int text_size, double top, double height, double width) const {
  std::vector<double> written;
  for (const double value : grid()) {
    const double y = std::floor(top + height * (1.0 - options_.scale.share(value)));
    sheet.fill(0.0, y, width, 1.0, palette::kGrid);
    const double label =
        std::clamp(y - 0.45 * text_size, top, sheet.area().height - 1.2 * text_size);
    const bool covers = std::any_of(written.begin(), written.end(), [&](double other) {
      return std::abs(label - other) < 1.1 * text_size;
    });
    if (value == 0.0 || covers) continue;
    sheet.text(width + 6.0, label, value_text(value, options_.unit), text_size, palette::kFaintInk);
    written.push_back(label);
  }
}

void Chart::draw(Sheet& sheet, int text_size, double now, const std::string& title,
                 const std::vector<Reading>& readings) const {
  const Area& area = sheet.area();
  sheet.fill(0.0, 0.0, area.width, area.height, palette::kPaper);
  const double gap = 0.6 * text_size;
  double x = sheet.text(gap, 0.35 * text_size, title, text_size, palette::kInk);
  for (const Reading& reading : readings) {
    x = sheet.text(x + gap, 0.35 * text_size, reading.text, text_size, reading.color);
  }
  const bool clipped = options_.mark_clipped && options_.scale.clips(peak_);
  if (clipped) {
    sheet.text_to(area.width - gap, 0.35 * text_size, "▲ peak " + value_text(peak_, options_.unit),
                  text_size, options_.color, Weight::kBold);
  }

  const double top = 1.9 * text_size;
  const double height = area.height - top - 3.0;
  // Charts below each other have one width, unless a label is wider.
  double label = sheet.text_width("10,000 N s", text_size);
  for (const double value : grid()) {
    label = std::max(label, sheet.text_width(value_text(value, options_.unit), text_size));
  }
  const double width = area.width - label - 2.0 * gap;
  draw_scale(sheet, text_size, top, height, width);
  const auto row = [&](double value) { return top + height * (1.0 - options_.scale.share(value)); };
  const auto column = [&](double t) {
    return (width - 2.0) * (t - options_.from) / (options_.to - options_.from);
  };
  for (std::size_t i = 0; i < buckets_.size(); ++i) {
    const Bucket& bucket = buckets_[i];
    const Color color = bucket.t <= now ? options_.color : palette::kFuture;
    const double at = column(bucket.t);
    double right = at + 2.0, upper = row(bucket.largest), lower = row(0.0);
    if (!options_.stems) {
      // Each bucket reaches up and down to its neighbour, so that the curve has no holes.
      if (i + 1 == buckets_.size()) break;
      const Bucket& next = buckets_[i + 1];
      right = std::max(at + 1.0, column(next.t));
      upper = row(std::max(bucket.largest, next.least));
      lower = row(std::min(bucket.least, next.largest)) + 1.5;
    }
    sheet.fill(at, upper, right - at, lower - upper, color);
    // Cut off: a bar over the top.
    if (options_.mark_clipped && options_.scale.clips(bucket.largest)) {
      sheet.fill(at, top - 0.25 * text_size, std::max(2.0, right - at), 0.2 * text_size, color);
    }
  }
  sheet.fill(column(std::clamp(now, options_.from, options_.to)), top, 2.0, height, palette::kInk);
}

}  // namespace rotorub::renders
