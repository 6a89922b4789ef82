#include "mjcf/writer.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mjcf/bodies.h"
#include "mjcf/names.h"
#include "mjcf/segment_bodies.h"
#include "mjcf/soft_contact.h"
#include "mjcf/xml.h"
#include "native_model/model/model_checks.h"
#include "native_model/prepare/prepare.h"
#include "native_model/rotor/refusal.h"
#include "native_model/scene/record.h"
#include "native_model/scene/scene.h"
#include "native_model/scene/text.h"
#include "native_model/stepping/stepper.h"
#include "native_model/stepping/zero_order_hold.h"

namespace rotorub {
namespace {

namespace names = mjcf_names;

void refuse_unsupported(const scene::Scene& scene) {
  const scene::Mujoco& mujoco = scene.mujoco;
  if (mujoco.rotor == scene::MujocoRotor::kSegments && !scene.rotor.geometry) {
    scene::refuse_at(scene, "mujoco.rotor",
                     "\"segments\" needs the rotor's geometry; set \"modal\"");
  }
  refuse_several_in_mujoco(scene);
  refuse_compliance_in_mujoco(scene);
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    const auto& contact = scene.auxiliary[k].contact;
    if (!scene::is_cone(mujoco.contact) || !contact || contact->friction.is_constant()) continue;
    scene::refuse_at(scene,
                     k > 0 ? scene::list_element("contact", k) + ".friction" : "contact.friction",
                     "MuJoCo's cone has one coefficient for all slips; give a number, or set "
                     "mujoco.contact = \"rigid\" or \"coulomb\"");
  }
  if (mujoco.integrator == scene::MujocoIntegrator::kRk4) {
    scene::refuse_at(scene, "mujoco.integrator",
                     "the plugin does not support \"rk4\"; set \"euler\" or \"implicit\"");
  }
}

// MuJoCo's name of the solver.
const char* word(scene::MujocoSolver solver) {
  switch (solver) {
    case scene::MujocoSolver::kCg:
      return "CG";
    case scene::MujocoSolver::kPgs:
      return "PGS";
    case scene::MujocoSolver::kNewton:
      break;
  }
  return "Newton";
}

class Document {
 public:
  Document(const scene::Scene& scene, const MujocoVersion& target)
      : scene_(scene),
        target_(target),
        model_(without_coils(prepare(scene))),
        radius_(drawn_radius(scene)) {
    if (scene.mujoco.rotor == scene::MujocoRotor::kSegments) segments_.emplace(scene_, model_);
    for (const StationFeedback& f : model_.feedbacks) {
      if (scene.mujoco.bearing_currents && f.states.current != kAbsent) excited_.push_back(&f);
    }
  }

  std::string write() {
    xml_.open(fmt::format(R"(<mujoco model="{}">)", xml_escape(scene_.name)));
    options();
    visual();
    xml_.open("<worldbody>");
    surroundings();
    if (segments_) {
      segments_->write_bodies(xml_);
      write_beside_the_rotor(xml_, scene_, model_, target_);
    } else {
      write_bodies(xml_, scene_, model_, target_);
    }
    if (scene_.mujoco.shadow) write_ghosts(xml_, scene_, model_);
    xml_.close("worldbody");
    if (scene_.has_contact()) contacts();
    if (segments_ || actuated()) tendons();
    if (actuated() || !excited_.empty()) actuators();
    sensors();
    keyframes();
    custom();
    xml_.close("mujoco");
    return xml_.take();
  }

 private:
  bool actuated() const {
    return scene_.first().stator && (scene_.first().actuator || scene_.first().controller);
  }

  void options() {
    const bool implicit = scene_.mujoco.integrator == scene::MujocoIntegrator::kImplicit;
    // MuJoCo's gravity does not act on armatures, so the plugin applies it to the modes.
    const Eigen::Vector2d gravity =
        scene_.gravity ? scene_.gravity->acceleration : Eigen::Vector2d::Zero();
    // A single contact is solved in one Newton step, and the tolerance avoids the second. Only the
    // predefined pair is tested, because a search for others would take a third of the step. (From
    // 3.0 on, geoms without a contype have this effect.)
    const bool has_option = target_ < MujocoVersion{3, 0, 0};
    // `cone-coulomb` starts the solver from the solution. The round-off of its references, B times
    // the slip, is above 1e-12.
    const bool corrected = scene_.mujoco.contact == scene::ContactModel::kConeCoulomb;
    xml_.line(
        fmt::format(R"(<option timestep="{}" gravity="{} {} 0" integrator="{}" cone="elliptic" )"
                    R"({}jacobian="dense" solver="{}" iterations="50" )"
                    R"(tolerance="{}"/>)",
                    scene_.run.step, gravity.x(), gravity.y(), implicit ? "implicit" : "Euler",
                    has_option ? R"(collision="predefined" )" : "", word(scene_.mujoco.solver),
                    corrected ? "1e-8" : "1e-12"));
    const std::size_t loop = model_.first().loop ? model_.first().loop->memory_size() : 0;
    int user_data = names::user_data_size(model_.nq(), model_.first().controller != nullptr, loop);
    if (scene_.has_contact() && !segments_ && !scene_.is_compliant()) {
      user_data += names::verlet_data_size(model_.nq(), ZeroOrderHold::memory_size(model_),
                                           VerletStepper::memory_size(model_));
    }
    if (scene_.mujoco.shadow) {
      const Model whole = prepare(scene_);
      user_data += names::shadow_data_size(ZeroOrderHold::memory_size(whole),
                                           VerletStepper::memory_size(whole));
    }
    const std::size_t further = scene_.auxiliary.size() - 1;
    user_data += names::kPairEntries * static_cast<int>(further);
    // From 3.0 on MuJoCo allocates what it needs.
    const std::string room =
        fmt::format(R"(njmax="{}" nconmax="{}" )", 32 + 16 * further, 8 + 4 * further);
    xml_.line(
        fmt::format(R"(<size {}nuserdata="{}"/>)", has_option ? room : std::string(), user_data));
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

  // MuJoCo divides this value by the impedance.
  std::string friction_reference(const ContactPair& pair) const {
    if (!has_friction_reference() || target_ < MujocoVersion{2, 3, 7}) return {};
    return fmt::format(R"(solreffriction="0 {}" )",
                       -scene_.mujoco.friction_reference * pair.soft.impedance);
  }
  bool has_friction_reference() const {
    return scene_.mujoco.friction_reference > 0.0 &&
           scene_.mujoco.contact == scene::ContactModel::kCone;
  }

  void contacts() {
    xml_.open("<contact>");
    for (std::size_t k = 0; k < scene_.auxiliary.size(); ++k) contact(k);
    xml_.close("contact");
  }
  void contact(std::size_t k) {
    const scene::Contact& c = *scene_.auxiliary[k].contact;
    const SoftContact soft =
        soft_contact(scene_, scene_.mujoco.contact, scene_.run.step, k, model_.auxiliary[k].shape);
    // On the modal chain only the plugin solves further contacts.
    const bool is_alone = k > 0 && !segments_;
    const ContactPair pair =
        contact_pair(scene_.mujoco.contact, c.clearance, c.friction, soft, target_, is_alone);
    xml_.line(fmt::format(
        R"(<pair name="{}" geom1="{}" geom2="{}" condim="{}" friction="{} {} 0 0 0" )"
        R"(solref="{} {}" {}solimp="{} {} 0.001" margin="{}" gap="{}"/>)",
        names::of_bearing(k, "rub"), names::of_bearing(k, names::kRotorContact),
        names::of_bearing(k, names::kRingContact), pair.condim, pair.friction, pair.friction,
        -pair.soft.stiffness, -pair.soft.damping, friction_reference(pair), pair.soft.impedance,
        pair.soft.impedance, pair.margin, pair.gap));
  }

  void tendons() {
    xml_.open("<tendon>");
    if (segments_) segments_->write_tendons(xml_);
    if (actuated()) axes();
    xml_.close("tendon");
  }

  void axes() {
    const double h = 0.70710678118654752440;  // a_1 = (1, 1)/sqrt 2, a_2 = (-1, 1)/sqrt 2
    for (int k = 0; k < 2; ++k) {
      xml_.open(fmt::format(R"(<fixed name="{}">)", names::kAxis[k]));
      xml_.line(fmt::format(R"(<joint joint="{}" coef="{}"/>)", names::kRingX, k == 0 ? h : -h));
      xml_.line(fmt::format(R"(<joint joint="{}" coef="{}"/>)", names::kRingY, h));
      xml_.close("fixed");
    }
  }

  static std::string ctrl_range(double limit) {
    return limit < 1e300 ? fmt::format(R"(ctrllimited="true" ctrlrange="{} {}")", -limit, limit)
                         : std::string(R"(ctrllimited="false")");
  }

  // ctrl: the force on the ring, N, or the commanded current, A, whose force follows from the
  // plugin's gain and bias.
  void actuators() {
    // Only the ring of a single contact has actuators here (refuse_several_in_mujoco).
    const std::optional<MagneticActuator>& magnets = model_.first().magnets;
    const double limit = magnets ? magnets->current_limit : model_.first().force_limit;
    const bool lags = model_.first().lags();
    const std::string_view kind = magnets ? "general" : "motor";
    const std::string_view law = !magnets ? ""
                                 : lags   ? R"(dyntype="user" gaintype="user" biastype="user" )"
                                          : R"(dyntype="none" gaintype="user" biastype="user" )";
    xml_.open("<actuator>");
    for (int k = 0; actuated() && k < 2; ++k) {
      xml_.line(fmt::format(R"(<{} name="{}" tendon="{}" {}{}/>)", kind, names::kActuator[k],
                            names::kAxis[k], law, ctrl_range(limit)));
    }
    for (const StationFeedback* f : excited_) excitation(*f);
    xml_.close("actuator");
  }
  // ctrl: current, A, added to the one that the bearing's own control asks for. The coil's current
  // is the speed of a joint whose damper is the lag: mass di/dt = damping (asked + ctrl - i).
  void excitation(const StationFeedback& f) {
    for (int axis = 0; axis < 2; ++axis) {
      const int at = f.states.current + axis;
      xml_.line(fmt::format(R"(<motor name="{}" joint="{}" gear="{}" {}/>)",
                            names::bearing_current(f.number, axis),
                            names::bearing_integral(at - model_.layout.feedback_state()),
                            model_.damping[at], ctrl_range(f.law.current_limit)));
    }
  }

  void sensor(const std::string& name, const char* stage, int dim = 1) {
    xml_.line(fmt::format(R"(<user name="{}" objtype="body" objname="{}" datatype="real" )"
                          R"(needstage="{}" dim="{}"/>)",
                          name, segments_ ? names::segment(0) : names::kRotor, stage, dim));
  }
  void sensors() {
    xml_.open("<sensor>");
    // `rigid` computes the forces before MuJoCo's last stage (plugin/sensors.h).
    const bool is_rigid =
        scene_.has_contact() && scene_.mujoco.contact == scene::ContactModel::kRigid;
    const char* force_stage = is_rigid ? "pos" : "acc";
    sensor(names::kActive, "pos");
    for (std::size_t k = 0; scene_.has_contact() && k < scene_.auxiliary.size(); ++k) {
      sensor(names::of_bearing(k, names::kGap), "pos");
      sensor(names::of_bearing(k, names::kGapRate), "pos");
      sensor(names::of_bearing(k, names::kSlip), "pos");
      sensor(names::of_bearing(k, names::kNormalForce), force_stage);
      sensor(names::of_bearing(k, names::kFrictionForce), force_stage);
    }
    if (actuated()) sensor(names::kControlForce, force_stage, 2);
    if (model_.first().magnets) sensor(names::kCurrent, force_stage, 2);
    if (scene_.mujoco.shadow) shadow_sensors();
    xml_.close("sensor");
  }

  void shadow_sensors() {
    sensor(names::kRotorPosition, "pos", 2);
    sensor(names::kShadowRotor, "pos", 2);
    if (model_.layout.stator) sensor(names::kShadowStator, "pos", 2);
    if (!scene_.has_contact()) return;
    sensor(names::kShadowGap, "pos");
    sensor(names::kShadowNormalForce, "pos");
    sensor(names::kShadowFrictionForce, "pos");
  }

  void keyframes() {
    const auto listed = [](const Eigen::VectorXd& values) {
      std::string text;
      for (const double value : values)
        text += (text.empty() ? "" : " ") + fmt::format("{}", value);
      return text;
    };
    const std::vector<int> order = segments_ ? order_beside_the_rotor(model_) : joint_order(model_);
    const auto followed = [&order](Eigen::VectorXd rotor, const Eigen::VectorXd& all) {
      Eigen::Index next = rotor.size();
      rotor.conservativeResize(next + static_cast<Eigen::Index>(order.size()));
      for (const int i : order) rotor[next++] = all[i];
      return rotor;
    };
    const Eigen::VectorXd none(0);
    const Eigen::VectorXd q = followed(segments_ ? segments_->start_position() : none, model_.q0);
    const Eigen::VectorXd v = followed(segments_ ? segments_->start_velocity() : none, model_.v0);
    xml_.open("<keyframe>");
    for (const char* name : {names::kStartKey, names::kTestKey}) {
      xml_.line(fmt::format(R"(<key name="{}" time="0" qpos="{}" qvel="{}"/>)", name, listed(q),
                            listed(v)));
    }
    xml_.close("keyframe");
  }

  void custom() {
    xml_.open("<custom>");
    xml_.line(
        fmt::format(R"(<text name="{}" data="{}"/>)", names::kSceneText, xml_escape(scene_.text)));
    if (scene_.has_contact()) {
      xml_.line(fmt::format(R"(<text name="{}" data="{}"/>)", names::kContactText,
                            scene::to_string(scene_.mujoco.contact)));
      if (has_friction_reference()) {
        xml_.line(fmt::format(R"(<numeric name="{}" data="{}"/>)", names::kOwnFrictionReference,
                              scene_.mujoco.friction_reference));
      }
    }
    xml_.close("custom");
  }

  const scene::Scene& scene_;
  const MujocoVersion target_;
  Model model_;
  std::optional<SegmentRotor> segments_;
  std::vector<const StationFeedback*> excited_;  // feedbacks of model_ with actuators
  double radius_;                                // m, of the drawn disc
  XmlWriter xml_;
};

}  // namespace

std::string mjcf(const scene::Scene& scene, const MujocoVersion& target) {
  refuse_unsupported(scene);
  try {
    return with_place(scene, [&] { return Document(scene, target).write(); });
  } catch (const NotFinite& error) {
    scene::refuse_at(scene, "",
                     std::string("too large for MuJoCo, the scene's numbers give ") + error.what());
  }
}

}  // namespace rotorub
