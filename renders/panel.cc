#include "renders/panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "native_model/trajectory/columns.h"
#include "renders/corners.h"
#include "renders/machine.h"
#include "renders/palette.h"

namespace rotorub::renders {

namespace {

// The colour of a contact's curves. A single contact has the colours of its quantities.
Color curve_color(const FilmParts& film, std::size_t contact, const Color& alone) {
  return film.contacts() == 1 ? alone : palette::contact(contact);
}

}  // namespace

Panel::Panel(const FilmParts& film, const PanelLayout& layout, const Trajectory& trajectory,
             const ShownRun& run, const ShownRun* ghost)
    : film_(&film), layout_(layout), run_(&run), ghost_(ghost) {
  if (film.has_contact()) make_charts(trajectory);
}

void Panel::make_charts(const Trajectory& trajectory) {
  const Scales& scales = film_->scales;
  Chart::Options options;
  options.from = film_->from;
  options.to = film_->to;
  options.text_size = film_->text_size;
  const auto column = [&](std::size_t contact, const char* name) {
    const std::string full = column_of_contact(contact, name);
    return trajectory.has(full) ? trajectory.column(full) : std::vector<double>();
  };
  const auto add = [&](const Color& alone, const auto& curve_of) {
    std::vector<Chart::Curve> curves;
    for (std::size_t k = 0; k < film_->contacts(); ++k) {
      curves.push_back(curve_of(k));
      curves.back().color = curve_color(*film_, k, alone);
    }
    const Area& area = layout_.charts[charts_.size()];
    options.width = area.width;
    options.height = area.height;
    // The last of the charts below each other has the time axis.
    options.times = area.bottom() == layout_.charts.back().bottom();
    charts_.emplace_back(options, curves);
  };
  const auto& t = trajectory.column("t");

  // The free orbit before contact exceeds the scale of the gap chart.
  options.mark_clipped = false;
  options.scale = scales.gap;
  options.title = "gap";
  options.unit = "µm";
  add(palette::kTrail, [&](std::size_t k) {
    std::vector<double> gap = column(k, "gap");
    for (double& value : gap) value *= 1e6;
    return Chart::Curve{t, gap};
  });

  options.mark_clipped = true;
  if (scales.impulses) {
    options.scale = scales.impulse;
    options.title = "last impulse";
    options.unit = "N s";
    options.stems = true;
    add(palette::kNormal, [&](std::size_t k) {
      Chart::Curve impulses;
      for (const Strike& strike : run_->at_contact(k).strikes()) {
        impulses.t.push_back(strike.t);
        impulses.values.push_back(strike.impulse);
      }
      return impulses;
    });
    options.stems = false;
  } else {
    options.scale = scales.force;
    if (!(scales.force.high > 0.0)) options.scale.high = 1.0;
    options.title = "force";
    options.unit = "N";
    add(palette::kNormal, [&](std::size_t k) {
      return Chart::Curve{t, column(k, "normal_force")};
    });
  }

  if (!(scales.control.high > 0.0)) return;
  options.scale = scales.control;
  options.title = "control";
  options.unit = "N";
  add(palette::kControl, [&](std::size_t k) {
    const std::vector<double> x = column(k, "control_x"), y = column(k, "control_y");
    std::vector<double> size(t.size(), 0.0);
    for (std::size_t i = 0; i < x.size(); ++i) size[i] = std::hypot(x[i], y[i]);
    return Chart::Curve{t, size};
  });
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
    const auto contact = static_cast<std::size_t>(k);
    const Pose& pose = k == 0 ? instant.pose : further[contact - 1].pose;
    const int size = film_->text_size;
    const double y = area.height - 1.5 * size;
    const double x = sheet.text(0.6 * size, y, film_->name_of(contact), size,
                                palette::contact(contact), Weight::kBold);
    const bool touching = pose.mode != ContactMode::kFree;
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
  if (layout_.machine.width > 0) {
    write_machine_text(picture.part(layout_.machine));
  } else {
    write_key(picture.part(layout_.section.width > 0 ? layout_.section : layout_.unrolled), "");
  }
  write_caption(picture.part(layout_.caption), instant);
  if (!charts_.empty()) draw_charts(picture, instant, further);
}

void Panel::write_caption(Sheet sheet, const Instant& instant) const {
  const Pose& pose = instant.pose;
  const int size = film_->text_size;
  const double x = sheet.text(size, 0.3 * size, run_->label, size, palette::kInk);
  double y = 0.3 * size;
  const auto line = [&](const std::string& text, const Color& color) {
    y += 1.3 * size;
    sheet.fill(size, y, sheet.text_width(text, size), 1.3 * size,
               palette::kBackground.with_alpha(0.8));
    sheet.text(size, y, text, size, color);
  };
  if (!run_->remark.empty()) line(run_->remark, palette::kInk);
  if (ghost_ != nullptr) line("translucent: " + ghost_->label, palette::kGhost);
  if (instant.strobe) line(strobe_text(*instant.strobe), palette::kNormal);
  if (!film_->has_contact() || !film_->further.empty()) return;
  const bool touching = pose.mode != ContactMode::kFree;
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
  const Machine& machine = film_->machine;
  write_key(sheet, fmt::format("displacements ×{:.4g}{}", machine.magnification,
                               machine.schematic ? ", shaft schematic" : ""));
}

// The heading and the meaning of the colours, at the bottom of the area in as many lines as they
// need.
void Panel::write_key(Sheet sheet, const std::string& heading) const {
  const int size = film_->text_size;
  const bool loads = !film_->machine.loads.empty() && layout_.machine.width > 0;
  struct Entry {
    std::string name;
    Color color;
    bool seen, is_heading = false;
    double x = 0.0;
    int line = 0;
  };
  std::vector<Entry> entries = {{heading, palette::kInk, !heading.empty(), true}};
  if (film_->has_contact()) {
    const bool path = layout_.machine.width == 0 || layout_.section.width > 0;
    entries.insert(entries.end(),
                   {{"path", palette::kTrail, path},
                    {"normal force", palette::kNormal, !film_->scales.impulses},
                    {"friction", palette::kFriction, layout_.section.width > 0},
                    {"control", palette::kControl, film_->scales.control.high > 0.0},
                    {"load", palette::kLoad, loads},
                    {"impact", palette::kStrike, !run_->playback.strikes().empty()}});
  }
  std::erase_if(entries, [](const Entry& entry) { return !entry.seen; });
  double x = size;
  int line = 0;
  for (Entry& entry : entries) {
    const double width = sheet.text_width(entry.name, size) + (entry.is_heading ? 0.0 : 0.9 * size);
    if (x > size && x + width > sheet.area().width) {
      x = size;
      ++line;
    }
    entry.x = x;
    entry.line = line;
    x += width + 0.9 * size;
  }
  for (const Entry& entry : entries) {
    const double y = sheet.area().height - (1.6 + 1.5 * (line - entry.line)) * size;
    const double text = entry.x + (entry.is_heading ? 0.0 : 0.9 * size);
    sheet.fill(entry.x, y, text - entry.x + sheet.text_width(entry.name, size), 1.2 * size,
               palette::kBackground.with_alpha(0.8));
    if (!entry.is_heading)
      sheet.fill(entry.x, y + 0.15 * size, 0.6 * size, 0.6 * size, entry.color);
    sheet.text(text, y, entry.name, size, entry.is_heading ? palette::kInk : palette::kFaintInk);
  }
}

// Scale bars for the clearance and the forces, beside the ring.
void Panel::write_scale_bars(Sheet sheet) const {
  const Area& area = sheet.area();
  const int size = std::min(film_->text_size, std::max(11, area.height / 20));
  const double pixels = film_->section_view->pixels(area);
  const DrawnContact& contact = *film_->section.contact;
  const bool below_caption =
      layout_.section.left == layout_.caption.left && layout_.section.top == layout_.caption.top;
  Corners corners(
      area, film_->section_view->reach(area), (below_caption ? 3.4 : 0.3) * size,
      film_->section.support.actuators ? -1.0 : (film_->contacts() > 1 ? 2.0 : 0.3) * size);
  const auto bar = [&](double length, const std::string& text, const Color& color) {
    const double wide = std::max(length, sheet.text_width(text, size)) + 1.2 * size;
    const Sheet::Point at = corners.next(wide, 1.9 * size);
    sheet.fill(at.x(), at.y(), wide, 1.7 * size, palette::kBackground.with_alpha(0.8));
    sheet.text(at.x() + 0.6 * size, at.y(), text, size, palette::kInk);
    sheet.fill(at.x() + 0.6 * size, at.y() + 1.2 * size, length, 3.0, color);
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
    force(film_->scales.force, "contact force", palette::kNormal);
  }
  if (film_->scales.control.high > 0.0)
    force(film_->scales.control, "control force", palette::kControl);
  if (film_->scales.current.high > 0.0) {
    bar(kCurrentShare * contact.rotor_radius * pixels,
        "coil current " + value_text(film_->scales.current.high, "A"), palette::kCurrent);
  }
  const std::string magnified = fmt::format("×{:.4g}", film_->section.magnification);
  const std::string in_full = "displacements " + magnified;
  // Beside the spring in the middle.
  const bool fits = sheet.text_width(in_full, size) < 0.4 * area.width;
  sheet.text_to(area.width - 0.6 * size, area.height - 1.5 * size, fits ? in_full : magnified, size,
                palette::kInk);
}

void Panel::draw_charts(const Sheet& picture, const Instant& instant,
                        const std::vector<Instant>& further) const {
  const auto draw = [&](std::size_t chart, const Color& alone, const auto& text_of) {
    std::vector<Chart::Reading> readings;
    for (std::size_t k = 0; k < film_->contacts(); ++k) {
      const Pose& pose = k == 0 ? instant.pose : further[k - 1].pose;
      readings.push_back({text_of(k, pose), curve_color(*film_, k, alone)});
    }
    if (chart == 1 && film_->contacts() == 1 && !film_->scales.impulses) {
      readings.push_back(
          {"friction " + value_text(instant.pose.friction_force, "N"), palette::kFriction});
    }
    Sheet sheet = picture.part(layout_.charts[chart]);
    charts_[chart].draw(sheet, instant.pose.t, readings);
  };
  draw(0, palette::kTrail, [](std::size_t, const Pose& pose) {
    return fmt::format("{:.1f} µm", std::abs(pose.gap) < 0.05e-6 ? 0.0 : 1e6 * pose.gap);
  });
  draw(1, palette::kNormal, [&](std::size_t k, const Pose& pose) {
    if (!film_->scales.impulses) return value_text(pose.normal_force, "N");
    double last = 0.0;
    for (const Strike& strike : run_->at_contact(k).strikes()) {
      if (strike.t <= pose.t) last = strike.impulse;
    }
    return fmt::format("{:.4f} N s", last);
  });
  if (charts_.size() > 2) {
    draw(2, palette::kControl,
         [](std::size_t, const Pose& pose) { return value_text(pose.control.norm(), "N"); });
  }
}

}  // namespace rotorub::renders
