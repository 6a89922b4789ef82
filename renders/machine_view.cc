#include "renders/machine_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "renders/palette.h"

namespace rotorub::renders {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180.0;
const Matrix3d kUpright = Matrix3d::Identity();

// The visible part of a cut ring. The cut faces the camera.
constexpr double kKeptFrom = 212.0 * kDegree;
constexpr double kKeptTo = 452.0 * kDegree;

constexpr double kPlateHalfDepth = 0.13;

// Width of the rotor's body at the contact, relative to the ring.
constexpr double kRotorWidth = 1.25;

// Thickness of a ghost's shaft relative to the shaft. It is hidden inside where the two coincide.
constexpr double kWithin = 0.96;

// A mark protrudes from its body, so that it is visible.
constexpr double kProud = 1.02;

int add_mesh(std::vector<Mesh>& meshes, const RingShape& shape) {
  const int id = static_cast<int>(meshes.size());
  meshes.push_back(ring_mesh("machine_" + std::to_string(id), shape));
  return id;
}

// A quarter of the disc.
RingShape mark_shape(double radius, double half_width) {
  return {0.3 * radius, kProud * radius, half_width + 0.02 * radius, 0.0, 90.0 * kDegree, 24};
}

}  // namespace

MachineView::MachineView(const Machine& machine, std::vector<Mesh>& meshes) : machine_(machine) {
  if (machine.contact) {
    const DrawnContact& contact = *machine.contact;
    ring_ = add_mesh(meshes, {contact.ring_bore(), contact.ring_outer, contact.half_width,
                              kKeptFrom, kKeptTo, 72});
    if (machine.support.fixed) {
      housing_ = add_mesh(meshes, {contact.ring_outer, 1.12 * contact.ring_outer,
                                   contact.half_width, kKeptFrom, kKeptTo, 72});
    }
    rotor_ = {add_mesh(meshes, {0.0, contact.rotor_radius, kRotorWidth * contact.half_width}),
              add_mesh(meshes, mark_shape(contact.rotor_radius, kRotorWidth * contact.half_width))};
  }
  for (const DrawnDisc& disc : machine.discs) {
    discs_.push_back({add_mesh(meshes, {0.0, disc.radius, disc.half_width}),
                      add_mesh(meshes, mark_shape(disc.radius, disc.half_width))});
  }
  if (!machine.bearings.empty()) {
    bearing_ = add_mesh(meshes, {machine.bearing_bore, 2.2 * machine.bearing_bore, 0.018});
  }
  for (const DrawnMagneticBearing& magnet : machine.magnetic_bearings) {
    magnets_.push_back(add_mesh(
        meshes, {magnet.bore + 0.012, magnet.outer, magnet.half_width, kKeptFrom, kKeptTo, 72}));
  }
  // The camera is on the side of the ring with no disc in front of it.
  double nearest = 2.0;
  for (const DrawnDisc& disc : machine.discs) {
    if (!machine.contact) break;
    const double away = disc.z - machine.contact->z;
    if (std::abs(away) < nearest) side_ = away > 0.0 ? -1.0 : 1.0;
    nearest = std::min(nearest, std::abs(away));
  }
}

void MachineView::set_up(mjvScene& scene, double aspect, bool close) const {
  View view;
  std::vector<Vector3d> corners;
  if (close && machine_.contact) {
    const DrawnContact& contact = *machine_.contact;
    const double reach = 1.25 * contact.ring_outer;
    for (const double y : {-reach, reach}) {
      for (const double z : {-reach, reach}) corners.push_back({contact.z, y, z});
    }
    view.target = {contact.z, 0.0, 0.0};
    view.position = view.target + 3.0 * Vector3d(0.9 * side_, -1.0, 0.45).normalized();
  } else {
    for (const double x : {plate_left(), plate_right()}) {
      for (const double y : {-kPlateHalfDepth, kPlateHalfDepth}) {
        corners.push_back({x, y, machine_.floor});
      }
      corners.push_back({x, 0.0, 0.08});
    }
    if (machine_.contact)
      corners.push_back({machine_.contact->z, 0.0, machine_.contact->ring_outer});
    view.target = {0.5, 0.0, 0.0};
    view.position = view.target + 3.0 * Vector3d(0.62 * side_, -1.0, 0.5).normalized();
  }
  view.depth = 2.0;
  set_view(scene, fitted(view, corners, aspect, 0.03));
  set_lights(scene, {0.35, 0.8, -1.0}, 0.42F);
}

double MachineView::plate_left() const {
  return machine_.motor && *machine_.motor < 0.5 ? -0.15 : -0.04;
}

double MachineView::plate_right() const {
  return machine_.motor && *machine_.motor >= 0.5 ? 1.15 : 1.04;
}

void MachineView::draw(Canvas canvas, const Instant& instant, const Pose* ghost) const {
  draw_base(canvas);
  const Eigen::Matrix2Xd line = machine_.centre_line(instant.pose);
  draw_shadows(canvas, instant.pose, line);
  canvas.finish(kMetal);
  draw_shaft(canvas, line, palette::kShaft, 1.0);
  draw_bodies(canvas, instant.pose, line);
  if (machine_.contact) draw_ring_and_forces(canvas, instant);
  draw_loads(canvas, instant.pose, line);
  if (ghost != nullptr) {
    canvas.finish(kMatt);
    const Color color = palette::kGhost.with_alpha(0.45);
    draw_shaft(canvas, machine_.centre_line(*ghost), color, kWithin);
    if (machine_.contact) draw_ring(canvas, drawn_section(machine_, *ghost), color);
  }
}

void MachineView::draw_ring_and_forces(Canvas& canvas, const Instant& instant) const {
  const DrawnSection section = drawn_section(machine_, instant.pose);
  draw_ring(canvas, section, palette::kRing);
  draw_support(canvas, section);
  draw_contact(canvas, instant, section);
}

void MachineView::draw_bearing(Canvas canvas, const Instant& instant,
                               const Eigen::Matrix2Xd& line) const {
  canvas.finish(kMetal);
  draw_body(canvas, machine_.contact->z, rotor_, palette::kRotor, instant.pose, line);
  draw_ring_and_forces(canvas, instant);
}

void MachineView::draw_pedestal(Canvas& canvas, double z, double top, double half_width,
                                double half_depth) const {
  const double half_height = 0.5 * (top - machine_.floor);
  canvas.box({z, 0.0, machine_.floor + half_height}, {half_width, half_depth, half_height},
             palette::kHousing);
}

void MachineView::draw_base(Canvas& canvas) const {
  canvas.finish(kMatt);
  constexpr double kPlateThickness = 0.012;
  const double left = plate_left();
  const double right = plate_right();
  canvas.box({0.5 * (left + right), 0.0, machine_.floor - kPlateThickness},
             {0.5 * (right - left), kPlateHalfDepth, kPlateThickness}, palette::kPlate);

  for (const double z : machine_.bearings) {
    draw_pedestal(canvas, z, -1.6 * machine_.bearing_bore, 0.014, 1.6 * machine_.bearing_bore);
    canvas.mesh(bearing_, {z, 0.0, 0.0}, kUpright, palette::kHousing);
  }
  if (machine_.motor) {
    // Beyond the shaft's end, or around the shaft.
    const double z = *machine_.motor;
    const double middle = z < 0.1 ? z - 0.075 : (z > 0.9 ? z + 0.075 : z);
    draw_pedestal(canvas, middle, -0.03, 0.04, 0.04);
    canvas.cylinder({middle - 0.06, 0.0, 0.0}, {middle + 0.06, 0.0, 0.0}, 0.06, palette::kMotor);
  }
  for (std::size_t i = 0; i < magnets_.size(); ++i) {
    const DrawnMagneticBearing& magnet = machine_.magnetic_bearings[i];
    draw_pedestal(canvas, magnet.z, -0.9 * magnet.outer, 0.6 * magnet.half_width, 0.03);
    canvas.mesh(magnets_[i], {magnet.z, 0.0, 0.0}, kUpright, palette::kHousing);
    for (int pole = 0; pole < 8; ++pole) {
      const double angle = (22.5 + 45.0 * pole) * kDegree;
      if (angle > kKeptTo - 2.0 * std::numbers::pi && angle < kKeptFrom) continue;
      const Matrix3d turn = Eigen::AngleAxisd(angle, Vector3d::UnitX()).toRotationMatrix();
      const double radius = magnet.bore + 0.01;
      canvas.box(turn * Vector3d(0.0, radius, 0.0) + Vector3d(magnet.z, 0.0, 0.0),
                 {0.8 * magnet.half_width, 0.01, 0.2 * radius}, palette::kCopper, turn);
    }
  }
}

void MachineView::draw_shaft(Canvas& canvas, const Eigen::Matrix2Xd& line, const Color& color,
                             double thickness) const {
  for (Eigen::Index i = 0; i + 1 < machine_.z.size(); ++i) {
    const Vector3d from = place_at(machine_.z[i], line.col(i));
    const Vector3d to = place_at(machine_.z[i + 1], line.col(i + 1));
    // Closes the wedge on the outside of a bend. On a translucent shaft it would be visible.
    const Vector3d overlap = (color.alpha < 1.0F ? 0.0 : 0.06) * (to - from);
    canvas.cylinder(from - overlap, to + overlap,
                    thickness * machine_.span_radius[static_cast<std::size_t>(i)], color);
  }
}

// A body is perpendicular to the bent shaft and turns about it. Its mark shows the rotation.
void MachineView::draw_body(Canvas& canvas, double z, const Body& body, const Color& color,
                            const Pose& pose, const Eigen::Matrix2Xd& line) const {
  const Vector3d centre = machine_.centre(line, z);
  const Matrix3d axes =
      (Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitX(), machine_.tangent(line, z)) *
       Eigen::AngleAxisd(pose.spin_angle, Vector3d::UnitX()))
          .toRotationMatrix();
  canvas.mesh(body.solid, centre, axes, color);
  canvas.mesh(body.mark, centre, axes, palette::kMark);
}

void MachineView::draw_bodies(Canvas& canvas, const Pose& pose,
                              const Eigen::Matrix2Xd& line) const {
  for (std::size_t i = 0; i < discs_.size(); ++i) {
    draw_body(canvas, machine_.discs[i].z, discs_[i], palette::kDisc, pose, line);
  }
  if (machine_.contact) draw_body(canvas, machine_.contact->z, rotor_, palette::kRotor, pose, line);
}

}  // namespace rotorub::renders
