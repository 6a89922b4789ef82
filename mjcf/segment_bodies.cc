#include "mjcf/segment_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "mjcf/bodies.h"
#include "mjcf/names.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/record.h"

namespace rotorub {
namespace {

namespace names = mjcf_names;

// The least mass and inertia of a body, with a margin above MuJoCo's limit.
constexpr double kLeast = 1e-14;
constexpr const char* kDrawn = R"(mass="0" contype="0" conaffinity="0" group="1")";

std::string inertial(double x, double y, double z, double mass, double Jt, double Jp,
                     const char* more = "") {
  return fmt::format(R"(<inertial pos="{} {} {}" mass="{}" diaginertia="{} {} {}"{}/>)", x, y, z,
                     std::max(mass, kLeast), std::max(Jt, kLeast), std::max(Jt, kLeast),
                     std::max(Jp, kLeast), more);
}

// Recent versions of MuJoCo move a centre of mass that is less than 1e-6 m off the frame to its
// origin, unless the axes of the two differ. A quarter turn about z makes them differ without
// effect on a disc with Jt, Jt, Jp.
const char* kept_apart(double eccentricity) {
  return eccentricity > 0.0 && eccentricity < 2e-6 ? R"( quat="1 0 0 1")" : "";
}

// MuJoCo accepts only inertias that a rigid body can have.
void refuse_impossible_discs(const scene::Scene& scene) {
  const std::vector<scene::Disc>& discs = scene.rotor.geometry->discs;
  for (std::size_t i = 0; i < discs.size(); ++i) {
    if (discs[i].Jp <= 2.0 * discs[i].Jt) continue;
    throw scene::SceneError(scene::placed(
        scene, {{"", 0, fmt::format("rotor.disc[{}].Jp", i),
                 fmt::format("the segment rotor consists of rigid bodies, whose Jp is at most 2 Jt "
                             "= {}; lower it, or set mujoco.rotor = \"modal\"",
                             2.0 * discs[i].Jt)}}));
  }
}

double drawn_shaft_radius(const scene::RotorGeometry& geometry, const Segment& s) {
  for (const scene::ShaftSection& section : geometry.sections) {
    if (s.centre <= section.to) return 0.5 * section.outer_at(s.centre);
  }
  const scene::ShaftSection& last = geometry.sections.back();
  return 0.5 * last.outer_at(last.to);
}

}  // namespace

SegmentRotor::SegmentRotor(const scene::Scene& scene, const Model& model)
    : scene_(scene),
      model_(model),
      chain_(segment_chain(scene)),
      matrices_(segment_matrices(scene, chain_, model.layout.modes, model.layout.torsion)) {
  refuse_impossible_discs(scene);
}

void SegmentRotor::write_bodies(XmlWriter& xml) const {
  for (std::size_t k = 0; k < chain_.segments.size(); ++k) write_carrier(xml, k);
  for (std::size_t k = 0; k < chain_.segments.size(); ++k) xml.close("body");
}

// Opens the carrier; the next carrier is its child.
void SegmentRotor::write_carrier(XmlWriter& xml, std::size_t k) const {
  // The contact plane is z = 0. The first segment turns about its node, others about their joints.
  const auto origin = [&](std::size_t i) {
    return i == 0 ? chain_.segments[0].node : chain_.joint[i - 1];
  };
  const double contact = scene_.has_contact() ? scene_.first().contact->station : 0.0;
  xml.open(fmt::format(R"(<body name="{}" pos="0 0 {}">)", names::segment(k),
                       origin(k) - (k == 0 ? contact : origin(k - 1))));
  xml.line(inertial(0.0, 0.0, 0.0, 0.0, 0.0, 0.0));
  std::string stiffness;
  if (k == 0) {
    xml.line(fmt::format(R"(<joint name="{}" type="slide" axis="1 0 0"/>)", names::kEndX));
    xml.line(fmt::format(R"(<joint name="{}" type="slide" axis="0 1 0"/>)", names::kEndY));
  } else {
    stiffness = fmt::format(R"( stiffness="{}")", chain_.bending_stiffness[k - 1]);
  }
  // The angles are slopes du/dz: about +y for x, about -x for y.
  xml.line(fmt::format(R"(<joint name="{}" type="hinge" axis="0 1 0"{}/>)", names::tilt('x', k),
                       stiffness));
  xml.line(fmt::format(R"(<joint name="{}" type="hinge" axis="-1 0 0"{}/>)", names::tilt('y', k),
                       stiffness));
  write_spinning(xml, k);
}

void SegmentRotor::write_spinning(XmlWriter& xml, std::size_t k) const {
  const scene::RotorGeometry& geometry = *scene_.rotor.geometry;
  const Segment& s = chain_.segments[k];
  const double origin = k == 0 ? s.node : chain_.joint[k - 1];
  const auto here = [&](double z) { return chain_.node_at(z) == static_cast<int>(k); };

  xml.open(fmt::format(R"(<body name="{}" pos="0 0 {}">)", names::spinning(k), s.node - origin));
  xml.line(inertial(0.0, 0.0, s.centre - s.node, s.mass, s.Jt, s.Jp));
  double armature = 0.0;
  if (scene_.drive && here(scene_.drive->station)) armature = scene_.drive->inertia;
  // A held speed is imposed at the first node, or at all nodes if torsion is rigid.
  if (!scene_.drive && (k == 0 || !has_elastic_torsion(scene_))) {
    armature = kHeldInertia * matrices_.spin_inertia.sum();
  }
  xml.line(fmt::format(R"(<joint name="{}" type="hinge" axis="0 0 1" armature="{}"/>)",
                       names::spin(k), armature));
  const double radius = drawn_shaft_radius(geometry, s);
  xml.line(fmt::format(R"(<geom type="cylinder" fromto="0 0 {} 0 0 {}" size="{}" {} )"
                       R"(rgba="0.72 0.74 0.78 1"/>)",
                       s.from - s.node, s.to - s.node, radius, kDrawn));
  for (std::size_t i = 0; i < scene_.auxiliary.size(); ++i) {
    const auto& contact = scene_.auxiliary[i].contact;
    if (contact && here(contact->station)) write_rotor_disc(xml, scene_, i);
  }
  for (const scene::Disc& disc : geometry.discs) {
    if (!here(disc.z)) continue;
    const double e = disc.eccentricity;
    xml.open("<body>");
    // Jp refers to the shaft's axis.
    xml.line(inertial(e * std::cos(disc.phase), e * std::sin(disc.phase), 0.0, disc.mass, disc.Jt,
                      disc.Jp - disc.mass * e * e, kept_apart(e)));
    const double r = disc.mass > 0.0 ? std::sqrt(2.0 * disc.Jp / disc.mass) : radius;
    xml.line(fmt::format(R"(<geom type="cylinder" size="{} {}" {} rgba="0.6 0.64 0.7 1"/>)", r,
                         0.15 * r, kDrawn));
    xml.close("body");
  }
  xml.close("body");
}

void SegmentRotor::write_tendons(XmlWriter& xml) const {
  if (has_elastic_torsion(scene_)) {
    for (std::size_t k = 0; k + 1 < chain_.segments.size(); ++k) {
      xml.open(fmt::format(R"(<fixed name="torsion_{}" stiffness="{}">)", k + 1,
                           chain_.torsion_stiffness[k]));
      xml.line(fmt::format(R"(<joint joint="{}" coef="-1"/>)", names::spin(k)));
      xml.line(fmt::format(R"(<joint joint="{}" coef="1"/>)", names::spin(k + 1)));
      xml.close("fixed");
    }
  }
  for (std::size_t i = 0; i < scene_.rotor.geometry->bearings.size(); ++i) write_bearing(xml, i);
}

// The deflection at the bearing, as one tendon for each plane.
void SegmentRotor::write_bearing(XmlWriter& xml, std::size_t index) const {
  const scene::ShaftBearing& bearing = scene_.rotor.geometry->bearings[index];
  const Eigen::RowVectorXd row = chain_.deflection(bearing.z);
  for (const int plane : {0, 1}) {
    const char letter = plane == 0 ? 'x' : 'y';
    xml.open(fmt::format(R"(<fixed name="bearing_{}_{}" stiffness="{}" damping="{}">)", letter,
                         index + 1, bearing.stiffness[plane], bearing.damping[plane]));
    for (Eigen::Index i = 0; i < row.size(); ++i) {
      if (row[i] == 0.0) continue;
      const std::string joint = i == 0 ? (plane == 0 ? names::kEndX : names::kEndY)
                                       : names::tilt(letter, static_cast<std::size_t>(i) - 1);
      xml.line(fmt::format(R"(<joint joint="{}" coef="{}"/>)", joint, row[i]));
    }
    xml.close("fixed");
  }
}

Eigen::VectorXd SegmentRotor::of_nodes(const Eigen::VectorXd& modal, double rigid_spin) const {
  const Layout& l = model_.layout;
  const Eigen::VectorXd spin =
      (matrices_.shape_torsion * modal.segment(l.theta(), l.torsion)).array() + rigid_spin;
  const Eigen::VectorXd x = matrices_.shape_x * modal.segment(l.x(), l.modes);
  const Eigen::VectorXd y = matrices_.shape_y * modal.segment(l.y(), l.modes);
  Eigen::VectorXd all(2 * x.size() + spin.size());
  all.head<2>() << x[0], y[0];
  for (Eigen::Index k = 0; k < spin.size(); ++k) {
    all.segment<3>(2 + 3 * k) << x[k + 1], y[k + 1], spin[k];
  }
  return all;
}

Eigen::VectorXd SegmentRotor::start_position() const {
  return of_nodes(model_.q0, model_.spin_angle);
}

Eigen::VectorXd SegmentRotor::start_velocity() const { return of_nodes(model_.v0, model_.speed); }

}  // namespace rotorub
