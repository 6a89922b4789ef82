// What a fixed step of one run did.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "native_model/contact/planar_contact.h"
#include "native_model/model/model.h"
#include "native_model/numerics/status.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Impacts of one contact in a step; the last has restitution 0.
inline constexpr int kMostImpacts = 8;

// A command that jumps within a step: the share of the step before, in (0, 1), and the means before
// and after. Share 0: none.
struct CommandJump {
  double share = 0.0;
  Eigen::Vector2d before{0.0, 0.0}, after{0.0, 0.0};
};

// At one contact.
struct ContactStep {
  Mode mode = Mode::kFree;            // of lasting contact
  bool reversed = false;              // the slip changed its sign without sticking
  double normal_impulse = 0.0;        // N s over the step, impacts and lasting contact alike
  double friction_impulse = 0.0;      // N s, on the rotor along e_t
  Eigen::Vector2d lasting{0.0, 0.0};  // N s, normal and friction, of lasting contact alone
  // N, normal and friction: of an impact that takes time and was under way at the step's begin.
  Eigen::Vector2d impact_force{0.0, 0.0};
};

struct FixedStep : ContactStep {  // its own is that of the first contact
  Status status = Status::kOk;
  std::span<const ContactStep> others;  // of the further contacts; until the next call
  std::span<const Impact> impacts;      // of all, in order; until the next call
  double impact_time = 0.0;  // s, how long an impact lasts that takes time and began in the step
  // J, where asked for: of contact on the coordinates, and of it that of impacts; of all forces but
  // springs and contact.
  double contact_work = 0.0, impact_work = 0.0, external_work = 0.0;

  const ContactStep& at(std::size_t contact) const {
    return contact == 0 ? *this : others[contact - 1];
  }
};

// An impact with the energy that it takes, from its impulses (N s, normal and friction) and the
// rates (gdot_N, gdot_T) before and after it.
Impact impact_of(double t, const Eigen::Vector2d& impulses, const Eigen::Vector2d& before,
                 const Eigen::Vector2d& after, std::size_t contact = 0);

// J, on the coordinates: of impacts; and of the lasting impulses of a step between the rates (ddot,
// spin) at its two ends. A machine that holds the speed works too.
double impact_work(const Model& m, std::span<const Impact> impacts);
double lasting_work(const Model& m, std::size_t contact, const Eigen::Vector2d& e_r,
                    const Eigen::Vector2d& impulses, const Eigen::Vector3d& start,
                    const Eigen::Vector3d& end);

// A state in which the contact stands on its circle and does not move off it: lasting contact.
bool rests_on_circle(const Model& m, const double* q, const double* v, std::size_t contact);

}  // namespace rotorub
