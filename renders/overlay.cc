#include "renders/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renders/machine.h"
#include "renders/palette.h"

namespace rotorub::renders {

namespace {

constexpr int kFirstPrintable = 32;
constexpr int kLastPrintable = 126;

int character_width(const int (&widths)[127], char c) {
  const int code = static_cast<unsigned char>(c);
  return code < kFirstPrintable || code > kLastPrintable ? 0 : widths[code];
}

int text_width(const int (&widths)[127], const std::string& text) {
  int width = 0;
  for (const char c : text) width += character_width(widths, c);
  return width;
}

}  // namespace

int Pen::put(int font, int x, int y, const std::string& text, const Color& color) const {
  const bool big = font == mjFONT_BIG;
  const int width = text_width(big ? context_->charWidthBig : context_->charWidth, text);
  const int height = big ? context_->charHeightBig : context_->charHeight;
  // A label is centred in its rectangle: one that just holds the text puts it where it should be.
  const mjrRect place{area_.left + x, area_.bottom + area_.height - y - height, width, height};
  mjr_label(place, font, text.c_str(), 0.0F, 0.0F, 0.0F, 0.0F, color.red, color.green, color.blue,
            context_);
  return x + width;
}

int Pen::write(int x, int y, const std::string& text, const Color& color) const {
  return put(mjFONT_NORMAL, x, y, text, color);
}

int Pen::write_big(int x, int y, const std::string& text, const Color& color) const {
  return put(mjFONT_BIG, x, y, text, color);
}

int Pen::width(const std::string& text) const { return text_width(context_->charWidth, text); }

int Pen::line_height() const { return context_->charHeight; }

void Pen::bar(int x, int y, int width, int height, const Color& color) const {
  mjr_rectangle({area_.left + x, area_.bottom + area_.height - y - height, width, height},
                color.red, color.green, color.blue, color.alpha);
}

Chart::Chart(const std::vector<double>& t, const std::vector<double>& values,
             const Options& options)
    : options_(options) {
  constexpr int kBuckets = 600;
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
  }
  set_scale(t, values);
}

void Chart::set_scale(const std::vector<double>& t, const std::vector<double>& values) {
  constexpr double kShown = 0.99;
  std::vector<double> scaled;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] >= options_.scale_from && t[i] <= options_.to) scaled.push_back(values[i]);
  }
  if (!scaled.empty()) {
    std::sort(scaled.begin(), scaled.end());
    least_ = std::min(0.0, scaled.front());
    const double place = kShown * static_cast<double>(scaled.size() - 1);
    largest_ = 1.1 * scaled[static_cast<std::size_t>(std::ceil(place))];
  }
  largest_ = std::max(largest_, options_.least_height);
  if (!(largest_ > 0.0)) largest_ = 1.0;
  least_ = std::max(least_, -largest_);
  grid_ = plain_number_below(largest_);
}

int Chart::draw(const mjrContext& context, const mjrRect& area, double now,
                const std::string& title, const std::string& reading) const {
  const Pen pen(context, area);
  const int top = pen.line_height() + 8;
  const int height = area.height - top;
  pen.bar(0, 0, area.width, area.height, palette::kPaper);
  const int after = pen.write(6, 3, title, palette::kInk);
  pen.write(after + 10, 3, reading, options_.color);

  // Scale: zero and one plain number.
  const auto row = [&](double value) {
    const double shown = std::clamp(value, least_, largest_);
    return top +
           static_cast<int>(std::lround((height - 6) * (largest_ - shown) / (largest_ - least_)));
  };
  const std::string label = fmt::format("{:.4g} {}", grid_, options_.unit);
  const int plot = area.width - pen.width(label) - 10;
  pen.bar(0, row(0.0), plot, 1, palette::kGrid);
  pen.bar(0, row(grid_), plot, 1, palette::kGrid);
  pen.write(plot + 6, std::min(row(grid_) - pen.line_height() / 2, area.height - pen.line_height()),
            label, palette::kFaintInk);

  // Each bucket reaches up and down to its neighbour, so that the curve has no holes.
  const auto column = [&](double t) {
    return static_cast<int>(
        std::lround((plot - 2) * (t - options_.from) / (options_.to - options_.from)));
  };
  for (std::size_t i = 0; i < buckets_.size(); ++i) {
    const Bucket& bucket = buckets_[i];
    const Color color = bucket.t <= now ? options_.color : palette::kFuture;
    const int x = column(bucket.t);
    if (options_.stems) {
      pen.bar(x, row(bucket.largest), 2, row(0.0) - row(bucket.largest), color);
    } else if (i + 1 < buckets_.size()) {
      const Bucket& next = buckets_[i + 1];
      const int upper = row(std::max(bucket.largest, next.least));
      const int lower = row(std::min(bucket.least, next.largest));
      pen.bar(x, upper, std::max(1, column(next.t) - x), lower - upper + 2, color);
    }
  }
  pen.bar(column(std::clamp(now, options_.from, options_.to)), top, 2, height, palette::kInk);
  return after + 10 + pen.width("00000.0 N") + 10;
}

}  // namespace rotorub::renders
