// Rotors in geometry form, built in code.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "native_model/linear/campbell.h"
#include "native_model/rotor/shaft_basis.h"
#include "native_model/scene/scene.h"
#include "tests/support/oracles/shafts.h"

namespace rotorub::test {

// A scene around a shaft, without contact and drive.
inline scene::Scene scene_of(const scene::RotorGeometry& geometry) {
  scene::Scene s;
  s.name = "rotor";
  s.rotor.geometry = geometry;
  return s;
}

inline void add_contact(scene::Scene& s, double station) {
  scene::Contact contact;
  contact.radius = 0.02;
  contact.clearance = 0.5e-3;
  contact.station = station;
  s.first().contact = contact;
}

// 1 m x 50 mm.
inline constexpr oracle::RayleighShaft kShaft{
    .length = 1.0, .diameter = 0.05, .inner_diameter = 0.0, .E = 2.1e11, .rho = 7850.0};

// N/m: rigid pins, but for a relative error of 2 E I lambda^2 / (k L), 5e-13 n^2 for this shaft.
inline constexpr double kPin = 1e19;

inline scene::RotorGeometry pinned_shaft(int modes, const oracle::RayleighShaft& shaft = kShaft) {
  scene::RotorGeometry g;
  g.length = shaft.length;
  g.E = shaft.E;
  g.G = shaft.E / 2.6;
  g.rho = shaft.rho;
  g.modes = modes;
  g.sections = {{.from = 0.0,
                 .to = shaft.length,
                 .diameter = shaft.diameter,
                 .inner_diameter = shaft.inner_diameter}};
  g.bearings = {{.z = 0.0, .stiffness = {kPin, kPin}},
                {.z = shaft.length, .stiffness = {kPin, kPin}}};
  return g;
}

// The end of a Timoshenko shaft like kShaft without a moment at its ends, in a symmetric motion of
// the frequency w (rad/s): u = a cos(p s) + b cosh(q s), with s from the middle. Shear force and
// deflection have a common factor; they balance at the frequencies of the shaft on its ends.
struct SymmetricEnd {
  double force, deflection;
};
inline SymmetricEnd symmetric_end(const scene::RotorGeometry& g, double w) {
  const double kG = cowper_coefficient(0.3, 0.0) * g.G, A = kShaft.area(), I = kShaft.inertia();
  const double inertia = g.rho * w * w, half = 0.5 * g.length;
  const double mean = 0.5 * inertia * (1.0 / g.E + 1.0 / kG);
  const double root =
      std::sqrt(std::pow(0.5 * inertia * (1.0 / g.E - 1.0 / kG), 2) + inertia * A / (g.E * I));
  const double p = std::sqrt(root + mean), q = std::sqrt(root - mean), shear = inertia / kG;
  const double a = (q * q + shear) * std::cosh(q * half);
  const double b = -(shear - p * p) * std::cos(p * half);
  return {inertia * A * (a * std::sin(p * half) / p + b * std::sinh(q * half) / q),
          a * std::cos(p * half) + b * std::cosh(q * half)};
}

// The rig of the shipped paper scenes.
inline scene::Scene reference_rig() {
  scene::RotorGeometry g;
  g.length = 0.6;
  g.E = 2.1e11;
  g.G = 2.1e11 / 2.6;
  g.rho = 7850.0;
  g.modes = 3;
  g.damping_ratio = 0.01;
  g.sections = {{.from = 0.0, .to = 0.6, .diameter = 0.018}};
  g.discs = {{.z = 0.3, .mass = 2.0, .Jt = 1.8e-3, .Jp = 3.6e-3, .eccentricity = 20e-6}};
  g.bearings = {{.z = 0.03, .stiffness = {2e7, 2e7}}, {.z = 0.57, .stiffness = {2e7, 2e7}}};
  scene::Scene s = scene_of(g);
  add_contact(s, 0.24);
  return s;
}

// Softer in y than in x at one bearing.
inline scene::Scene anisotropic_rotor() {
  scene::Scene s = scene_of(oracle::friswell_rotor());
  s.rotor.geometry->bearings[1].stiffness = {1e6, 0.6e6};
  return s;
}

// Distance to the nearest frequency of the spectrum, relative.
inline double miss(const WhirlSpectrum& spectrum, double frequency) {
  double least = std::numeric_limits<double>::infinity();
  for (const WhirlMode& mode : spectrum.modes) {
    least = std::min(least, std::abs(mode.frequency / frequency - 1.0));
  }
  return least;
}

// One mode in each plane.
inline scene::Scene jeffcott(double mass, double stiffness, double damping) {
  scene::Scene s;
  scene::RotorModal modal;
  modal.mass = {mass};
  modal.stiffness = {stiffness};
  modal.damping = {damping};
  s.rotor.modal = modal;
  return s;
}

// How right frequencies are, relative.

inline constexpr double kBeam = 1e-7;   // what beam frequencies must be right to
inline constexpr double kTight = 1e-9;  // closed forms in few modes

}  // namespace rotorub::test
