#include "native_model/rotor/mode_truncation.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "native_model/numerics/linear_solve.h"
#include "native_model/rotor/rotor_modes.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/scene.h"

namespace rotorub {

namespace {

// At the station z, m.
ContactMass contact_mass_at(const RotorModes& modes, double z) {
  const Eigen::RowVectorXd u = modes.ritz.basis.deflection(z);
  const auto of_kept = [&](const PlanarModes& plane) {
    return 1.0 / modal_sums(plane, u).mobility[modes.kept - 1];
  };
  ContactMass mass;
  mass.kept = std::min(of_kept(modes.x), of_kept(modes.y));
  mass.mesh = 1.0 / u.dot(Cholesky(modes.ritz.mass).solve(Eigen::VectorXd(u)));
  mass.kept_modes = modes.kept;
  mass.mesh_modes = static_cast<int>(u.size());
  return mass;
}

}  // namespace

std::optional<ContactMass> contact_mass(const scene::Scene& scene) {
  if (!scene.rotor.geometry) return {};
  std::optional<RotorModes> modes;
  std::optional<ContactMass> most;
  for (const scene::AuxiliaryBearing& at : scene.auxiliary) {
    if (!at.contact) continue;
    if (!modes) modes = rotor_modes(scene);
    const ContactMass mass = contact_mass_at(*modes, at.contact->station);
    if (!most || mass.ratio() > most->ratio()) most = mass;
  }
  return most;
}

namespace {

// A quantity that the kept modes must reproduce. It is a sum over modes, which rises to its value
// for all modes, or the inverse of such a sum, which falls.
struct Quantity {
  std::string name;
  Eigen::VectorXd sums;  // over the first k modes, k = 1 to N
  bool inverse = false;
  // Relative error with `kept` modes, compared with all modes.
  double left_out(int kept) const {
    const double of_all = sums[kept - 1] / sums[sums.size() - 1];
    if (!inverse) return 1.0 - of_all;
    return of_all > 0.0 ? 1.0 / of_all - 1.0 : std::numeric_limits<double>::infinity();
  }
};

struct Place {
  std::string name;
  double z;                 // m
  bool is_contact = false;  // its effective mass counts too
};

std::vector<Place> places(const scene::Scene& scene) {
  std::vector<Place> all;
  const auto add = [&](const char* what, std::size_t index, double z) {
    all.push_back({what + (" " + std::to_string(index + 1)), z});
  };
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    const auto& contact = scene.auxiliary[k].contact;
    if (!contact) continue;
    const bool several = scene.auxiliary.size() > 1;
    all.push_back(
        {several ? "contact " + scene.name_of(k) : "the contact", contact->station, true});
  }
  const auto& bearings = scene.rotor.geometry->bearings;
  for (std::size_t i = 0; i < bearings.size(); ++i) add("bearing", i, bearings[i].z);
  for (std::size_t i = 0; i < scene.forces.size(); ++i) add("force", i, scene.forces[i].station);
  const auto& magnets = scene.magnetic_bearings;
  for (std::size_t i = 0; i < magnets.size(); ++i) {
    if (magnets[i].sensor_station) add("sensor", i, *magnets[i].sensor_station);
    if (magnets.size() == 1) {
      all.push_back({"the magnetic bearing", magnets[i].station});
    } else {
      add("magnetic bearing", i, magnets[i].station);
    }
  }
  return all;
}

std::vector<Quantity> quantities(const scene::Scene& scene, const RotorModes& modes) {
  std::vector<Quantity> all;
  for (const Place& place : places(scene)) {
    const Eigen::RowVectorXd u = modes.ritz.basis.deflection(place.z);
    for (const PlanarModes* plane : {&modes.x, &modes.y}) {
      ModalSums sums = modal_sums(*plane, u);
      if (place.is_contact) {
        all.push_back({"the effective mass at " + place.name, std::move(sums.mobility), true});
      }
      all.push_back({"the static flexibility at " + place.name, std::move(sums.flexibility)});
      if (modes.ritz.isotropic) break;
    }
  }
  return all;
}

const Quantity& worst(const std::vector<Quantity>& all, int kept) {
  return *std::max_element(all.begin(), all.end(), [&](const Quantity& a, const Quantity& b) {
    return a.left_out(kept) < b.left_out(kept);
  });
}

// The least number of modes of one mesh within the tolerance. It exists because all modes together
// have no error.
int fewest_of(const std::vector<Quantity>& all, double tolerance) {
  int kept = 1;
  for (const Quantity& q : all) {
    while (q.left_out(kept) > tolerance) ++kept;
  }
  return kept;
}

std::string digits(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2g", value);
  return text.data();
}

// Throws SceneError. The mesh of `modes` would need more than kMostAutoModes modes; a finer mesh
// needs at least as many.
[[noreturn]] void refuse(const scene::Scene& scene, const RotorModes& modes) {
  const std::vector<Quantity> all = quantities(scene, modes);
  const Quantity& q = worst(all, kMostAutoModes);
  const double left = q.left_out(kMostAutoModes);
  const std::string most_modes = std::to_string(kMostAutoModes);
  std::string reason =
      "\"auto\" finds no number of modes up to " + most_modes + ": with " + most_modes + " " +
      q.name + " is still " + digits(100.0 * left) + " % off its value with all " +
      std::to_string(q.sums.size()) + " modes of the mesh for " + std::to_string(modes.kept) +
      ", and modes_tolerance is " + digits(100.0 * scene.rotor.geometry->modes_tolerance) + " %. ";
  if (q.inverse) {
    reason +=
        "The effective mass of a station without a mass of its own falls without limit as modes "
        "are added: a sleeve ([[rotor.disc]] at contact.station) gives it a limit. ";
  }
  reason += "Set ";
  if (left < 1.0) reason += "a modes_tolerance well above " + digits(left) + ", or ";
  reason += "a number of modes";
  throw scene::SceneError({{"", 0, "rotor.modes", reason}});
}

}  // namespace

RotorModes fewest_modes(const scene::Scene& scene,
                        const std::function<RotorModes(int)>& with_modes) {
  const double tolerance = scene.rotor.geometry->modes_tolerance;
  const auto needed = [&](const RotorModes& modes) {
    return fewest_of(quantities(scene, modes), tolerance);
  };
  // A finer mesh is softer, so it needs at least as many modes as a coarser one. The number needed
  // on the mesh for n modes is therefore the next candidate. n at most doubles per iteration, so a
  // refusal does not cost a very fine mesh.
  int n = 1;
  std::optional<RotorModes> found;
  while (!found) {
    RotorModes modes = with_modes(n);
    const int k = needed(modes);
    if (k <= n) {
      found = std::move(modes);
    } else if (k > kMostAutoModes) {
      refuse(scene, modes);
    } else {
      n = std::min(k, 2 * n);
    }
  }
  // A finer mesh is softer only up to round-off, so one mode less may also be enough.
  while (n > 1) {
    RotorModes modes = with_modes(n - 1);
    if (needed(modes) > n - 1) break;
    found = std::move(modes);
    --n;
  }
  return std::move(*found);
}

}  // namespace rotorub
