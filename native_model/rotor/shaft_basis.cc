#include "native_model/rotor/shaft_basis.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/scene.h"

namespace rotorub {
namespace {

constexpr double kLongestElement = 4.0;  // largest k h of an element
constexpr int kMostFunctions = 1500;     // dense matrices of more functions take minutes
constexpr int kFewestFunctions = 4;

// Number of functions for a wave sin(k z). Its Legendre coefficient of order n is about
// a^n / (2 n + 1)!!, a = k h / 2, and the error of a Ritz frequency is the square of the first
// omitted coefficient. One more function is kept because the error of mode values at stations is
// the coefficient itself.
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
        "needs modes so high that the shaft has more than " + std::to_string(kMostFunctions) +
            " shape functions; keep fewer modes, or lower max_frequency"}});
}

// On a cone the solution is a wave times a factor from the change of the section. Elements are so
// short that neither the diameter nor the wall changes by more than this share within one. The tip
// of the cone, where I = 0, is then at least 2 / kMostTaper + 1 = 9 half lengths from the middle,
// and each Legendre coefficient is 9 + sqrt(80) = 18 times smaller than the one before.
constexpr double kMostTaper = 0.25;
constexpr int kTaperFunctions = 6;

// Number of parts into which a span of a section must be cut so that kMostTaper holds.
double taper_parts(const scene::ShaftSection& section, double from, double to) {
  if (!section.tapered()) return 1.0;
  const auto parts = [](double a, double b) {
    return std::ceil(std::abs(a - b) / (kMostTaper * std::min(a, b)));
  };
  const auto wall = [&](double z) { return section.outer_at(z) - section.inner_at(z); };
  return std::max(
      {1.0, parts(section.outer_at(from), section.outer_at(to)), parts(wall(from), wall(to))});
}

// P_0 .. P_{count-1} by (n + 1) P_{n+1} = (2 n + 1) xi P_n - n P_{n-1}.
Eigen::VectorXd legendre(int count, double xi) {
  Eigen::VectorXd p(count);
  p[0] = 1.0;
  if (count > 1) p[1] = xi;
  for (int n = 1; n + 1 < count; ++n) {
    p[n + 1] = ((2 * n + 1) * xi * p[n] - n * p[n - 1]) / (n + 1);
  }
  return p;
}

}  // namespace

std::string numbered(const char* name, std::size_t index, std::size_t count) {
  return count == 1 ? std::string(name) : std::string(name) + " " + std::to_string(index + 1);
}

std::vector<Station> stations_of(const scene::Scene& scene) {
  std::vector<Station> stations;
  const auto add_all = [&](StationKind kind, const char* name, const auto& parts, auto z) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      stations.push_back({kind, numbered(name, i, parts.size()), parts[i].*z});
    }
  };
  const scene::RotorGeometry& geometry = *scene.rotor.geometry;
  add_all(StationKind::kBearing, "bearing", geometry.bearings, &scene::ShaftBearing::z);
  add_all(StationKind::kDisc, "disc", geometry.discs, &scene::Disc::z);
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    const auto& contact = scene.auxiliary[k].contact;
    const std::string name = scene.auxiliary.size() > 1 ? "contact " + scene.name_of(k) : "contact";
    if (contact) stations.push_back({StationKind::kContact, name, contact->station});
  }
  if (scene.drive) stations.push_back({StationKind::kDrive, "drive", scene.drive->station});
  add_all(StationKind::kMagneticBearing, "magnetic bearing", scene.magnetic_bearings,
          &scene::MagneticBearing::station);
  const auto& magnets = scene.magnetic_bearings;
  for (std::size_t k = 0; k < magnets.size(); ++k) {
    if (!magnets[k].sensor_station) continue;
    stations.push_back({StationKind::kMagneticBearing, numbered("sensor", k, magnets.size()),
                        *magnets[k].sensor_station});
  }
  add_all(StationKind::kForce, "force", scene.forces, &scene::Force::station);
  return stations;
}

double ShaftElement::area(double z) const {
  const double outer = section.outer_at(z), inner = section.inner_at(z);
  return std::numbers::pi / 4.0 * (outer * outer - inner * inner);
}

double ShaftElement::inertia(double z) const {
  const double o2 = section.outer_at(z) * section.outer_at(z),
               i2 = section.inner_at(z) * section.inner_at(z);
  return std::numbers::pi / 64.0 * (o2 * o2 - i2 * i2);
}

double cowper_coefficient(double nu, double ratio) {
  const double m2 = ratio * ratio, one = (1.0 + m2) * (1.0 + m2);
  return 6.0 * (1.0 + nu) * one / ((7.0 + 6.0 * nu) * one + (20.0 + 12.0 * nu) * m2);
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

    // The section's ends and the stations between them.
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
  for (const ShaftElement& element : mesh) count += element.all_functions();
  return count;
}

LegendreValues integrated_legendre(int count, double xi) {
  assert(count >= 1 && xi >= -1.0 && xi <= 1.0);
  const Eigen::VectorXd p = legendre(count + 2, xi);

  // int P_n = (P_{n+1} - P_{n-1}) / (2 n + 1); one more than requested, for the second integral.
  Eigen::VectorXd first(count + 1);
  first[0] = 1.0 + xi;
  for (int n = 1; n <= count; ++n) first[n] = (p[n + 1] - p[n - 1]) / (2 * n + 1);

  // The same identity again. For n = 0 and n = 1 some terms do not vanish at -1.
  Eigen::VectorXd second(count);
  second[0] = 0.5 * (1.0 + xi) * (1.0 + xi);
  if (count > 1) second[1] = (first[2] - first[0]) / 3.0;
  for (int n = 2; n < count; ++n) second[n] = (first[n + 1] - first[n - 1]) / (2 * n + 1);

  return {p.head(count), first.head(count), second};
}

GaussRule gauss_legendre(int n) {
  assert(n >= 1);
  constexpr int kNewtonSteps = 8;  // converges quadratically from 1e-3: 5 steps reach round-off
  GaussRule rule{Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (int i = 0; i < n; ++i) {
    // Newton with (1 - x^2) P_n' = n (P_{n-1} - x P_n), from Tricomi's estimate of the i-th root.
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    double slope = 0.0;
    for (int step = 0; step < kNewtonSteps; ++step) {
      const Eigen::VectorXd p = legendre(n + 1, x);
      slope = n * (p[n - 1] - x * p[n]) / (1.0 - x * x);
      x -= p[n] / slope;
    }
    rule.node[i] = x;
    rule.weight[i] = 2.0 / ((1.0 - x * x) * slope * slope);
  }
  return rule;
}

}  // namespace rotorub
