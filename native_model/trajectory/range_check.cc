#include "native_model/trajectory/range_check.h"

#include <algorithm>
#include <cmath>

#include "native_model/bearing/actuator.h"
#include "native_model/model/dynamics.h"
#include "native_model/scene/text.h"

namespace rotorub {
namespace {

std::string text(double value) { return scene::number_text(value, 3); }

// Why the rotor has left, without the time, which the caller adds.
std::string left(const Model& m) {
  constexpr const char* kRotor = "the rotor has left, because ";
  if (!m.feedbacks.empty())
    return std::string(kRotor) +
           "the magnetic bearings do not hold it (`rotorub modes` prints their poles)";
  if (!m.has_contact()) return std::string(kRotor) + "neither a ring nor anything else holds it";
  return std::string(kRotor) +
         "its motion grows without bound (`rotorub modes` says if it is unstable; a fixed step may "
         "be too long)";
}

std::optional<std::string> rotor_out_of_range(const Model& m, const double* q, const double* v) {
  for (int i = 0; i < 2 * m.layout.modes; ++i) {
    if (std::abs(q[i]) >= m.reach) {
      return left(m) + "; a bending mode is at " + text(q[i]) + " m, beyond " + text(m.reach) +
             " m";
    }
    if (std::abs(v[i]) >= kFastestBending)
      return left(m) + "; a bending mode moves at " + text(v[i]) + " m/s";
  }
  return {};
}

}  // namespace

std::optional<std::string> out_of_range(const Model& m, const double* q, const double* v,
                                        RingDepth limit) {
  for (std::size_t k = 0; k < m.auxiliary.size(); ++k) {
    const AuxiliaryBearing& at = m.auxiliary[k];
    const auto ring = [&] {
      return m.auxiliary.size() > 1 ? "ring " + at.name : std::string("ring");
    };
    if (at.magnets && at.moves()) {
      const double reach = at.magnets->law->reach();
      const double s = to_axes(stator_point(m, q, k)).cwiseAbs().maxCoeff();
      if (s >= reach) {
        return "the " + ring() + " is " + text(s) +
               " m from its middle along a magnet's axis, in an air gap of " + text(reach) + " m";
      }
    }
    for (const StationSupport& s : m.supports) {
      if (s.ring != at.ring || !s.law.film) continue;
      const Eigen::Vector2d housing = s.housing == kAbsent
                                          ? Eigen::Vector2d(0.0, 0.0)
                                          : Eigen::Vector2d(q[s.housing], q[s.housing + 1]);
      const double distance = (stator_point(m, q, k) - housing).norm();
      if (distance >= SqueezeFilmLaw::kReach * s.law.film->clearance()) {
        return "the " + ring() + " is " + text(distance) +
               " m from the middle of its squeeze film, of a clearance of " +
               text(s.law.film->clearance()) + " m";
      }
    }
    if (!at.contact) continue;
    const double clearance = at.contact->clearance;
    const double depth =
        limit == RingDepth::kThickness ? std::max(clearance, at.contact->radius) : clearance;
    const double square = separation(m, q, k).squaredNorm();
    if (square > (clearance + depth) * (clearance + depth)) {
      return "the rotor is " + text(std::sqrt(square) - clearance) + " m deep in the " + ring() +
             ", with a clearance of " + text(clearance) + " m";
    }
  }
  return rotor_out_of_range(m, q, v);
}

}  // namespace rotorub
