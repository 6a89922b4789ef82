#include "native_model/control/sliding.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "native_model/control/control_loop.h"
#include "native_model/control/radial_tracking.h"

namespace rotorub {

SlidingController::SlidingController(const scene::Controller& settings, const Plant& plant,
                                     double spin_speed)
    : settings_(settings), plant_(plant), lead_(command_lead(settings, plant)) {
  if (settings.sample_time <= 0.0) return;
  const double turn = spin_speed == 0.0 ? 0.0 : 2.0 * std::numbers::pi / std::abs(spin_speed);
  filter_time_ = settings.filter_time.value_or(turn);
  const double critical =
      2.0 * std::sqrt((plant.stator_mass.cwiseProduct(plant.stator_stiffness)).maxCoeff());
  damping_ = settings.tracking_damping.value_or(critical);
}

// Within the layer, k/phi drives s = edot + psi e: e'' = -(psi + k/phi) edot - psi (k/phi) e. An
// adaptive layer holds k/phi at psi.
Controller::Gains SlidingController::ring_gains() const {
  const double mass = plant_.stator_mass.maxCoeff(), psi = settings_.bandwidth;
  const double slope = adapts() ? psi : settings_.switching_gain / settings_.boundary_layer;
  return {mass * psi * slope, mass * (psi + slope)};
}

std::size_t SlidingController::state_size() const {
  return (adapts() ? std::size_t{1} : 0) + (filters() ? std::size_t{kMeans} : 0);
}

void SlidingController::start(double* state) const {
  if (adapts()) state[0] = settings_.boundary_layer;
}

double SlidingController::surface(const RadialError& r) const {
  return r.rate + settings_.bandwidth * r.error;
}

std::span<const Controller::Output> SlidingController::outputs() const {
  static constexpr Output kOutputs[] = {{"s", "m/s"}, {"layer", "m/s"}};
  return kOutputs;
}

void SlidingController::output(const Measurement& now, const SwitchOn& on, const double* state,
                               double* values) const {
  const auto r = radial_error(now, on, plant_.clearance, settings_.gap_time);
  values[0] = r ? surface(*r) : 0.0;
  values[1] = adapts() ? state[0] : settings_.boundary_layer;
}

// m/s^2 along e_r, the known part of the plant: the rotor's contact-free acceleration, the whirl,
// and the acceleration by the ring's own spring and damper (-f of (25)).
double SlidingController::forward(const Measurement& now, const RadialError& r) const {
  const Eigen::Vector2d own = plant_.stator_stiffness.cwiseProduct(now.stator) +
                              plant_.stator_damping.cwiseProduct(now.stator_velocity);
  return r.e_r.dot(now.rotor_acceleration) + r.centrifugal +
         r.e_r.dot(own.cwiseQuotient(plant_.stator_mass));
}

// Means over the filter time in the frame of the whirl. The first sample initialises them.
void SlidingController::filter(double forward, const Eigen::Vector2d& ring, double* means) const {
  const double share =
      means[kBegun] == 0.0 ? 1.0 : 1.0 - std::exp(-settings_.sample_time / filter_time_);
  means[kBegun] = 1.0;
  means[kForward] += share * (forward - means[kForward]);
  means[kRadial] += share * (ring.x() - means[kRadial]);
  means[kTangential] += share * (ring.y() - means[kTangential]);
}

Eigen::Vector2d SlidingController::command(const Measurement& now, const SwitchOn& on,
                                           double* state) const {
  const double psi = settings_.bandwidth;
  double gain = settings_.switching_gain, layer = settings_.boundary_layer;
  if (adapts()) {
    // The layer at the next sample, integrated exactly; the present one holds until then.
    layer = state[0];
    const double rest = gain / psi;
    state[0] = rest + (layer - rest) * std::exp(-psi * settings_.sample_time);
    gain = psi * layer;
  }
  const auto r = radial_error(now, on, plant_.clearance, settings_.gap_time);
  if (!r) return {0.0, 0.0};
  const Eigen::Vector2d e_r = r->e_r, e_t{-e_r.y(), e_r.x()};
  double known = forward(now, *r);
  Eigen::Vector2d damped{0.0, 0.0};
  if (filters()) {
    double* means = state + (adapts() ? 1 : 0);
    const Eigen::Vector2d ring{e_r.dot(now.stator_velocity), e_t.dot(now.stator_velocity)};
    filter(known, ring, means);
    known = means[kForward];
    damped =
        -damping_ * ((ring.x() - means[kRadial]) * e_r + (ring.y() - means[kTangential]) * e_t);
  }
  const double switching = gain * std::clamp(surface(*r) / layer, -1.0, 1.0);
  const double radial = known + r->wanted.acceleration - psi * r->rate - switching;
  const double preload = settings_.preload * preload_share(plant_, e_r) * r->wanted.share;
  const Eigen::Vector2d push =
      r->certainty * (plant_.stator_mass.cwiseProduct(radial * e_r) - preload * e_r);
  return turned_ahead(push, *r, lead_) + damped;
}

namespace {

enum State : std::size_t {
  kHandedOver,
  kTime,
  kLeftX,
  kLeftY,
  kTouchMemory,
  kTrack = kTouchMemory + kTouchState
};

}  // namespace

TwoPhase::TwoPhase(const scene::Controller& settings, const Plant& plant, double spin_speed)
    : track_(settings, plant, spin_speed),
      cross_(settings),
      clearance_(plant.clearance),
      sample_time_(settings.sample_time),
      handover_time_(settings.handover_time) {}

std::size_t TwoPhase::state_size() const { return kTrack + track_.state_size(); }

void TwoPhase::start(double* state) const { track_.start(state + kTrack); }

Eigen::Vector2d TwoPhase::command(const Measurement& now, const SwitchOn& on, double* state) const {
  if (state[kHandedOver] == 0.0) {
    const bool touches = touched(now, clearance_, sample_time_, state + kTouchMemory);
    const Eigen::Vector2d tracking = track_.command(now, on, state + kTrack);
    if (!touches) return tracking;
    const Eigen::Vector2d left = tracking - cross_.command(now, on, nullptr);
    state[kHandedOver] = 1.0;
    state[kTime] = now.t;
    state[kLeftX] = left.x();
    state[kLeftY] = left.y();
    return tracking;
  }
  const double left = 1.0 - gap_reference({state[kTime], 0.0, 0.0}, now.t, handover_time_).share;
  return cross_.command(now, on, nullptr) + left * Eigen::Vector2d(state[kLeftX], state[kLeftY]);
}

}  // namespace rotorub
