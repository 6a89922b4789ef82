// The segment rotor of a generated MJCF: a chain of rigid segments (native_model/rotor/
// segment_chain.h) whose gyroscopics, unbalance and weight are MuJoCo's own rigid-body dynamics.
//
// Each segment is two bodies. The carrier does not spin: it tilts against the one before about two
// hinges with the beam's bending stiffness, so that springs and dampers act in the inertial frame.
// On it turns the rotor proper, about the carrier's z axis, with the mass and the inertia of its
// piece of shaft and with the discs there. Tendons are the torsion springs between neighbours, and
// the bearings: lengths that are linear in the joints.
#pragma once

#include <Eigen/Core>

#include "mjcf/xml.h"
#include "native_model/model/model.h"
#include "native_model/rotor/segment_chain.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// An armature that holds the spin of a rotor without a drive: this many times its inertia. A
// friction torque that would stop the free rotor in a millisecond changes the speed by 1e-7 of it
// in a second.
inline constexpr double kHeldInertia = 1e10;

class SegmentRotor {
 public:
  // Throws scene::SceneError as segment_chain, and for a disc that is no rigid body.
  SegmentRotor(const scene::Scene& scene, const Model& model);

  void write_bodies(XmlWriter& xml) const;   // into <worldbody>
  void write_tendons(XmlWriter& xml) const;  // into <tendon>

  // The start, in the order of MuJoCo's coordinates: without those of the ring.
  Eigen::VectorXd start_position() const;
  Eigen::VectorXd start_velocity() const;

 private:
  void write_carrier(XmlWriter& xml, std::size_t k) const;
  void write_spinning(XmlWriter& xml, std::size_t k) const;
  void write_bearing(XmlWriter& xml, std::size_t index) const;
  // A state of the modes in the order of MuJoCo's coordinates.
  Eigen::VectorXd of_nodes(const Eigen::VectorXd& modal, double rigid_spin) const;

  const scene::Scene& scene_;
  const Model& model_;
  SegmentChain chain_;
  SegmentMatrices matrices_;
};

}  // namespace rotorub
