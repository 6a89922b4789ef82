#include "mjcf/bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "mjcf/names.h"
#include "native_model/model/dynamics.h"
#include "native_model/scene/scene.h"

namespace rotorub {
namespace {

namespace names = mjcf_names;

// MuJoCo requires mass and inertia of a moving body (at least 1e-15). The inertia of the chain is
// in the joints' armature, to which this is added.
constexpr const char* kMassless =
    R"(<inertial pos="0 0 0" mass="1e-12" diaginertia="1e-12 1e-12 1e-12"/>)";
// From 3.0 on, mj_setConst computes the inverse weight of a body with only slide joints from its
// mass, without armature, unless its centre of mass is off its frame. A soft contact would then be
// softer by a factor of 1e12.
constexpr const char* kMasslessAside =
    R"(<inertial pos="0 0 1e-6" mass="1e-12" diaginertia="1e-12 1e-12 1e-12"/>)";

// Half the thickness of the drawn disc relative to its radius. The sizes below also scale with it.
constexpr double kThickness = 0.15;
constexpr double kRadiusWithoutContact = 0.02;

// Thin discs over the drawn faces, in units of the disc's radius. The rotor's face is at 0.15, its
// mark ends at 0.1575, and the ring's face is at 0.135.
constexpr double kOverRotor = 0.165, kOverRing = 0.142, kHalf = 0.003;

// Geoms that are only drawn: they have no mass and touch nothing. Lengths are in m.
std::string drawn_cylinder(const std::string& name, double radius, double half,
                           const char* colour) {
  return fmt::format(R"(<geom name="{}" type="cylinder" size="{} {}" mass="0" contype="0" )"
                     R"(conaffinity="0" group="1" rgba="{}"/>)",
                     name, radius, half, colour);
}

// centre: x and z. half: half lengths of the edges.
std::string drawn_box(const std::string& name, const Eigen::Vector2d& centre,
                      const Eigen::Vector3d& half, const char* colour) {
  return fmt::format(R"(<geom name="{}" type="box" pos="{} 0 {}" size="{} {} {}" )"
                     R"(mass="0" contype="0" conaffinity="0" group="1" rgba="{}"/>)",
                     name, centre.x(), centre.y(), half.x(), half.y(), half.z(), colour);
}

constexpr const char* kRotorColour = "0.72 0.74 0.78 1";

// Represents the rotor's disc in the contact pair; its size has no meaning.
std::string contact_sphere(std::size_t bearing, double radius) {
  return fmt::format(R"(<geom name="{}" type="sphere" size="{}" mass="0" contype="0" )"
                     R"(conaffinity="0" group="4"/>)",
                     names::of_bearing(bearing, names::kRotorContact), 0.1 * radius);
}

void write_ghost(XmlWriter& xml, const char* name, const Eigen::Vector3d& at, double radius,
                 double half, const char* colour) {
  xml.open(
      fmt::format(R"(<body name="{}" mocap="true" pos="{} {} {}">)", name, at.x(), at.y(), at.z()));
  xml.line(drawn_cylinder(name, radius, half, colour));
  xml.close("body");
}

class Bodies {
 public:
  Bodies(XmlWriter& xml, const scene::Scene& scene, const Model& model, const MujocoVersion& target)
      : xml_(xml),
        scene_(scene),
        model_(model),
        massless_(target < MujocoVersion{3, 0, 0} ? kMassless : kMasslessAside) {}

  void write() {
    rotor();
    for (std::size_t k = 1; k < scene_.auxiliary.size(); ++k) rotor_beside(k);
    rotor_nodes();
    write_beside_the_rotor();
  }
  void write_beside_the_rotor() {
    for (std::size_t k = 0; k < scene_.auxiliary.size(); ++k) ring(k);
    for (std::size_t k = 0; k < scene_.auxiliary.size(); ++k) housing(k);
    for (const StationSupport& support : model_.supports) bristles(support);
    integrators();
  }

 private:
  void joint(const std::string& name, const char* type, const char* axis, int at) {
    std::string text = fmt::format(R"(<joint name="{}" type="{}" axis="{}" armature="{}")", name,
                                   type, axis, model_.mass[at]);
    if (model_.stiffness[at] != 0.0) {
      text += fmt::format(R"( stiffness="{}")", model_.stiffness[at]);
    }
    if (model_.damping[at] != 0.0) text += fmt::format(R"( damping="{}")", model_.damping[at]);
    joints_.push_back(text + "/>");
  }

  // Opens a body that moves by the collected joints. MuJoCo allows at most six joints per body; the
  // others go to links before it.
  void open_moving_body(const char* name, const std::string& place = "") {
    constexpr std::size_t kMostJoints = 6;
    open_bodies_ = 0;
    for (std::size_t at = 0; at == 0 || at < joints_.size(); at += kMostJoints) {
      const std::size_t end = std::min(at + kMostJoints, joints_.size());
      ++open_bodies_;
      xml_.open(end == joints_.size()
                    ? fmt::format(R"(<body name="{}"{}>)", name, place)
                    : fmt::format(R"(<body name="{}_link_{}">)", name, open_bodies_));
      xml_.line(massless_);
      for (std::size_t i = at; i < end; ++i) xml_.line(joints_[i]);
    }
    joints_.clear();
  }
  void close_moving_body() {
    for (; open_bodies_ > 0; --open_bodies_) xml_.close("body");
  }

  // The bending modes whose contact shape is 1 (for the chain) or 0 (for the branch).
  void bending_joints(double contact_shape) {
    const Layout& l = model_.layout;
    for (const bool y : {false, true}) {
      const Eigen::VectorXd& shape = y ? model_.first().shape.y : model_.first().shape.x;
      for (int k = 0; k < l.modes; ++k) {
        if (shape[k] != contact_shape) continue;
        joint(names::bending_joint(y ? 'y' : 'x', k + 1), "slide", y ? "0 1 0" : "1 0 0",
              (y ? l.y() : l.x()) + k);
      }
    }
  }
  void torsion_joints(double contact_shape) {
    const Layout& l = model_.layout;
    for (int k = 0; k < l.torsion; ++k) {
      if (model_.first().torsion_shape[k] != contact_shape) continue;
      joint(names::torsion_joint(k + 1), "hinge", "0 0 1", l.theta() + k);
    }
  }

  // z of a contact, m. The plane of the first contact is z = 0.
  double contact_plane(std::size_t k) const {
    if (k == 0) return 0.0;
    return scene_.auxiliary[k].contact->station - scene_.first().contact->station;
  }

  void rotor() {
    bending_joints(1.0);
    if (model_.layout.spin) joint(names::kSpinJoint, "hinge", "0 0 1", model_.layout.phi());
    torsion_joints(1.0);
    open_moving_body(names::kRotor);
    write_rotor_disc(xml_, scene_, 0);
    close_moving_body();
  }

  // The rotor at a further contact. The modes move it by values other than 1 and 0, so the plugin
  // places it.
  void rotor_beside(std::size_t k) {
    const Eigen::Vector2d at = rotor_point(model_, model_.q0.data(), k);
    const double r = drawn_radius(scene_, k);
    const std::string name = names::of_bearing(k, names::kRotor);
    xml_.open(fmt::format(R"(<body name="{}" mocap="true" pos="{} {} {}">)", name, at.x(), at.y(),
                          contact_plane(k)));
    xml_.line(massless_);
    xml_.line(drawn_cylinder(name, r, kThickness * r, kRotorColour));
    xml_.line(contact_sphere(k, r));
    xml_.close("body");
  }

  bool has_nodes() const {
    const auto any = [](const Eigen::VectorXd& shape) {
      return std::any_of(shape.begin(), shape.end(), [](double value) { return value == 0.0; });
    };
    return any(model_.first().shape.x) || any(model_.first().shape.y) ||
           any(model_.first().torsion_shape);
  }

  void rotor_nodes() {
    if (!has_nodes()) return;
    bending_joints(0.0);
    torsion_joints(0.0);
    open_moving_body(names::kRotorNodes);
    close_moving_body();
  }

  void ring(std::size_t k) {
    const scene::AuxiliaryBearing& bearing = scene_.auxiliary[k];
    const AuxiliaryBearing& at = model_.auxiliary[k];
    if (!bearing.contact && !bearing.stator) return;
    const auto named = [k](const char* name) { return names::of_bearing(k, name); };
    const double radius = drawn_radius(scene_, k), half = kThickness * radius;
    if (at.moves()) {
      joint(named(names::kRingX), "slide", "1 0 0", at.ring);
      joint(named(names::kRingY), "slide", "0 1 0", at.ring + 1);
    }
    // After the slides, so that it does not turn their axes.
    if (at.turns()) joint(named(names::kRingSpin), "hinge", "0 0 1", at.ring_angle);
    const Eigen::Vector2d& offset = at.ring_offset;
    const double z = contact_plane(k);
    const std::string place = offset.isZero(0.0) && z == 0.0
                                  ? std::string()
                                  : fmt::format(R"( pos="{} {} {}")", offset.x(), offset.y(), z);
    // Massless even if fixed, because MuJoCo includes it in the world's mass.
    open_moving_body(named(names::kRing).c_str(), place);
    const double clearance = bearing.contact ? bearing.contact->clearance : 0.0;
    const double bore = radius + clearance;
    xml_.line(drawn_cylinder(named(names::kRing), bore, 0.9 * half, "0.2 0.45 0.7 0.25"));
    if (at.turns()) {  // a mark that shows the ring's rotation
      xml_.line(drawn_box(named("ring_mark"), {1.06 * bore, half},
                          {0.05 * bore, 0.03 * bore, 0.05 * half}, "0.95 0.75 0.1 1"));
    }
    if (bearing.contact) {
      // A rod half its length above the plane. It is far from the rotor's sphere, but its bounding
      // sphere always contains it.
      const double length = 1.0 + 1000.0 * bore;
      xml_.line(fmt::format(R"(<geom name="{}" type="capsule" fromto="{} 0 {} {} 0 {}" )"
                            R"(size="{}" mass="0" contype="0" conaffinity="0" group="4"/>)",
                            named(names::kRingContact), -length, 0.5 * length, length, 0.5 * length,
                            0.1 * radius));
    }
    close_moving_body();
  }

  // The body that carries the ring. The plugin applies the forces between the two.
  void housing(std::size_t k) {
    const AuxiliaryBearing& at = model_.auxiliary[k];
    if (at.housing == kAbsent) return;
    const auto named = [k](const char* name) { return names::of_bearing(k, name); };
    joint(named(names::kHousingX), "slide", "1 0 0", at.housing);
    joint(named(names::kHousingY), "slide", "0 1 0", at.housing + 1);
    open_moving_body(named(names::kHousing).c_str(),
                     fmt::format(R"( pos="{} {} {}")", at.ring_offset.x(), at.ring_offset.y(),
                                 contact_plane(k)));
    const double radius = drawn_radius(scene_, k);
    xml_.line(drawn_cylinder(named(names::kHousing), 1.3 * radius, 0.5 * kThickness * radius,
                             "0.35 0.35 0.4 0.2"));
    close_moving_body();
  }

  void bristles(const StationSupport& s) {
    const auto named = [&](const char* name) { return names::of_bearing(s.number, name); };
    if (s.bristle != kAbsent) {
      joint(named(names::kBristleX), "slide", "1 0 0", s.bristle);
      joint(named(names::kBristleY), "slide", "0 1 0", s.bristle + 1);
    }
    if (s.spin_bristle != kAbsent) {
      joint(named(names::kSpinBristle), "slide", "0 0 1", s.spin_bristle);
    }
    if (joints_.empty()) return;
    open_moving_body(named(names::kBristles).c_str());
    close_moving_body();
  }

  // Two joints without a shape for each feedback state, which keep the integrator of a magnetic
  // bearing in MuJoCo's state, qvel.
  void integrators() {
    for (int i = 0; i < model_.layout.feedback_states; i += 2) {
      const int at = model_.layout.feedback_state() + i;
      joint(names::bearing_integral(i), "slide", "1 0 0", at);
      joint(names::bearing_integral(i + 1), "slide", "0 1 0", at + 1);
      open_moving_body(names::bearing_integrator(i / 2).c_str());
      close_moving_body();
    }
  }

  XmlWriter& xml_;
  const scene::Scene& scene_;
  const Model& model_;
  const char* massless_;
  std::vector<std::string> joints_;  // of the next moving body
  int open_bodies_ = 0;
};

}  // namespace

void write_rotor_disc(XmlWriter& xml, const scene::Scene& scene, std::size_t bearing) {
  const double r = drawn_radius(scene, bearing), half = kThickness * r;
  const auto named = [bearing](const char* name) { return names::of_bearing(bearing, name); };
  xml.line(drawn_cylinder(named(names::kRotor), r, half, kRotorColour));
  // A mark that shows the spin.
  xml.line(drawn_box(named("rotor_mark"), {0.6 * r, half}, {0.25 * r, 0.05 * r, 0.05 * half},
                     "0.85 0.3 0.1 1"));
  if (scene.auxiliary[bearing].contact) xml.line(contact_sphere(bearing, r));
}

void write_bodies(XmlWriter& xml, const scene::Scene& scene, const Model& model,
                  const MujocoVersion& target) {
  Bodies(xml, scene, model, target).write();
}

void write_beside_the_rotor(XmlWriter& xml, const scene::Scene& scene, const Model& model,
                            const MujocoVersion& target) {
  Bodies(xml, scene, model, target).write_beside_the_rotor();
}

std::vector<int> joint_order(const Model& model) {
  const Layout& l = model.layout;
  std::vector<int> order;
  for (const double on : {1.0, 0.0}) {
    for (int k = 0; k < l.modes; ++k) {
      if (model.first().shape.x[k] == on) order.push_back(l.x() + k);
    }
    for (int k = 0; k < l.modes; ++k) {
      if (model.first().shape.y[k] == on) order.push_back(l.y() + k);
    }
    if (on == 1.0 && l.spin) order.push_back(l.phi());
    for (int k = 0; k < l.torsion; ++k) {
      if (model.first().torsion_shape[k] == on) order.push_back(l.theta() + k);
    }
  }
  const std::vector<int> beside = order_beside_the_rotor(model);
  order.insert(order.end(), beside.begin(), beside.end());
  return order;
}

std::vector<int> order_beside_the_rotor(const Model& model) {
  const Layout& l = model.layout;
  std::vector<int> order;
  for (const AuxiliaryBearing& at : model.auxiliary) {
    if (at.moves()) order.insert(order.end(), {at.ring, at.ring + 1});
    if (at.turns()) order.push_back(at.ring_angle);
  }
  for (const AuxiliaryBearing& at : model.auxiliary) {
    if (at.housing != kAbsent) order.insert(order.end(), {at.housing, at.housing + 1});
  }
  for (int i = l.bristle(); i < l.feedback_state(); ++i) order.push_back(i);
  for (int i = l.feedback_state(); i < l.coil(); ++i) order.push_back(i);
  return order;
}

double drawn_radius(const scene::Scene& scene, std::size_t bearing) {
  const auto& contact = scene.auxiliary[bearing].contact;
  return contact ? contact->radius : kRadiusWithoutContact;
}

void write_ghosts(XmlWriter& xml, const scene::Scene& scene, const Model& model) {
  const double r = drawn_radius(scene);
  const auto over = [](const Eigen::Vector2d& centre, double z) {
    return Eigen::Vector3d(centre.x(), centre.y(), z);
  };
  write_ghost(xml, names::kGhostRotor, over(rotor_point(model, model.q0.data()), kOverRotor * r), r,
              kHalf * r, "0.95 0.6 0.1 0.3");
  if (!model.layout.stator) return;
  const double clearance = scene.has_contact() ? scene.first().contact->clearance : 0.0;
  write_ghost(xml, names::kGhostRing, over(ring_centre(model, model.q0.data()), kOverRing * r),
              r + clearance, kHalf * r, "0.95 0.6 0.1 0.15");
}

}  // namespace rotorub
