#include "mjcf/ghosts.h"

#include <fmt/format.h>

#include "mjcf/bodies.h"
#include "mjcf/names.h"
#include "native_model/dynamics/dynamics.h"

namespace rotorub {
namespace {

namespace names = mjcf_names;

// Wafers over the drawn faces, in terms of the disc's radius: the rotor's face is at 0.15 and its
// mark ends at 0.1575, the ring's face is at 0.135.
constexpr double kOverRotor = 0.165, kOverRing = 0.142, kHalf = 0.003;

void write_ghost(XmlWriter& xml, const char* name, const Eigen::Vector3d& at, double radius,
                 double half, const char* colour) {
  xml.open(
      fmt::format(R"(<body name="{}" mocap="true" pos="{} {} {}">)", name, at.x(), at.y(), at.z()));
  xml.line(fmt::format(R"(<geom name="{}" type="cylinder" size="{} {}" mass="0" contype="0" )"
                       R"(conaffinity="0" group="1" rgba="{}"/>)",
                       name, radius, half, colour));
  xml.close("body");
}

}  // namespace

void write_ghosts(XmlWriter& xml, const scene::Scene& scene, const Model& model) {
  const double r = drawn_radius(scene);
  const auto over = [](const Eigen::Vector2d& centre, double z) {
    return Eigen::Vector3d(centre.x(), centre.y(), z);
  };
  write_ghost(xml, names::kGhostRotor, over(rotor_point(model, model.q0.data()), kOverRotor * r), r,
              kHalf * r, "0.95 0.6 0.1 0.3");
  if (!model.layout.stator) return;
  const double clearance = scene.first().contact ? scene.first().contact->clearance : 0.0;
  write_ghost(xml, names::kGhostRing, over(ring_centre(model, model.q0.data()), kOverRing * r),
              r + clearance, kHalf * r, "0.95 0.6 0.1 0.15");
}

}  // namespace rotorub
