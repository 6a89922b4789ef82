#include "renders/unrolled_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "renders/instant.h"
#include "renders/palette.h"

namespace rotorub::renders {

namespace {

constexpr int kPathPoints = 720;
constexpr double kHalfTurn = std::numbers::pi;

double decades(double length) { return std::max(0.0, std::log10(length / UnrolledView::kLeast)); }

}  // namespace

UnrolledView::UnrolledView(double clearance, double penetration)
    : decades_up_(std::ceil(decades(clearance) - 1e-9)),
      decades_down_(std::ceil(decades(penetration) - 1e-9)),
      clearance_(clearance) {}

double UnrolledView::height_of(double gap) const {
  const double up = gap > 0.0 ? decades(gap) : -decades(-gap);
  return (decades_up_ - std::clamp(up, -decades_down_, decades_up_)) /
         (decades_up_ + decades_down_);
}

Sheet::Point UnrolledView::place(const Area& plot, const Pose& pose) const {
  const Eigen::Vector2d d = pose.rotor - pose.stator;
  const double angle = std::atan2(d[1], d[0]);
  return {plot.left + (angle + kHalfTurn) / (2.0 * kHalfTurn) * plot.width,
          plot.top + height_of(clearance_ - d.norm()) * plot.height};
}

void UnrolledView::draw_grid(Sheet& sheet, int text_size, const Area& plot) const {
  sheet.fill(plot.left, plot.top, plot.width, plot.height, palette::kPaper);
  const auto level = [&](double gap, const std::string& text) {
    const double y = std::floor(plot.top + height_of(gap) * plot.height);
    sheet.fill(plot.left, y, plot.width, 1.0, palette::kGrid);
    sheet.text_to(plot.left - 0.5 * text_size, y - 0.45 * text_size, text, text_size,
                  palette::kInk);
  };
  for (int k = 1; k <= static_cast<int>(decades_up_); ++k) {
    const double gap = kLeast * std::pow(10.0, k);
    level(gap, length_text(gap));
  }
  for (int k = 1; k <= static_cast<int>(decades_down_); ++k) {
    const double gap = kLeast * std::pow(10.0, k);
    level(-gap, "-" + length_text(gap));
  }
  // The ring's line contains all gaps below kLeast.
  const double ring = plot.top + height_of(0.0) * plot.height;
  sheet.fill(plot.left, ring - 2.0, plot.width, 4.0, palette::kRing);
  sheet.text_to(plot.left - 0.5 * text_size, ring - 0.45 * text_size, "contact", text_size,
                palette::kRingEdge);
  if (decades_down_ > 0.0) {
    sheet.text(plot.left + 0.5 * text_size, ring + 0.5 * text_size, "penetration", text_size,
               palette::kFaintInk);
  }
  for (int degrees = -180; degrees <= 180; degrees += 90) {
    const double x = plot.left + (degrees + 180) / 360.0 * plot.width;
    sheet.fill(std::floor(x), plot.top, 1.0, plot.height, palette::kGrid);
    const std::string text = std::to_string(degrees) + "°";
    sheet.text(x - 0.5 * sheet.text_width(text, text_size), plot.bottom() + 0.7 * text_size, text,
               text_size, palette::kInk);
  }
}

void UnrolledView::draw_path(Sheet& sheet, const Area& plot, const Playback& playback, double t,
                             double trail_time, const Color& color) const {
  const double oldest = std::max(playback.start(), t - trail_time);
  std::vector<Sheet::Point> points;
  for (int k = 0; k <= kPathPoints; ++k) {
    points.push_back(place(plot, playback.at(oldest + (t - oldest) * k / kPathPoints)));
  }
  // No line is drawn where the angle wraps around.
  sheet.trail(points, 2.0, color, 0.5 * plot.width);
}

void UnrolledView::draw(Sheet& sheet, int text_size, const Playback& playback,
                        const Instant& instant, double trail_time, const Playback* ghost) const {
  const Area& area = sheet.area();
  const int left = static_cast<int>(sheet.text_width("-100 µm", text_size)) + text_size;
  const Area plot{left, 3 * text_size, area.width - left - 2 * text_size,
                  area.height - 7 * text_size};
  draw_grid(sheet, text_size, plot);
  if (ghost != nullptr) {
    draw_path(sheet, plot, *ghost, instant.pose.t, trail_time, palette::kGhost);
  }
  if (!instant.trail.empty()) {
    draw_path(sheet, plot, playback, instant.pose.t, trail_time, palette::kTrail);
  }
  const double ring = plot.top + height_of(0.0) * plot.height;
  for (const Spark& spark : instant.sparks) {
    const double x = plot.left + (std::atan2(spark.e_r[1], spark.e_r[0]) + kHalfTurn) /
                                     (2.0 * kHalfTurn) * plot.width;
    sheet.disc({x, ring}, (0.3 + 0.5 * spark.strength) * text_size,
               palette::kStrike.with_alpha(spark.brightness));
  }
  const Sheet::Point now = place(plot, instant.pose);
  const bool touching = instant.pose.normal_force > 0.0;
  // The normal force is an arrow that rises from the contact, in the film's scale.
  if (touching) {
    const double length = instant.normal.share * 0.25 * plot.height;
    sheet.arrow(now, {now[0], now[1] - length}, 0.35 * text_size, palette::kNormal);
  }
  sheet.disc(now, 0.35 * text_size, touching ? palette::kNormal : palette::kTrail);
}

}  // namespace rotorub::renders
