#include "renders/section_view.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include "renders/palette.h"

namespace rotorub::renders {

namespace {

using Eigen::Vector2d;

constexpr double kMargin = 1.06;        // of the picture around the drawing
constexpr double kSupportReach = 0.5;   // from ring to wall, relative to the rotor's radius
constexpr double kHousingWidth = 0.14;  // around a fixed ring, relative to the rotor's radius
constexpr double kPi = std::numbers::pi;

Vector2d direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

// One picture on a sheet, in drawing units.
struct Drawing {
  Sheet& sheet;
  const Machine& machine;
  const DrawnContact& contact;
  const Instant& instant;
  const DrawnSection section;
  const Vector2d middle;  // of the sheet, pixels
  const double pixels;    // pixels per drawing unit
  const double half_size, wall_radius;

  Sheet::Point at(const Vector2d& yz) const {
    return {middle[0] + pixels * yz[0], middle[1] - pixels * yz[1]};
  }

  // Axes through the centre at rest.
  void draw_axes() const {
    sheet.fill(0.0, std::floor(middle[1]), sheet.area().width, 1.0, palette::kGrid);
    sheet.fill(std::floor(middle[0]), 0.0, 1.0, sheet.area().height, palette::kGrid);
  }

  void draw_spring(const Vector2d& from, const Vector2d& to) const {
    constexpr int kTurns = 5;
    const Vector2d along = to - from;
    const Vector2d across =
        0.08 * contact.rotor_radius * Vector2d(-along[1], along[0]).normalized();
    std::vector<Sheet::Point> points = {at(from)};
    for (int k = 0; k < 2 * kTurns; ++k) {
      const double s = (k + 1.0) / (2.0 * kTurns + 1.0);
      points.push_back(at(from + s * along + (k % 2 == 0 ? 1.0 : -1.0) * across));
    }
    points.push_back(at(to));
    sheet.polyline(points, std::max(1.2, 0.03 * contact.rotor_radius * pixels), palette::kHousing);
  }

  void draw_support() const {
    const DrawnSupport& support = machine.support;
    const double unit = contact.rotor_radius;
    if (support.fixed) {
      sheet.ring(at(section.ring), contact.ring_outer * pixels,
                 (contact.ring_outer + kHousingWidth * unit) * pixels, palette::kHousing);
      return;
    }
    const auto held = [&](double angle, const auto& draw) {
      const Vector2d e = direction(angle);
      const Vector2d wall = wall_radius * e;
      const Vector2d across(-e[1], e[0]);
      sheet.bar(at(wall - 0.22 * unit * across), at(wall + 0.22 * unit * across),
                0.06 * unit * pixels, palette::kHousing);
      draw(Vector2d(section.ring + contact.ring_outer * e), wall, e);
    };
    const auto spring = [&](const Vector2d& from, const Vector2d& to, const Vector2d&) {
      draw_spring(from, to);
    };
    if (support.spring_x)
      for (const double angle : {0.0, kPi}) held(angle, spring);
    if (support.spring_y)
      for (const double angle : {0.5 * kPi, 1.5 * kPi}) held(angle, spring);
    if (!support.actuators) return;
    for (const double angle : {0.25 * kPi, 0.75 * kPi, 1.25 * kPi, 1.75 * kPi}) {
      if (support.magnets) {
        // A fixed core with its coil, at an air gap from the ring.
        held(angle, [&](const Vector2d&, const Vector2d& wall, const Vector2d& e) {
          const Vector2d pole = wall - 0.38 * unit * e;
          sheet.bar(at(wall), at(pole), 0.2 * unit * pixels, palette::kHousing);
          const Vector2d coil = wall - 0.12 * unit * e;
          sheet.bar(at(coil), at(coil - 0.1 * unit * e), 0.34 * unit * pixels, palette::kCopper);
        });
      } else if (angle > kPi) {
        // A cylinder on the wall with its rod on the ring.
        held(angle, [&](const Vector2d& ring, const Vector2d& wall, const Vector2d& e) {
          sheet.bar(at(ring), at(wall), 0.07 * unit * pixels, palette::kShaft);
          sheet.bar(at(wall), at(Vector2d(wall - 0.24 * unit * e)), 0.17 * unit * pixels,
                    palette::kHousing);
        });
      }
    }
  }

  void draw_ring(double angle) const {
    const Sheet::Point center = at(section.ring);
    const double bore = contact.ring_bore() * pixels, outer = contact.ring_outer * pixels;
    sheet.disc(center, bore, palette::kPaper);
    sheet.ring(center, bore, outer, palette::kRing);
    if (machine.ring_turns) {
      const double wide = outer - bore;
      sheet.sector(center, bore + 0.1 * wide, outer - 0.1 * wide, angle, 0.12 * kPi,
                   palette::kMark);
    }
    sheet.ring(center, bore, bore + 1.5, palette::kRingEdge);
    sheet.ring(center, outer - 1.5, outer, palette::kRingEdge);
  }

  void draw_rotor(double angle) const {
    const double radius = contact.rotor_radius * pixels;
    const Sheet::Point center = at(section.rotor);
    sheet.disc(center, radius, palette::kRotor);
    sheet.sector(center, 0.55 * radius, 0.93 * radius, angle, 0.5 * kPi, palette::kMark);
    sheet.ring(center, radius - 1.5, radius, palette::kRotorEdge);
  }

  void draw_ghost(const DrawnSection& ghost) const {
    const double radius = contact.rotor_radius * pixels;
    sheet.disc(at(ghost.rotor), radius, palette::kGhost.with_alpha(0.15));
    sheet.ring(at(ghost.rotor), radius - 2.0, radius, palette::kGhost);
    sheet.dashed_circle(at(ghost.ring), contact.ring_bore() * pixels, 1.5, palette::kGhost);
    sheet.disc(at(ghost.rotor), 0.018 * half_size * pixels, palette::kGhost);
  }

  void draw_path() const {
    // Contact keeps the rotor's centre within the clearance circle around the ring's centre.
    sheet.dashed_circle(at(section.ring), contact.clearance * pixels, 1.5, palette::kInk);
    const double scale = machine.displaced(1.0);
    std::vector<Sheet::Point> points;
    for (const Vector2d& point : instant.trail) points.push_back(at(scale * point));
    sheet.trail(points, 2.2, palette::kTrail);
    sheet.disc(at(section.rotor), 0.018 * half_size * pixels, palette::kTrail);
  }

  // A bar beside the magnet of each axis that the current strengthens, from the wall inwards. The
  // pale bar shows the largest current.
  void draw_currents() const {
    if (!machine.support.magnets || instant.current.isZero()) return;
    const double unit = contact.rotor_radius;
    for (int k = 0; k < 2; ++k) {
      const double share = instant.current[k];
      const Vector2d e = (share < 0.0 ? -1.0 : 1.0) * direction((0.25 + 0.5 * k) * kPi);
      const Vector2d foot = wall_radius * e + 0.3 * unit * Vector2d(e[1], -e[0]);
      const auto bar = [&](double length, const Color& color) {
        sheet.bar(at(foot), at(Vector2d(foot - length * kCurrentShare * unit * e)),
                  0.09 * unit * pixels, color);
      };
      bar(1.0, palette::kGrid);
      bar(std::abs(share), palette::kCurrent);
    }
  }

  void draw_forces() const {
    const double bore = contact.ring_bore();
    for (const Spark& spark : instant.sparks) {
      const double size = (0.015 + 0.045 * spark.strength * spark.brightness) * half_size;
      sheet.disc(at(section.ring + bore * spark.e_r), size * pixels,
                 palette::kStrike.with_alpha(spark.brightness));
    }
    const double width = std::max(2.5, 0.022 * half_size * pixels);
    const double longest = kArrowShare * contact.rotor_radius;
    const auto force = [&](const Vector2d& foot, const ArrowShare& arrow, const Vector2d& along,
                           const Color& color) {
      const Vector2d tip = arrow.share * longest * along;
      if (tip.norm() < 0.02 * half_size) return;
      sheet.arrow(at(foot), at(foot + tip), width, color);
      if (!arrow.clipped) return;
      // A gap across the shaft marks a clipped arrow.
      const Vector2d across(-along[1], along[0]);
      const Vector2d cut = foot + 0.45 * tip;
      const double half = 1.2 * width / pixels;
      sheet.polyline(std::array{at(cut - half * across), at(cut + half * across)}, 0.6 * width,
                     palette::kPaper);
    };
    if (instant.control.share > 0.0) {
      const Vector2d along = instant.pose.control.normalized();
      force(section.ring + contact.ring_outer * along, instant.control, along, palette::kControl);
    }
    if (!section.in_contact) return;
    force(section.touch, instant.normal, -section.e_r, palette::kNormal);
    force(section.touch, instant.friction,
          instant.pose.friction_force < 0.0 ? Vector2d(-section.e_t) : section.e_t,
          palette::kFriction);
    sheet.disc(at(section.touch), std::max(3.0, 0.02 * half_size * pixels), palette::kNormal);
  }
};

}  // namespace

SectionView::SectionView(const Machine& machine, double motion) : machine_(machine) {
  assert(machine.contact.has_value());
  const DrawnContact& contact = *machine.contact;
  const double moved = contact.ring_outer + machine.displaced(motion);
  reach_ = moved + (machine.support.fixed ? kHousingWidth * contact.rotor_radius : 0.0);
  wall_ = moved + kSupportReach * contact.rotor_radius;
  const bool held =
      machine.support.spring_x || machine.support.spring_y || machine.support.actuators;
  half_size_ = kMargin * (held ? wall_ : moved + 0.2 * contact.rotor_radius);
}

double SectionView::pixels(const Area& area) const {
  return 0.5 * std::min(area.width, area.height) / half_size_;
}

void SectionView::draw(Sheet& sheet, const Instant& instant, const Pose* ghost) const {
  const Area& area = sheet.area();
  const Drawing drawing{sheet,
                        machine_,
                        *machine_.contact,
                        instant,
                        drawn_section(machine_, instant.pose),
                        {0.5 * area.width, 0.5 * area.height},
                        pixels(area),
                        half_size_,
                        wall_};
  drawing.draw_axes();
  drawing.draw_support();
  drawing.draw_ring(instant.pose.ring_angle);
  drawing.draw_rotor(instant.pose.spin_angle);
  if (ghost != nullptr) drawing.draw_ghost(drawn_section(machine_, *ghost));
  drawing.draw_currents();
  drawing.draw_path();
  drawing.draw_forces();
}

}  // namespace rotorub::renders
