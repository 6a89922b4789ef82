#include "mjcf/writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "mjcf/names.h"
#include "mjcf/soft_contact.h"
#include "mjcf/xml.h"

namespace rotorub {
namespace {

namespace names = mjcf_names;

// What MuJoCo demands of a moving body (it takes no less than 1e-15). The inertia that the chain
// has comes from the joints' armature; this much is added to it.
constexpr const char* kMassless =
    R"(<inertial pos="0 0 0" mass="1e-12" diaginertia="1e-12 1e-12 1e-12"/>)";

// Half the thickness of the drawn disc over its radius; sizes below are in these terms, m.
constexpr double kThickness = 0.15;
constexpr double kRadiusWithoutContact = 0.02;

const char* contact_name(scene::ContactModel contact) {
  switch (contact) {
    case scene::ContactModel::kRigid:
      return "rigid";
    case scene::ContactModel::kCoulomb:
      return "coulomb";
    case scene::ContactModel::kCone:
      return "cone";
  }
  return "";
}

void refuse_unsupported(const scene::Scene& scene) {
  const scene::Mujoco& mujoco = scene.mujoco;
  const auto refuse = [&](const std::string& what) {
    throw std::invalid_argument("scene " + scene.name + ": " + what);
  };
  if (mujoco.rotor == scene::MujocoRotor::kSegments) {
    refuse("mujoco.rotor: \"segments\" is not available; accepted: \"modal\"");
  }
  if (scene.contact && mujoco.contact == scene::ContactModel::kRigid) {
    refuse("mujoco.contact: \"rigid\" is not available; accepted: \"coulomb\", \"cone\"");
  }
  if (mujoco.integrator != scene::MujocoIntegrator::kEuler) {
    refuse("mujoco.integrator: accepted: \"euler\"");
  }
}

class Document {
 public:
  explicit Document(const scene::Scene& scene)
      : scene_(scene),
        model_(make_model(scene)),
        radius_(scene.contact ? scene.contact->radius : kRadiusWithoutContact) {}

  std::string write() {
    xml_.open(fmt::format(R"(<mujoco model="{}">)", xml_escape(scene_.name)));
    options();
    visual();
    xml_.open("<worldbody>");
    surroundings();
    rotor();
    rotor_nodes();
    ring();
    xml_.close("worldbody");
    if (scene_.contact) contact();
    if (actuated()) actuators();
    sensors();
    keyframes();
    custom();
    xml_.close("mujoco");
    return xml_.take();
  }

 private:
  bool actuated() const { return scene_.stator && (scene_.actuator || scene_.controller); }

  void options() {
    // One contact at most, solved in one Newton step: the tolerance stops the second.
    xml_.line(
        fmt::format(R"(<option timestep="{}" gravity="0 0 0" integrator="Euler" cone="elliptic" )"
                    R"(jacobian="dense" solver="Newton" iterations="50" tolerance="1e-12"/>)",
                    scene_.run.step));
    xml_.line(fmt::format(R"(<size njmax="32" nconmax="8" nuserdata="{}"/>)", names::kUserData));
  }

  void visual() {
    xml_.line(fmt::format(R"(<statistic center="0 0 0" extent="{}"/>)", 2.5 * radius_));
    xml_.open("<visual>");
    xml_.line(R"(<global offwidth="1280" offheight="720"/>)");
    xml_.line(R"(<map znear="0.05" zfar="50"/>)");
    xml_.close("visual");
  }

  void surroundings() {
    const double r = radius_;
    xml_.line(
        fmt::format(R"(<light name="key" pos="{} {} {}" dir="-1 -1 -2"/>)", 4 * r, 4 * r, 8 * r));
    xml_.line(fmt::format(R"(<camera name="{}" pos="0 0 {}" xyaxes="1 0 0 0 1 0" fovy="30"/>)",
                          names::kContactCamera, 5 * r));
    xml_.line(fmt::format(
        R"(<camera name="{}" pos="{} {} {}" xyaxes="0.8 0.6 0 -0.36 0.48 0.8" fovy="30"/>)",
        names::kObliqueCamera, 3.0 * r, -4.0 * r, 3.75 * r));
    xml_.line(fmt::format(R"(<camera name="{}" pos="0 {} 0" xyaxes="1 0 0 0 0 1" fovy="30"/>)",
                          names::kSideCamera, -5 * r));
  }

  void joint(const std::string& name, const char* type, const char* axis, int at) {
    std::string text = fmt::format(R"(<joint name="{}" type="{}" axis="{}" armature="{}")", name,
                                   type, axis, model_.mass[at]);
    if (model_.stiffness[at] != 0.0) {
      text += fmt::format(R"( stiffness="{}")", model_.stiffness[at]);
    }
    if (model_.damping[at] != 0.0) text += fmt::format(R"( damping="{}")", model_.damping[at]);
    xml_.line(text + "/>");
  }

  // The bending modes whose contact shape is 1 (in the chain) or 0 (on the branch).
  void bending_joints(double contact_shape) {
    const Layout& l = model_.layout;
    for (const bool y : {false, true}) {
      const Eigen::VectorXd& shape = y ? model_.contact_shape.y : model_.contact_shape.x;
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
      if (model_.torsion_contact[k] != contact_shape) continue;
      joint(names::torsion_joint(k + 1), "hinge", "0 0 1", l.theta() + k);
    }
  }

  void rotor() {
    const double r = radius_, half = kThickness * radius_;
    xml_.open(fmt::format(R"(<body name="{}">)", names::kRotor));
    xml_.line(kMassless);
    bending_joints(1.0);
    if (model_.layout.spin) joint(names::kSpinJoint, "hinge", "0 0 1", model_.layout.phi());
    torsion_joints(1.0);
    xml_.line(fmt::format(R"(<geom name="{}" type="cylinder" size="{} {}" mass="0" contype="0" )"
                          R"(conaffinity="0" group="1" rgba="0.72 0.74 0.78 1"/>)",
                          names::kRotor, r, half));
    // A mark that shows the spin.
    xml_.line(fmt::format(R"(<geom name="rotor_mark" type="box" pos="{} 0 {}" size="{} {} {}" )"
                          R"(mass="0" contype="0" conaffinity="0" group="1" )"
                          R"(rgba="0.85 0.3 0.1 1"/>)",
                          0.6 * r, half, 0.25 * r, 0.05 * r, 0.05 * half));
    if (scene_.contact) {
      // Stands for the disc in the pair; its size is of no meaning.
      xml_.line(fmt::format(R"(<geom name="{}" type="sphere" size="{}" mass="0" contype="0" )"
                            R"(conaffinity="0" group="4"/>)",
                            names::kRotorContact, 0.1 * r));
    }
    xml_.close("body");
  }

  bool has_nodes() const {
    const auto any = [](const Eigen::VectorXd& shape) {
      return std::any_of(shape.begin(), shape.end(), [](double value) { return value == 0.0; });
    };
    return any(model_.contact_shape.x) || any(model_.contact_shape.y) ||
           any(model_.torsion_contact);
  }

  void rotor_nodes() {
    if (!has_nodes()) return;
    xml_.open(fmt::format(R"(<body name="{}">)", names::kRotorNodes));
    xml_.line(kMassless);
    bending_joints(0.0);
    torsion_joints(0.0);
    xml_.close("body");
  }

  void ring() {
    if (!scene_.contact && !scene_.stator) return;
    const double half = kThickness * radius_;
    xml_.open(fmt::format(R"(<body name="{}">)", names::kRing));
    if (model_.layout.stator) {
      xml_.line(kMassless);
      joint(names::kRingX, "slide", "1 0 0", model_.layout.ring());
      joint(names::kRingY, "slide", "0 1 0", model_.layout.ring() + 1);
    }
    const double clearance = scene_.contact ? scene_.contact->clearance : 0.0;
    xml_.line(fmt::format(R"(<geom name="{}" type="cylinder" size="{} {}" mass="0" contype="0" )"
                          R"(conaffinity="0" group="1" rgba="0.2 0.45 0.7 0.25"/>)",
                          names::kRing, radius_ + clearance, 0.9 * half));
    if (scene_.contact) {
      // A rod half a length above the plane: far from the rotor's sphere, with a bounding sphere
      // that holds it wherever the two go.
      const double length = 1.0 + 1000.0 * (radius_ + clearance);
      xml_.line(fmt::format(R"(<geom name="{}" type="capsule" fromto="{} 0 {} {} 0 {}" )"
                            R"(size="{}" mass="0" contype="0" conaffinity="0" group="4"/>)",
                            names::kRingContact, -length, 0.5 * length, length, 0.5 * length,
                            0.1 * radius_));
    }
    xml_.close("body");
  }

  void contact() {
    const scene::Contact& c = *scene_.contact;
    const SoftContact soft =
        soft_contact(c.restitution, scene_.run.step, scene_.mujoco.solref_stiffness);
    // `coulomb`: no friction in MuJoCo's contact, the plugin adds it. Without friction the cone's
    // tangential directions are of no use either.
    const bool cone = scene_.mujoco.contact == scene::ContactModel::kCone && c.friction > 0.0;
    xml_.open("<contact>");
    xml_.line(
        fmt::format(R"(<pair name="rub" geom1="{}" geom2="{}" condim="{}" friction="{} {} 0 0 0" )"
                    R"(solref="{} {}" solimp="{} {} 0.001" margin="0" gap="0"/>)",
                    names::kRotorContact, names::kRingContact, cone ? 3 : 1, c.friction, c.friction,
                    -soft.stiffness, -soft.damping, soft.impedance, soft.impedance));
    xml_.close("contact");
  }

  void actuators() {
    const double h = 0.70710678118654752440;  // a_1 = (1, 1)/sqrt 2, a_2 = (-1, 1)/sqrt 2
    xml_.open("<tendon>");
    for (int k = 0; k < 2; ++k) {
      xml_.open(fmt::format(R"(<fixed name="{}">)", names::kAxis[k]));
      xml_.line(fmt::format(R"(<joint joint="{}" coef="{}"/>)", names::kRingX, k == 0 ? h : -h));
      xml_.line(fmt::format(R"(<joint joint="{}" coef="{}"/>)", names::kRingY, h));
      xml_.close("fixed");
    }
    xml_.close("tendon");
    const double limit = model_.force_limit;
    const std::string range =
        limit < 1e300 ? fmt::format(R"(ctrllimited="true" ctrlrange="{} {}")", -limit, limit)
                      : std::string(R"(ctrllimited="false")");
    xml_.open("<actuator>");
    for (int k = 0; k < 2; ++k) {
      xml_.line(fmt::format(R"(<motor name="{}" tendon="{}" {}/>)", names::kActuator[k],
                            names::kAxis[k], range));
    }
    xml_.close("actuator");
  }

  void sensor(const char* name, const char* stage, int dim = 1) {
    xml_.line(fmt::format(R"(<user name="{}" objtype="body" objname="{}" datatype="real" )"
                          R"(needstage="{}" dim="{}"/>)",
                          name, names::kRotor, stage, dim));
  }
  void sensors() {
    xml_.open("<sensor>");
    sensor(names::kActive, "pos");
    if (scene_.contact) {
      sensor(names::kGap, "pos");
      sensor(names::kGapRate, "vel");
      sensor(names::kSlip, "vel");
      sensor(names::kNormalForce, "acc");
      sensor(names::kFrictionForce, "acc");
    }
    if (actuated()) sensor(names::kControlForce, "acc", 2);
    xml_.close("sensor");
  }

  // Indices of q in the order of MuJoCo's joints: chain, branch, ring.
  std::vector<int> joint_order() const {
    const Layout& l = model_.layout;
    std::vector<int> order;
    for (const double on : {1.0, 0.0}) {
      for (int k = 0; k < l.modes; ++k) {
        if (model_.contact_shape.x[k] == on) order.push_back(l.x() + k);
      }
      for (int k = 0; k < l.modes; ++k) {
        if (model_.contact_shape.y[k] == on) order.push_back(l.y() + k);
      }
      if (on == 1.0 && l.spin) order.push_back(l.phi());
      for (int k = 0; k < l.torsion; ++k) {
        if (model_.torsion_contact[k] == on) order.push_back(l.theta() + k);
      }
    }
    for (int k = 0; k < l.stator; ++k) order.push_back(l.ring() + k);
    return order;
  }

  void keyframes() {
    const auto listed = [&](const Eigen::VectorXd& values) {
      std::string text;
      for (const int at : joint_order()) {
        text += (text.empty() ? "" : " ") + fmt::format("{}", values[at]);
      }
      return text;
    };
    xml_.open("<keyframe>");
    for (const char* name : {names::kStartKey, names::kTestKey}) {
      xml_.line(fmt::format(R"(<key name="{}" time="0" qpos="{}" qvel="{}"/>)", name,
                            listed(model_.q0), listed(model_.v0)));
    }
    xml_.close("keyframe");
  }

  void custom() {
    xml_.open("<custom>");
    xml_.line(
        fmt::format(R"(<text name="{}" data="{}"/>)", names::kSceneText, xml_escape(scene_.text)));
    if (scene_.contact) {
      xml_.line(fmt::format(R"(<text name="{}" data="{}"/>)", names::kContactText,
                            contact_name(scene_.mujoco.contact)));
    }
    xml_.close("custom");
  }

  const scene::Scene& scene_;
  Model model_;
  double radius_;  // m, of the drawn disc
  XmlWriter xml_;
};

}  // namespace

std::string mjcf(const scene::Scene& scene) {
  refuse_unsupported(scene);
  return Document(scene).write();
}

}  // namespace rotorub
