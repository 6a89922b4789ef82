#include "native_model/rotor/shaft_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "native_model/scene/diagnostic.h"

namespace rotorub {
namespace {

constexpr double kLongestElement = 4.0;  // k h
constexpr int kMostFunctions = 1500;     // dense matrices beyond this take minutes
constexpr int kFewestFunctions = 4;

// Functions needed for a wave sin(k z): its Legendre coefficient of order n is about
// a^n / (2 n + 1)!!, a = k h / 2; the error of a Ritz frequency is the square of the first one
// left out. One more is kept, because mode values at stations err by the coefficient itself.
int functions_needed(double wave_length_ratio) {
  constexpr double kLeftOut = 1e-8;
  const double a = 0.5 * wave_length_ratio;
  double coefficient = 1.0;
  int n = 0;
  while (coefficient > kLeftOut) {
    ++n;
    coefficient *= a / (2 * n + 1);
  }
  return std::max(n + 1, kFewestFunctions);
}

[[noreturn]] void refuse_size() {
  throw scene::SceneError(
      {{"", 0, "rotor",
        "asks for modes so high that the shaft needs more than " + std::to_string(kMostFunctions) +
            " shape functions; accepted: fewer modes, or a lower "
            "max_frequency"}});
}

// On a cone the solution is a wave times what the section's change makes of it. Elements are so
// short that neither diameter nor wall changes by more than this share in one: the cone's tip,
// where I = 0, is 2 / kMostTaper + 1 = 9 half lengths away from the middle, and Legendre
// coefficients fall by 9 + sqrt(80) = 18 each.
constexpr double kMostTaper = 0.25;
constexpr int kTaperFunctions = 6;

// Into how many parts a span of a section must be cut for that.
double taper_parts(const scene::ShaftSection& section, double from, double to) {
  if (!section.tapered()) return 1.0;
  const auto parts = [](double a, double b) {
    return std::ceil(std::abs(a - b) / (kMostTaper * std::min(a, b)));
  };
  const auto wall = [&](double z) { return section.outer_at(z) - section.inner_at(z); };
  return std::max(
      {1.0, parts(section.outer_at(from), section.outer_at(to)), parts(wall(from), wall(to))});
}

}  // namespace

double ShaftElement::area(double z) const {
  const double outer = section.outer_at(z), inner = section.inner_at(z);
  return std::numbers::pi / 4.0 * (outer * outer - inner * inner);
}

double ShaftElement::inertia(double z) const {
  const double o2 = section.outer_at(z) * section.outer_at(z),
               i2 = section.inner_at(z) * section.inner_at(z);
  return std::numbers::pi / 64.0 * (o2 * o2 - i2 * i2);
}

std::vector<ShaftElement> shaft_mesh(
    const scene::RotorGeometry& geometry, std::vector<double> stations,
    const std::function<double(const ShaftElement&)>& wave_number) {
  assert(!geometry.sections.empty());
  std::sort(stations.begin(), stations.end());

  std::vector<ShaftElement> mesh;
  for (const scene::ShaftSection& section : geometry.sections) {
    const ShaftElement whole{section.from, section.to, section};
    const double k = wave_number(whole);

    // The section's own ends and the stations inside it.
    std::vector<double> cuts{section.from};
    for (double z : stations) {
      if (z > cuts.back() && z < section.to) cuts.push_back(z);
    }
    cuts.push_back(section.to);

    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double span = cuts[i + 1] - cuts[i];
      const double parts = std::max(taper_parts(section, cuts[i], cuts[i + 1]),
                                    std::ceil(k * span / kLongestElement));
      if (!(parts < kMostFunctions)) refuse_size();
      const int count = static_cast<int>(parts);
      for (int part = 0; part < count; ++part) {
        ShaftElement element = whole;
        element.from = cuts[i] + span * part / count;
        element.to = part + 1 == count ? cuts[i + 1] : cuts[i] + span * (part + 1) / count;
        element.functions =
            functions_needed(k * element.length()) + (section.tapered() ? kTaperFunctions : 0);
        mesh.push_back(element);
      }
    }
  }
  if (function_count(mesh) > kMostFunctions) refuse_size();
  return mesh;
}

int function_count(const std::vector<ShaftElement>& mesh) {
  int count = 0;
  for (const ShaftElement& element : mesh) count += element.functions;
  return count;
}

const ShaftElement& element_at(const std::vector<ShaftElement>& mesh, double z) {
  const auto found = std::lower_bound(mesh.begin(), mesh.end(), z,
                                      [](const ShaftElement& e, double at) { return e.to < at; });
  return found == mesh.end() ? mesh.back() : *found;
}

}  // namespace rotorub
