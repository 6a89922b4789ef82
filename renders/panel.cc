#include "renders/panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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
    // A label next to the line of 0 would be read as its label.
    const double zero = std::floor(top + height * (1.0 - options_.scale.share(0.0)));
    const bool is_zero = value != 0.0 && options_.scale.low < 0.0 && std::abs(y - zero) < text_size;
    if (value == 0.0 || covers || is_zero) continue;
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
  // Next to title and readings if there is room for the longest of them, else below.
  const bool below = clipped && area.width < 30.0 * text_size;
  const double line = 0.35 * text_size + (below ? 1.3 * text_size : 0.0);
  if (clipped) {
    sheet.text_to(area.width - gap, line, "▲ peak " + value_text(peak_, options_.unit), text_size,
                  options_.color, Weight::kBold);
  }

  const double top = line + 1.55 * text_size;
  const double height = area.height - top - 3.0;
  // Charts below each other have the same width, unless a label is wider.
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
      // Each bucket extends to its neighbour, so that the curve has no gaps.
      if (i + 1 == buckets_.size()) break;
      const Bucket& next = buckets_[i + 1];
      right = std::max(at + 1.0, column(next.t));
      upper = row(std::max(bucket.largest, next.least));
      lower = row(std::min(bucket.least, next.largest)) + 1.5;
    }
    sheet.fill(at, upper, right - at, lower - upper, color);
    // A clipped value has a bar above the top.
    if (options_.mark_clipped && options_.scale.clips(bucket.largest)) {
      sheet.fill(at, top - 0.25 * text_size, std::max(2.0, right - at), 0.2 * text_size, color);
    }
  }
  sheet.fill(column(std::clamp(now, options_.from, options_.to)), top, 2.0, height, palette::kInk);
}

namespace {

std::vector<double> control_size(const Trajectory& trajectory) {
  const auto& x = trajectory.column("control_x");
  const auto& y = trajectory.column("control_y");
  std::vector<double> size;
  for (std::size_t i = 0; i < x.size(); ++i) size.push_back(std::hypot(x[i], y[i]));
  return size;
}

}  // namespace

Panel::Panel(const FilmParts& film, const PanelLayout& layout, const Trajectory& trajectory,
             const ShownRun& run, const ShownRun* ghost)
    : film_(&film), layout_(layout), run_(&run), ghost_(ghost) {
  if (film.has_contact()) make_charts(trajectory);
}

void Panel::make_charts(const Trajectory& trajectory) {
  const Scales& scales = film_->scales;
  const auto& t = trajectory.column("t");
  Chart::Options options;
  options.from = film_->from;
  options.to = film_->to;

  // The free orbit before contact exceeds the scale of the gap chart.
  options.mark_clipped = false;
  options.scale = scales.gap;
  options.color = palette::kTrail;
  options.unit = "µm";
  std::vector<double> gap = trajectory.column("gap");
  for (double& value : gap) value *= 1e6;
  charts_.emplace_back(t, gap, options);

  options.mark_clipped = true;
  options.color = palette::kNormal;
  if (scales.impulses) {
    options.scale = scales.impulse;
    options.unit = "N s";
    options.stems = true;
    std::vector<double> times, impulses;
    for (const Strike& strike : run_->playback.strikes()) {
      times.push_back(strike.t);
      impulses.push_back(strike.impulse);
    }
    charts_.emplace_back(times, impulses, options);
  } else {
    options.scale = scales.force;
    if (!(scales.force.high > 0.0)) options.scale.high = 1.0;
    options.unit = "N";
    charts_.emplace_back(t, trajectory.column("normal_force"), options);
  }
  options.stems = false;

  if (!(scales.control.high > 0.0)) return;
  options.scale = scales.control;
  options.color = palette::kControl;
  options.unit = "N";
  const bool controlled = trajectory.has("control_x");
  charts_.emplace_back(
      t, controlled ? control_size(trajectory) : std::vector<double>(t.size(), 0.0), options);
}

// Several sections are stacked vertically.
void Panel::draw_sections(const Sheet& picture, const Instant& instant,
                          const std::vector<Instant>& further, const Pose* ghost) const {
  const Area& whole = layout_.section;
  const int count = 1 + static_cast<int>(film_->further.size());
  for (int k = 0; k < count; ++k) {
    const int top = k * whole.height / count, bottom = (k + 1) * whole.height / count;
    Sheet sheet = picture.part({whole.left, whole.top + top, whole.width, bottom - top});
    const Area& area = sheet.area();
    sheet.fill(0, 0, area.width, area.height, palette::kBackground);
    if (k == 0) {
      film_->section_view->draw(sheet, instant, ghost);
      write_scale_bars(sheet);
    } else {
      const auto at = static_cast<std::size_t>(k - 1);
      film_->further[at].view.draw(sheet, further[at], nullptr);
    }
    if (count == 1) continue;
    const Pose& pose = k == 0 ? instant.pose : further[static_cast<std::size_t>(k - 1)].pose;
    const std::string& name =
        k == 0 ? film_->contact_name : film_->further[static_cast<std::size_t>(k - 1)].name;
    const int size = film_->text_size;
    const double y = area.height - 1.5 * size;
    const double x = sheet.text(0.6 * size, y, name, size, palette::kInk, Weight::kBold);
    const bool touching = pose.mode != Mode::kFree;
    sheet.text(x + 0.6 * size, y, to_string(pose.mode), size,
               touching ? palette::kNormal : palette::kFaintInk);
  }
}

void Panel::draw(const Sheet& picture, const Instant& instant, const std::vector<Instant>& further,
                 const Pose* ghost, double trail_time) const {
  if (layout_.section.width > 0) draw_sections(picture, instant, further, ghost);
  if (layout_.unrolled.width > 0) {
    Sheet sheet = picture.part(layout_.unrolled);
    film_->unrolled_view->draw(sheet, film_->text_size, run_->playback, instant, trail_time,
                               ghost_ != nullptr ? &ghost_->playback : nullptr);
  }
  if (layout_.machine.width > 0) write_machine_text(picture.part(layout_.machine));
  write_caption(picture.part(layout_.caption), instant);
  if (!charts_.empty()) draw_charts(picture, instant.pose);
}

void Panel::write_caption(Sheet sheet, const Instant& instant) const {
  const Pose& pose = instant.pose;
  const int size = film_->text_size;
  double x = sheet.text(size, 0.3 * size, run_->label, size, palette::kInk);
  if (ghost_ != nullptr) {
    sheet.text(size, 1.6 * size, "translucent: " + ghost_->label, size, palette::kGhost);
  }
  if (instant.strobe) {
    const double y = (ghost_ != nullptr ? 2.9 : 1.6) * size;
    const std::string text = strobe_text(*instant.strobe);
    sheet.fill(size, y, sheet.text_width(text, size), 1.3 * size,
               palette::kBackground.with_alpha(0.8));
    sheet.text(size, y, text, size, palette::kNormal);
  }
  if (!film_->has_contact() || !film_->further.empty()) return;
  const bool touching = pose.mode != Mode::kFree;
  sheet.text(x + size, 0.3 * size, to_string(pose.mode), size,
             touching ? palette::kNormal : palette::kFaintInk, Weight::kBold);
}

std::string strobe_text(const Strobe& strobe) {
  const double turns_a_second = strobe.whirl / (2.0 * std::numbers::pi);
  return fmt::format("whirl {}: one position every {}, {:.2g} turns apart",
                     value_text(turns_a_second, "Hz"), value_text(1e3 * strobe.spacing, "ms"),
                     std::abs(turns_a_second) * strobe.spacing);
}

void Panel::write_machine_text(Sheet sheet) const {
  const int size = film_->text_size;
  const Machine& machine = film_->machine;
  std::string text = fmt::format("displacements ×{:.4g}", machine.magnification);
  if (machine.schematic) text += ", shaft schematic";
  sheet.text(size, sheet.area().height - 1.6 * size, text, size, palette::kInk);
}

// Scale bars for the clearance and the forces.
void Panel::write_scale_bars(Sheet sheet) const {
  const Area& area = sheet.area();
  const int size = std::min(film_->text_size, std::max(9, area.height / 26));
  const double pixels = film_->section_view->pixels(area);
  const DrawnContact& contact = *film_->section.contact;
  // Below the caption and its remark on the whirl, where there is no actuator.
  double y = (layout_.section.left == layout_.caption.left ? 3.4 : 2.2) * size;
  const auto bar = [&](double length, const std::string& text, const Color& color) {
    const double wide = std::max(length, sheet.text_width(text, size));
    sheet.fill(0.6 * size, y, wide + 0.8 * size, 1.7 * size, palette::kBackground.with_alpha(0.8));
    sheet.text(size, y, text, size, palette::kInk);
    sheet.fill(size, y + 1.2 * size, length, 3.0, color);
    y += 1.9 * size;
  };
  const double longest = kArrowShare * contact.rotor_radius * pixels;
  bar(contact.clearance * pixels, "clearance " + length_text(film_->clearance), palette::kInk);
  const auto force = [&](const ValueScale& scale, const char* name, const Color& color) {
    const double shown = scale.logarithmic ? scale.high : plain_number_below(scale.high);
    bar(scale.share(shown) * longest,
        fmt::format("{} {}{}", name, value_text(shown, "N"), scale.logarithmic ? ", log" : ""),
        color);
  };
  if (!film_->scales.impulses && film_->scales.force.high > 0.0) {
    force(film_->scales.force, "contact", palette::kNormal);
  }
  if (film_->scales.control.high > 0.0) force(film_->scales.control, "control", palette::kControl);
  if (film_->scales.current.high > 0.0) {
    bar(kCurrentShare * contact.rotor_radius * pixels,
        "coil current " + value_text(film_->scales.current.high, "A"), palette::kCurrent);
  }
  sheet.text_to(area.width - 0.6 * size, area.height - 1.5 * size,
                fmt::format("×{:.4g}", film_->section.magnification), size, palette::kInk);
}

void Panel::draw_charts(const Sheet& picture, const Pose& pose) const {
  const int size = film_->text_size;
  const auto draw = [&](std::size_t k, const std::string& title,
                        const std::vector<Chart::Reading>& readings) {
    Sheet sheet = picture.part(layout_.charts[k]);
    const std::string& of = film_->contact_name;
    charts_[k].draw(sheet, size, pose.t, of.empty() ? title : of + ": " + title, readings);
  };
  draw(0, "gap",
       {{fmt::format("{:.1f} µm", std::abs(pose.gap) < 0.05e-6 ? 0.0 : 1e6 * pose.gap),
         palette::kTrail}});
  if (film_->scales.impulses) {
    double last = 0.0;
    for (const Strike& strike : run_->playback.strikes()) {
      if (strike.t <= pose.t) last = strike.impulse;
    }
    draw(1, "last impulse", {{fmt::format("{:.4f} N s", last), palette::kNormal}});
  } else {
    draw(1, "force",
         {{value_text(pose.normal_force, "N"), palette::kNormal},
          {"friction " + value_text(pose.friction_force, "N"), palette::kFriction}});
  }
  if (charts_.size() > 2) {
    draw(2, "control", {{value_text(pose.control.norm(), "N"), palette::kControl}});
  }
}

}  // namespace rotorub::renders
