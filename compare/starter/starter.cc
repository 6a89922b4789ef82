#include "compare/starter/starter.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "compare/starter/starter_text.h"
#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/text.h"

namespace rotorub {
namespace {

using std::numbers::pi;

constexpr double kYoung = 210e9, kDensity = 7850.0;  // steel

// Rounds to a few significant digits, as a person would.
double rounded(double value, int digits) {
  return std::strtod(scene::number_text(value, digits).c_str(), nullptr);
}

// The largest of ..., 1, 2, 5, 10, ... that does not exceed the value.
double rounded_down(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  const double lead = value / decade;
  return rounded(decade * (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0), 1);
}

// Positions relative to the shaft's length.
struct Stations {
  double first_bearing, last_bearing, contact, disc;
};

Stations stations_of(StarterForm form) {
  if (form == StarterForm::kOverhung) return {0.05, 0.65, 0.8, 0.95};
  if (form == StarterForm::kVertical) return {0.05, 0.55, 0.8, 0.95};
  if (form == StarterForm::kTwoCatchers) return {0.2, 0.8, 0.1, 0.5};
  return {0.05, 0.95, 0.4, 0.5};
}

// The net stiffness of each magnetic bearing is a tenth of the shaft's, with a damping ratio of
// 0.3; its current also compensates a negative stiffness half as large. The gyroscopic effect turns
// the tilting of a fast rotor into a slow precession that decays at k d / (d^2 + (J_p Omega)^2).
// The integral term reduces this by k_i / k, which is limited to half of it.
void size_magnets(const Starter& starter, double shaft_stiffness, StarterSizes& s) {
  const double net = 0.1 * shaft_stiffness, mass = 0.5 * s.modal_mass;
  const double arm = 0.5 * (s.last_bearing - s.first_bearing), tilt = 2.0 * net * arm * arm,
               damping = 1.2 * std::sqrt(net * mass) * arm * arm,
               spin = (s.disc_Jp + 2.0 * s.sleeve_Jp) * starter.speed.value;
  const double damped = tilt * damping / (damping * damping + spin * spin);
  s.negative_stiffness = rounded(0.5 * net, 2);
  s.force_per_current = rounded(mass * 9.81, 2);
  s.proportional = rounded((net + s.negative_stiffness) / s.force_per_current, 2);
  s.integral =
      rounded(net * std::min(0.1 * std::sqrt(net / mass), 0.5 * damped) / s.force_per_current, 2);
  s.derivative = rounded(0.6 * std::sqrt(net * mass) / s.force_per_current, 2);
}

StarterSizes sizes_of(const Starter& starter) {
  const double L = starter.length.value, d = starter.diameter.value, m = starter.disc_mass.value;
  const double omega = starter.speed.value, turn = 2.0 * pi / omega;
  StarterSizes s;
  s.end = rounded(25.0 * turn, 2);
  s.on = rounded(5.0 * turn, 2);

  // Shaft and bearings.
  const double shaft_stiffness = 48.0 * kYoung * pi * std::pow(d, 4) / 64.0 / std::pow(L, 3);
  s.bearing_stiffness = rounded(80.0 * shaft_stiffness, 1);
  const Stations at = stations_of(starter.form);
  s.first_bearing = rounded(at.first_bearing * L, 4);
  s.last_bearing = rounded(at.last_bearing * L, 4);
  s.contact_station = rounded(at.contact * L, 4);
  s.disc_station = rounded(at.disc * L, 4);
  s.exciter_station = rounded(0.7 * L, 4);
  s.second_contact = rounded((1.0 - at.contact) * L, 4);

  // A steel disc with a width of a third of its radius, but not smaller than the shaft.
  const double R = std::max(std::cbrt(3.0 * m / (pi * kDensity)), 0.75 * d);
  const double width = m / (kDensity * pi * R * R);
  s.disc_Jp = rounded(m * R * R / 2.0, 3);
  s.disc_Jt = rounded(m * (3.0 * R * R + width * width) / 12.0, 3);

  // The steel sleeve at the contact, with a length of 1.4 d.
  s.radius = rounded(d / 0.9, 3);
  const double sum = s.radius * s.radius + d * d / 4.0, l = 1.4 * d;
  const double ring_area = pi * (s.radius * s.radius - d * d / 4.0);
  s.sleeve_mass = rounded(kDensity * ring_area * l, 3);
  s.sleeve_Jp = rounded(s.sleeve_mass * sum / 2.0, 3);
  s.sleeve_Jt = rounded(s.sleeve_mass * (3.0 * sum + l * l) / 12.0, 3);

  // One mode: the disc and, after Rayleigh, 17/35 of the shaft's mass.
  const double shaft_mass = kDensity * pi * d * d / 4.0 * L;
  s.modal_mass = rounded(m + 17.0 / 35.0 * shaft_mass, 4);
  s.modal_stiffness = rounded(shaft_stiffness, 4);
  s.modal_damping = rounded(2.0 * 0.01 * std::sqrt(s.modal_mass * s.modal_stiffness), 3);
  size_magnets(starter, shaft_stiffness, s);

  // The ring: three quarters of the disc's mass, a natural frequency slightly above the speed, and
  // a damping ratio of 0.27.
  s.ring_mass = rounded(0.75 * m, 3);
  s.ring_stiffness = rounded(1.35 * s.ring_mass * omega * omega, 2);
  if (starter.form == StarterForm::kTwoCatchers) {
    // Its own weight, which the other forms lack, must not lower it by more than this.
    constexpr double kSag = 0.2;  // relative to the clearance
    const double weight = 9.81 * s.ring_mass;
    s.ring_stiffness =
        std::max(s.ring_stiffness, rounded(weight / (kSag * starter.clearance.value), 2));
  }
  s.ring_damping = rounded(0.54 * std::sqrt(s.ring_mass * s.ring_stiffness), 2);

  // The motor: half the disc's inertia, and a gain that restores the speed within about half a turn
  // (time constant 3.5 / omega).
  s.motor_inertia = rounded(0.5 * s.disc_Jp, 2);
  s.motor_gain = rounded((s.disc_Jp + s.motor_inertia) * omega / 3.5, 2);
  s.step = rounded_down(turn / 2000.0);
  return s;
}

scene::Scene read_back(const Starter& starter, const StarterSizes& sizes) {
  return scene::parse_scene(starter_text(starter, sizes), starter.file);
}

// m: position of the contact point on the free orbit at t = 0.
Eigen::Vector2d on_orbit(const Starter& starter, StarterSizes sizes) {
  // All loads act from the beginning, but magnetic bearings that fail do so later.
  if (starter.form != StarterForm::kTwoCatchers) sizes.on = 0.0;
  const Model model = prepare(read_back(starter, sizes));
  const int n = model.layout.modes;
  return {model.first().shape.x.dot(model.q0.segment(model.layout.x(), n)),
          model.first().shape.y.dot(model.q0.segment(model.layout.y(), n))};
}

// rad/s
double highest_frequency(const Model& model) {
  double highest = 0.0;
  for (int i = 0; i < model.layout.mechanical(); ++i) {
    if (model.mass[i] > 0.0) highest = std::max(highest, model.stiffness[i] / model.mass[i]);
  }
  return std::sqrt(highest);
}

[[noreturn]] void refuse(const Starter& starter, const std::string& reason) {
  throw scene::SceneError({{starter.file, 0, {}, reason}});
}

}  // namespace

std::string starter_scene(const Starter& starter) {
  StarterSizes sizes = sizes_of(starter);
  // The response is linear, so it can be scaled from one too small to touch to the desired size.
  constexpr double kSmall = 1e-9;
  const double clearance = starter.clearance.value, mass = starter.disc_mass.value;
  const auto answer = [&](double unbalance, double load) {
    StarterSizes probe = sizes;
    probe.eccentricity = probe.load = 0.0;
    const Eigen::Vector2d sag = on_orbit(starter, probe);
    probe.eccentricity = unbalance;
    probe.load = load;
    const double size = (on_orbit(starter, probe) - sag).norm();
    if (!(size > 0.0) || !std::isfinite(size))
      refuse(starter, "no load moves this rotor at the contact");
    return size;
  };
  const double small = kSmall * clearance;
  const double by_eccentricity = answer(small, 0.0) / small;
  sizes.eccentricity = rounded(0.1 * clearance / by_eccentricity, 2);
  // The unbalance of a machine with this orbit must not exceed the usual grade.
  const double usual =
      kBalanceQuality / starter.speed.value * (starter.form == StarterForm::kModal ? mass : 1.0);
  sizes.is_graded = sizes.eccentricity > usual;
  if (sizes.is_graded) sizes.eccentricity = rounded(usual, 2);
  if (starter.form != StarterForm::kTwoCatchers) {
    const bool rig = is_rig(starter.form);
    const double small_load = rig ? small * sizes.modal_stiffness : small * mass;
    const double by_load = answer(0.0, small_load) / small_load;
    sizes.load = starter.unbalance ? starter.unbalance->value
                                   : rounded((rig ? 4.0 : 2.0) * clearance / by_load, 2);
    sizes.load_orbit = sizes.load * by_load / clearance;
    sizes.force_limit = rounded(4.0 * sizes.load, 2);
  }
  sizes.step = std::min(
      sizes.step,
      rounded_down(2.0 * pi / highest_frequency(prepare(read_back(starter, sizes))) / 38.0));
  read_back(starter, sizes);
  return starter_text(starter, sizes);
}

}  // namespace rotorub
