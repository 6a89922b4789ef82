#include "native_model/trajectory/range_check.h"

#include <cmath>

#include "native_model/bearing/actuator_axes.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/scene/text.h"

namespace rotorub {
namespace {

std::string text(double value) { return scene::number_text(value, 3); }

}  // namespace

std::optional<std::string> out_of_range(const Model& m, const double* q) {
  return out_of_range(m, q, m.contact ? m.contact->clearance : 0.0);
}

std::optional<std::string> out_of_range(const Model& m, const double* q, double depth) {
  if (m.magnets && m.layout.stator) {
    const double reach = m.magnets->law->reach();
    const double s = to_axes(stator_point(m, q)).cwiseAbs().maxCoeff();
    if (s >= reach) {
      return "the ring is " + text(s) +
             " m from its middle along a magnet's axis, in an air gap of " + text(reach) + " m";
    }
  }
  if (m.contact) {
    const double clearance = m.contact->clearance;
    const double square = (separation(m, q)).squaredNorm();
    if (square > (clearance + depth) * (clearance + depth)) {
      return "the rotor is " + text(std::sqrt(square) - clearance) +
             " m deep in the ring, with a clearance of " + text(clearance) + " m";
    }
  }
  return {};
}

}  // namespace rotorub
