// The segment rotor of a generated MJCF: a chain of rigid segments (native_model/rotor/
// segment_chain.h). MuJoCo's own rigid-body dynamics supply its gyroscopics, unbalance and weight.
//
// Each segment consists of two bodies. The carrier does not spin. It tilts relative to the previous
// one about two hinges with the beam's bending stiffness, so that springs and dampers act in the
// inertial frame. The spinning body turns about the carrier's z axis and has the mass and inertia
// of its piece of shaft and of the discs on it. The torsion springs between neighbours and the
// bearings are tendons, whose lengths are linear in the joint coordinates.
#pragma once

#include <Eigen/Core>

#include "mjcf/xml.h"
#include "native_model/model/model.h"
#include "native_model/rotor/segment_chain.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// Ratio of the armature to the rotor's inertia that holds the spin of a rotor without a drive. A
// friction torque that would stop the free rotor in a millisecond changes the speed by 1e-7 of it
// in a second.
inline constexpr double kHeldInertia = 1e10;

class SegmentRotor {
 public:
  // Throws scene::SceneError as segment_chain does, and for a disc that no rigid body can be.
  SegmentRotor(const scene::Scene& scene, const Model& model);

  void write_bodies(XmlWriter& xml) const;   // into <worldbody>
  void write_tendons(XmlWriter& xml) const;  // into <tendon>

  // The initial state in the order of MuJoCo's coordinates, without the rings.
  Eigen::VectorXd start_position() const;
  Eigen::VectorXd start_velocity() const;

 private:
  void write_carrier(XmlWriter& xml, std::size_t k) const;
  void write_spinning(XmlWriter& xml, std::size_t k) const;
  void write_bearing(XmlWriter& xml, std::size_t index) const;
  // Converts a modal state to the order of MuJoCo's coordinates.
  Eigen::VectorXd of_nodes(const Eigen::VectorXd& modal, double rigid_spin) const;

  const scene::Scene& scene_;
  const Model& model_;
  SegmentChain chain_;
  SegmentMatrices matrices_;
};

}  // namespace rotorub
