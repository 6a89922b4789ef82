#include "mjcf/ghosts.h"

#include <fmt/format.h>

#include "mjcf/bodies.h"
#include "mjcf/names.h"
#include "native_model/system/dynamics.h"

namespace rotorub {
namespace {

namespace names = mjcf_names;

// Half thickness over the disc's radius: of the rotor a little thicker than its own disc (0.15), of
// the ring between the two (0.135 its own), so that no two faces fall together.
constexpr double kRotorGhost = 0.155, kRingGhost = 0.14;

void write_ghost(XmlWriter& xml, const char* name, const Eigen::Vector2d& at, double radius,
                 double half, const char* colour) {
  xml.open(fmt::format(R"(<body name="{}" mocap="true" pos="{} {} 0">)", name, at.x(), at.y()));
  xml.line(fmt::format(R"(<geom name="{}" type="cylinder" size="{} {}" mass="0" contype="0" )"
                       R"(conaffinity="0" group="1" rgba="{}"/>)",
                       name, radius, half, colour));
  xml.close("body");
}

}  // namespace

void write_ghosts(XmlWriter& xml, const scene::Scene& scene, const Model& model) {
  const double r = drawn_radius(scene);
  write_ghost(xml, names::kGhostRotor, rotor_point(model, model.q0.data()), r, kRotorGhost * r,
              "0.95 0.6 0.1 0.4");
  if (!model.layout.stator) return;
  const double clearance = scene.contact ? scene.contact->clearance : 0.0;
  write_ghost(xml, names::kGhostRing, stator_point(model, model.q0.data()), r + clearance,
              kRingGhost * r, "0.95 0.6 0.1 0.15");
}

}  // namespace rotorub
