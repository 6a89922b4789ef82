#include "renders/section_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "renders/palette.h"

namespace rotorub::renders {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMargin = 1.09;  // of the picture around what is drawn

}  // namespace

SectionView::SectionView(const Machine& machine, double motion, std::vector<Mesh>& meshes)
    : machine_(machine) {
  assert(machine.contact.has_value());
  const DrawnContact& contact = *machine.contact;
  half_size_ = kMargin * (contact.ring_outer + machine.displaced(motion));
  const double thin = 0.3 * depth(kBody);
  const auto add = [&meshes](const char* name, const RingShape& shape) {
    meshes.push_back(ring_mesh(name, shape));
    return static_cast<int>(meshes.size()) - 1;
  };
  ring_ = add("section_ring", {contact.ring_bore(), contact.ring_outer, thin});
  rotor_ = add("section_rotor", {0.0, contact.rotor_radius, thin});
  mark_ = add("section_mark",
              {0.55 * contact.rotor_radius, 0.93 * contact.rotor_radius, thin, 0.0, 0.5 * std::numbers::pi, 24});
  if (machine.ring_turns) {
    const double wide = contact.ring_outer - contact.ring_bore();
    ring_mark_ = add("section_ring_mark",
                     {contact.ring_bore() + 0.1 * wide, contact.ring_outer - 0.1 * wide, thin, 0.0,
                      0.12 * std::numbers::pi, 8});
  }
}

void SectionView::set_up(mjvScene& scene) const {
  View view;
  const double far = 60.0 * half_size_;  // nearly parallel rays
  view.position = {far, 0.0, 0.0};
  view.half_height = half_size_;
  view.depth = 2.0 * half_size_;
  set_view(scene, view);
  set_lights(scene, {-1.0, 0.35, -0.45}, 0.45F);
}

void SectionView::draw(const Stage& stage, mjvScene& scene, const Instant& instant,
                       const Pose* ghost, double force_length) const {
  Canvas canvas(scene);
  canvas.clear();
  const DrawnSection section = drawn_section(machine_, instant.pose);

  // A sheet behind everything: MuJoCo's sky lies beyond this view's depth.
  canvas.finish(kSheet);
  canvas.box(place_at(-0.1 * half_size_, {0.0, 0.0}),
             {0.01 * half_size_, 2.0 * half_size_, 2.0 * half_size_}, palette::kBackground);

  // The axes through the centre at rest.
  canvas.finish(kFlat);
  const double reach = half_size_;
  const double thin = 0.0025 * reach;
  canvas.box(place_at(-0.05 * reach, {0.0, 0.0}), {thin, reach, thin}, palette::kFaintInk);
  canvas.box(place_at(-0.05 * reach, {0.0, 0.0}), {thin, thin, reach}, palette::kFaintInk);

  draw_ring(stage, canvas, section, instant.pose.ring_angle);
  draw_rotor(stage, canvas, section, instant.pose.spin_angle);
  if (ghost != nullptr) draw_ghost(stage, canvas, drawn_section(machine_, *ghost));
  draw_path(canvas, instant, section);
  draw_forces(canvas, instant, section, force_length);
}

void SectionView::circle(Canvas& canvas, const Vector2d& centre, double radius, double x,
                         double pixels, const Color& color, bool dashed) const {
  const int pieces = dashed ? 72 : 96;
  for (int i = 0; i < pieces; i += dashed ? 2 : 1) {
    const double a = 2.0 * std::numbers::pi * i / pieces;
    const double b = 2.0 * std::numbers::pi * (i + 1) / pieces;
    canvas.line(place_at(x, centre + radius * Vector2d(std::cos(a), std::sin(a))),
                place_at(x, centre + radius * Vector2d(std::cos(b), std::sin(b))), pixels, color);
  }
}

void SectionView::draw_ring(const Stage& stage, Canvas& canvas, const DrawnSection& section,
                            double ring_angle) const {
  canvas.finish(kMatt);
  stage.draw_mesh(canvas, ring_, place_at(depth(kBack), section.ring), Matrix3d::Identity(),
                  palette::kRing);
  if (ring_mark_ >= 0) {
    const Matrix3d turn = Eigen::AngleAxisd(ring_angle, Vector3d::UnitX()).toRotationMatrix();
    stage.draw_mesh(canvas, ring_mark_, place_at(depth(kBody), section.ring), turn, palette::kMark);
  }
  canvas.finish(kFlat);
  const DrawnContact& contact = *machine_.contact;
  circle(canvas, section.ring, contact.ring_bore(), depth(kEdge), 2.0, palette::kRingEdge, false);
  circle(canvas, section.ring, contact.ring_outer, depth(kEdge), 1.5, palette::kRingEdge, false);
}

void SectionView::draw_rotor(const Stage& stage, Canvas& canvas, const DrawnSection& section,
                             double spin_angle) const {
  const double radius = machine_.contact->rotor_radius;
  canvas.finish(kMatt);
  const Matrix3d spin = Eigen::AngleAxisd(spin_angle, Vector3d::UnitX()).toRotationMatrix();
  stage.draw_mesh(canvas, rotor_, place_at(depth(kBody), section.rotor), spin, palette::kRotor);
  stage.draw_mesh(canvas, mark_, place_at(depth(kEdge), section.rotor), spin, palette::kMark);
  canvas.finish(kFlat);
  circle(canvas, section.rotor, radius, depth(kMark), 2.0, palette::kRotorEdge, false);
}

void SectionView::draw_path(Canvas& canvas, const Instant& instant,
                            const DrawnSection& section) const {
  canvas.finish(kFlat);
  // The rotor's centre is held within the clearance circle around the ring's centre.
  circle(canvas, section.ring, machine_.contact->clearance, depth(kMark), 1.5, palette::kInk, true);
  const double scale = machine_.displaced(1.0);
  for (std::size_t i = 0; i + 1 < instant.trail.size(); ++i) {
    const double age = 1.0 - static_cast<double>(i + 1) / static_cast<double>(instant.trail.size());
    canvas.line(place_at(depth(kPath), scale * instant.trail[i]),
                place_at(depth(kPath), scale * instant.trail[i + 1]), 2.5,
                palette::kTrail.with_alpha(1.0 - 0.9 * age));
  }
  canvas.sphere(place_at(depth(kPath), section.rotor), 0.018 * half_size_, palette::kTrail);
}

void SectionView::draw_forces(Canvas& canvas, const Instant& instant, const DrawnSection& section,
                              double force_length) const {
  canvas.finish(kFlat);
  const double bore = machine_.contact->ring_bore();
  for (const Spark& spark : instant.sparks) {
    const double size = (0.015 + 0.045 * spark.strength * spark.brightness) * half_size_;
    canvas.sphere(place_at(depth(kPath), section.ring + bore * spark.e_r), size,
                  palette::kStrike.with_alpha(spark.brightness));
  }
  if (!section.in_contact) return;
  const double width = 0.022 * half_size_;
  const auto force = [&](double newtons, const Vector2d& direction, const Color& color) {
    const Vector2d arrow = newtons * force_length * direction;
    if (arrow.norm() < 0.03 * half_size_) return;
    canvas.arrow(place_at(depth(kForce), section.touch), place_at(depth(kForce), section.touch + arrow), width,
                 color);
  };
  force(-instant.pose.normal_force, section.e_r, palette::kNormal);
  force(instant.pose.friction_force, section.e_t, palette::kFriction);
  canvas.sphere(place_at(depth(kForce), section.touch), 0.026 * half_size_, palette::kNormal);
}

void SectionView::draw_ghost(const Stage& stage, Canvas& canvas, const DrawnSection& ghost) const {
  const DrawnContact& contact = *machine_.contact;
  canvas.finish(kFlat);
  stage.draw_mesh(canvas, rotor_, place_at(depth(kMark), ghost.rotor), Matrix3d::Identity(),
                  palette::kGhost.with_alpha(0.15));
  circle(canvas, ghost.rotor, contact.rotor_radius, depth(kPath), 2.0, palette::kGhost, false);
  circle(canvas, ghost.ring, contact.ring_bore(), depth(kPath), 1.5, palette::kGhost, true);
  canvas.sphere(place_at(depth(kPath), ghost.rotor), 0.018 * half_size_, palette::kGhost);
}

}  // namespace rotorub::renders
