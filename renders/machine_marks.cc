// The ring and its support, forces and shadows in the view of the machine.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "renders/machine_view.h"
#include "renders/palette.h"

namespace rotorub::renders {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFoot[] = {225.0 * std::numbers::pi / 180.0, 315.0 * std::numbers::pi / 180.0};

}  // namespace

// Shadows straight down on the plate, as under a wide lamp. They consist of two layers, the outer
// one fainter. Flat boxes are cheap in software rendering.
void MachineView::draw_shadows(Canvas& canvas, const Pose& pose,
                               const Eigen::Matrix2Xd& line) const {
  canvas.finish(kMatt);
  constexpr int kEvery = 2;  // only every second station
  for (const auto& [layer, spread, color] :
       {std::tuple{1.0, 1.7, palette::kPenumbra}, {2.0, 1.0, palette::kUmbra}}) {
    const double height = 2e-4 * layer;
    const auto cast = [&](double x, double y, double half_length, double half_width) {
      canvas.box({x, y, machine_.floor + height}, {half_length, half_width, height}, color);
    };
    const double wider = 0.012 * (spread - 1.0);
    for (Eigen::Index i = 0; i + 1 < machine_.z.size(); i += kEvery) {
      const Eigen::Index next = std::min<Eigen::Index>(i + kEvery, machine_.z.size() - 1);
      cast(0.5 * (machine_.z[i] + machine_.z[next]), 0.5 * (line(0, i) + line(0, next)),
           0.5 * (machine_.z[next] - machine_.z[i]),
           machine_.span_radius[static_cast<std::size_t>(i)] + wider);
    }
    for (const DrawnDisc& disc : machine_.discs) {
      cast(disc.z, machine_.centre(line, disc.z)[1], disc.half_width + wider, disc.radius + wider);
    }
    if (!machine_.contact) continue;
    const DrawnContact& contact = *machine_.contact;
    cast(contact.z, drawn_section(machine_, pose).ring[0], contact.half_width + wider,
         contact.ring_outer + wider);
  }
}

void MachineView::draw_ring(Canvas& canvas, const DrawnSection& section, const Color& color) const {
  canvas.mesh(ring_, place_at(machine_.contact->z, section.ring), Eigen::Matrix3d::Identity(),
              color);
}

// The support of the ring: a housing on a pedestal, or springs or actuators at 45 degrees.
void MachineView::draw_support(Canvas& canvas, const DrawnSection& section) const {
  const DrawnContact& contact = *machine_.contact;
  const DrawnSupport& support = machine_.support;
  canvas.finish(kMetal);
  if (support.fixed) {
    canvas.mesh(housing_, place_at(contact.z, section.ring), Eigen::Matrix3d::Identity(),
                palette::kHousing);
    draw_pedestal(canvas, contact.z, -1.08 * contact.ring_outer, 0.6 * contact.half_width,
                  0.5 * contact.ring_outer);
    return;
  }
  for (const double angle : kFoot) {
    const Vector2d direction(std::cos(angle), std::sin(angle));
    const Vector2d from = section.ring + 0.97 * contact.ring_outer * direction;
    const Vector2d to = direction * (machine_.floor / direction[1]);
    if (support.actuators) {
      draw_strut(canvas, from, to);
    } else if (support.spring_x || support.spring_y) {
      canvas.cylinder(place_at(contact.z, from), place_at(contact.z, to), 0.004, palette::kShaft);
      for (int turn = 0; turn < 9; ++turn) {
        const Vector2d at = from + (turn + 0.8) / 9.6 * (to - from);
        const Vector2d thick = 0.003 * direction;
        canvas.cylinder(place_at(contact.z, at - thick), place_at(contact.z, at + thick), 0.014,
                        palette::kHousing);
      }
    }
  }
}

// An actuator with its cylinder on the base and its rod on the ring; an electromagnet has a coil.
void MachineView::draw_strut(Canvas& canvas, const Vector2d& from, const Vector2d& to) const {
  const double z = machine_.contact->z;
  const Vector2d joint = 0.5 * (from + to);
  canvas.cylinder(place_at(z, joint), place_at(z, to), 0.016, palette::kHousing);
  canvas.cylinder(place_at(z, from), place_at(z, joint), 0.008, palette::kShaft);
  if (!machine_.support.magnets) return;
  const Vector2d coil = joint + 0.15 * (to - joint);
  const Vector2d end = joint + 0.6 * (to - joint);
  canvas.cylinder(place_at(z, coil), place_at(z, end), 0.024, palette::kCopper);
}

void MachineView::draw_contact(Canvas& canvas, const Instant& instant,
                               const DrawnSection& section) const {
  const DrawnContact& contact = *machine_.contact;
  canvas.finish(kFlat);
  // In front of the ring's near face, so that the arrows are not hidden.
  const double station = contact.z + 1.6 * side_ * contact.half_width;
  const double longest = kArrowShare * contact.rotor_radius;
  const auto arrow = [&](const Vector2d& foot, const Vector2d& tip, const Color& color) {
    if (tip.norm() < 0.02 * contact.rotor_radius) return;
    canvas.arrow(place_at(station, foot), place_at(station, foot + tip), 0.2 * contact.half_width,
                 color);
  };
  for (const Spark& spark : instant.sparks) {
    canvas.sphere(place_at(station, section.ring + contact.ring_bore() * spark.e_r),
                  (0.3 + 0.4 * spark.strength) * contact.half_width,
                  palette::kStrike.with_alpha(spark.brightness));
  }
  if (instant.control.share > 0.0) {
    const Vector2d along = instant.pose.control.normalized();
    arrow(section.ring + contact.ring_outer * along, instant.control.share * longest * along,
          palette::kControl);
  }
  if (!section.in_contact) return;
  canvas.sphere(place_at(station, section.touch), 0.3 * contact.half_width, palette::kNormal);
  arrow(section.touch, -instant.normal.share * longest * section.e_r, palette::kNormal);
}

// External forces at their stations, relative to the largest one.
void MachineView::draw_loads(Canvas& canvas, const Pose& pose, const Eigen::Matrix2Xd& line) const {
  constexpr double kLongest = 0.13;
  if (!(machine_.largest_load > 0.0)) return;
  canvas.finish(kFlat);
  for (const DrawnLoad& load : machine_.loads) {
    const Vector2d force =
        kLongest / machine_.largest_load * load.force.at(pose.t, pose.spin_angle);
    if (force.norm() < 0.02 * kLongest) continue;
    const Vector3d foot = machine_.centre(line, load.z);
    canvas.arrow(foot, foot + Vector3d(0.0, force[0], force[1]), 0.008, palette::kLoad);
  }
}

}  // namespace rotorub::renders
