// The results of one fixed step.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "native_model/contact/planar_contact.h"
#include "native_model/model/model.h"
#include "native_model/numerics/status.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Largest number of impacts per contact in a step; the last one has restitution 0.
inline constexpr int kMostImpacts = 8;

// A jump of a command within a step: the fraction of the step before it, in (0, 1), and the mean
// commands before and after it. share = 0: no jump.
struct CommandJump {
  double share = 0.0;
  Eigen::Vector2d before{0.0, 0.0}, after{0.0, 0.0};
};

// Results at one contact.
struct ContactStep {
  ContactMode mode = ContactMode::kFree;  // state of the lasting contact
  bool reversed = false;                  // the slip changed its sign without sticking
  double normal_impulse = 0.0;            // N s over the step, impacts and lasting contact together
  double friction_impulse = 0.0;          // N s, on the rotor along e_t
  Eigen::Vector2d lasting{0.0, 0.0};      // N s, (normal, friction) of lasting contact only
  // N, (normal, friction) force, at the start of the step, of an impact that takes time.
  Eigen::Vector2d impact_force{0.0, 0.0};
};

struct FixedStep {
  Status status = Status::kOk;
  std::span<const ContactStep>
      contacts;                     // one for each auxiliary bearing; valid until the next call
  std::span<const Impact> impacts;  // of all contacts, in order; valid until the next call
  double impact_time = 0.0;  // s, duration of an impact that takes time and began in the step
  // J, if requested: work of contact on the coordinates, the part of it from impacts, and the work
  // of all forces except springs and contact.
  double contact_work = 0.0, impact_work = 0.0, external_work = 0.0;
};

// The record of an impact with its change of energy, from its impulses (N s, normal and friction)
// and the rates (gdot_N, gdot_T) before and after it.
Impact impact_of(double t, const Eigen::Vector2d& impulses, const Eigen::Vector2d& before,
                 const Eigen::Vector2d& after, std::size_t contact = 0);

// J, work on the coordinates: impact_work() of the impacts, lasting_work() of the lasting impulses
// of a step, with the mean of the rates (ddot, spin) at its two ends. If a motor holds the spin
// speed, the work that the motor exchanges is excluded.
double impact_work(const Model& m, std::span<const Impact> impacts);
double lasting_work(const Model& m, std::size_t contact, const Eigen::Vector2d& e_r,
                    const Eigen::Vector2d& impulses, const Eigen::Vector3d& mean_rates);

}  // namespace rotorub
