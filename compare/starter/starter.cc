#include "compare/starter/starter.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "compare/starter/starter_text.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/text.h"
#include "native_model/system/model.h"

namespace rotorub {
namespace {

using std::numbers::pi;

constexpr double kYoung = 210e9, kDensity = 7850.0;  // steel

// To a few significant digits: what a person would write.
double rounded(double value, int digits) {
  return std::strtod(scene::number_text(value, digits).c_str(), nullptr);
}

// The largest of ..., 1, 2, 5, 10, ... that is not above the value.
double rounded_down(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  const double lead = value / decade;
  return rounded(decade * (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0), 1);
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
  s.first_bearing = rounded(0.05 * L, 4);
  s.last_bearing = rounded(0.95 * L, 4);
  s.contact_station = rounded(0.4 * L, 4);
  s.disc_station = rounded(0.5 * L, 4);
  s.exciter_station = rounded(0.7 * L, 4);

  // A steel disc a third as wide as its radius, but never smaller than the shaft.
  const double R = std::max(std::cbrt(3.0 * m / (pi * kDensity)), 0.75 * d);
  const double width = m / (kDensity * pi * R * R);
  s.disc_Jp = rounded(m * R * R / 2.0, 3);
  s.disc_Jt = rounded(m * (3.0 * R * R + width * width) / 12.0, 3);

  // The sleeve at the contact, of steel: 1.4 d long.
  s.radius = rounded(d / 0.9, 3);
  const double sum = s.radius * s.radius + d * d / 4.0, l = 1.4 * d;
  const double ring_area = pi * (s.radius * s.radius - d * d / 4.0);
  s.sleeve_mass = rounded(kDensity * ring_area * l, 3);
  s.sleeve_Jp = rounded(s.sleeve_mass * sum / 2.0, 3);
  s.sleeve_Jt = rounded(s.sleeve_mass * (3.0 * sum + l * l) / 12.0, 3);

  // One mode: the disc and, by Rayleigh, 17/35 of the shaft.
  const double shaft_mass = kDensity * pi * d * d / 4.0 * L;
  s.modal_mass = rounded(m + 17.0 / 35.0 * shaft_mass, 4);
  s.modal_stiffness = rounded(shaft_stiffness, 4);
  s.modal_damping = rounded(2.0 * 0.01 * std::sqrt(s.modal_mass * s.modal_stiffness), 3);

  // The ring: three quarters of the disc's mass, its own frequency a little above the speed,
  // damping ratio 0.27.
  s.ring_mass = rounded(0.75 * m, 3);
  s.ring_stiffness = rounded(1.35 * s.ring_mass * omega * omega, 2);
  s.ring_damping = rounded(0.54 * std::sqrt(s.ring_mass * s.ring_stiffness), 2);

  // The motor: half the disc's inertia, and a gain that keeps the speed within half a turn.
  s.motor_inertia = rounded(0.5 * s.disc_Jp, 2);
  s.motor_gain = rounded((s.disc_Jp + s.motor_inertia) * omega / 3.5, 2);
  s.step = rounded_down(turn / 2000.0);
  return s;
}

scene::Scene read_back(const Starter& starter, const StarterSizes& sizes) {
  return scene::parse_scene(starter_text(starter, sizes), starter.file);
}

// m: how far the contact point of the free orbit is from the centre at t = 0.
double orbit(const Starter& starter, StarterSizes sizes) {
  sizes.on = 0.0;  // all of the load acts from the beginning
  const Model model = make_model(read_back(starter, sizes));
  const int n = model.layout.modes;
  return std::hypot(model.first().shape.x.dot(model.q0.segment(model.layout.x(), n)),
                    model.first().shape.y.dot(model.q0.segment(model.layout.y(), n)));
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
  // A linear answer: from one so small that it cannot touch to one of the size that is wanted.
  constexpr double kSmall = 1e-9;
  const double clearance = starter.clearance.value, mass = starter.disc_mass.value;
  const auto answer = [&](double unbalance, double load) {
    StarterSizes probe = sizes;
    probe.eccentricity = unbalance;
    probe.load = load;
    const double size = orbit(starter, probe);
    if (!(size > 0.0) || !std::isfinite(size))
      refuse(starter, "no load moves this rotor at the contact");
    return size;
  };
  const double small = kSmall * clearance;
  const double by_eccentricity = answer(small, 0.0) / small;
  sizes.eccentricity = rounded(0.1 * clearance / by_eccentricity, 2);
  const bool rig = starter.form == StarterForm::kRig;
  const double small_load = rig ? small * sizes.modal_stiffness : small * mass;
  const double by_load = answer(0.0, small_load) / small_load;
  sizes.load = rounded((rig ? 4.0 : 2.0) * clearance / by_load, 2);
  sizes.force_limit = rounded(4.0 * sizes.load, 2);
  sizes.step = std::min(
      sizes.step,
      rounded_down(2.0 * pi / highest_frequency(make_model(read_back(starter, sizes))) / 38.0));
  read_back(starter, sizes);
  return starter_text(starter, sizes);
}

}  // namespace rotorub
