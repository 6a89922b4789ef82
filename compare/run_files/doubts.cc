#include "compare/run_files/doubts.h"

#include <fmt/format.h>

#include <cmath>

namespace rotorub {
namespace {

// A law that the run does not see.
void doubt_control(const scene::Controller& law, double end, const std::string& where,
                   std::vector<std::string>& all) {
  if (law.kind == scene::ControllerKind::kPassive) return;
  if (law.on >= end) {
    all.push_back(
        fmt::format("{}controller.on = {:.6g} s: the run ends at {:.6g} s, and the law "
                    "never acts",
                    where, law.on, end));
  } else if (law.sample_time >= end) {
    all.push_back(
        fmt::format("{}controller.sample_time = {:.6g} s: the run ends at {:.6g} s, and "
                    "the law acts once at most",
                    where, law.sample_time, end));
  }
}

}  // namespace

std::vector<std::string> doubts(const scene::Scene& scene) {
  std::vector<std::string> all;
  const double speed = std::abs(scene.rotor.speed);
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    const auto& contact = scene.auxiliary[k].contact;
    const std::string where =
        scene.auxiliary.size() > 1 ? fmt::format("{}: ", scene.name_of(k)) : std::string();
    if (const auto& law = scene.auxiliary[k].controller)
      doubt_control(*law, scene.run.end, where, all);
    if (!contact) continue;
    if (contact->clearance > kMostClearance * contact->radius) {
      all.push_back(fmt::format(
          "{}contact.clearance = {:.4g} m is {:.3g} times the rotor's radius there; clearances are "
          "some thousandths of it (a unit may be missing: \"0.5 mm\")",
          where, contact->clearance, contact->clearance / contact->radius));
    }
    if (speed * contact->radius > kFastestSurface) {
      all.push_back(fmt::format(
          "{}rotor.speed = {:.6g} rad/s moves the surface at the contact at {:.4g} m/s (a number "
          "without a unit is in rad/s: \"3000 rpm\", \"50 Hz\")",
          where, scene.rotor.speed, speed * contact->radius));
    }
    if (contact->friction.sticking() > kMostFriction) {
      all.push_back(fmt::format("{}contact.friction = {:.4g}; dry metal has 0.1 to 0.8", where,
                                contact->friction.sticking()));
    }
  }
  if (!scene.rotor.geometry) return all;
  if (scene.rotor.geometry->E < kSoftestShaft) {
    all.push_back(fmt::format("rotor.E = {:.4g} Pa is softer than any metal (steel: \"210 GPa\")",
                              scene.rotor.geometry->E));
  }
  for (const scene::Disc& disc : scene.rotor.geometry->discs) {
    if (disc.eccentricity <= kMostEccentricity) continue;
    all.push_back(fmt::format(
        "rotor.disc.eccentricity = {:.4g} m at z = {:.4g} m; balanced discs have some micrometres",
        disc.eccentricity, disc.z));
  }
  return all;
}

}  // namespace rotorub
