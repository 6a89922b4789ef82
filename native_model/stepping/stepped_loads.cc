#include "native_model/stepping/stepped_loads.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "native_model/numerics/sine_cosine.h"

namespace rotorub {
namespace {

// Integral of the envelope from `on` to t, s: t - on - ramp / 2 once the ramp is over.
double risen(const AppliedForce& force, double t) {
  const double since = std::max(t - force.on, 0.0);
  if (since < force.ramp) return 0.5 * since * since / force.ramp;
  return since - 0.5 * force.ramp;
}

bool turns(scene::ForceKind kind) {
  return kind != scene::ForceKind::kConstant && kind != scene::ForceKind::kPulse;
}

}  // namespace

double next_switch(const Model& model, double from, double end) {
  double next = end;
  equations::for_each_switch(model, [&](double instant) {
    if (instant > from && instant < next) next = instant;
  });
  return next;
}

SteppedLoads::SteppedLoads(const Model& model, double h) : model_(&model) {
  for (const AppliedForce& force : model.forces) {
    synchronous_ = synchronous_ || force.kind == scene::ForceKind::kSynchronous;
    Load& load = loads_.emplace_back();
    load.force = &force;
    load.switched = force.on > 0.0 || force.off < scene::kNever || force.ramp > 0.0;
    load.off = std::max(force.on, force.off);
    sine_cosine(force.frequency * h, load.turn_sine, load.turn_cosine);
  }
}

void SteppedLoads::advance(std::int64_t k, double t, double begin, double end) {
  if (k == now_) return;
  now_ = k;
  for (Load& load : loads_) {
    const bool rotates = load.force->kind == scene::ForceKind::kRotating;
    const bool sweeps =
        load.force->kind == scene::ForceKind::kChirp;  // not by a fixed angle per step
    if (sweeps || (rotates && k % kResync == 0)) {
      sine_cosine(load.force->angle(t, 0.0), load.sine, load.cosine);
    } else if (rotates) {
      const double c = load.cosine, s = load.sine;
      load.cosine = c * load.turn_cosine - s * load.turn_sine;
      load.sine = s * load.turn_cosine + c * load.turn_sine;
    }
  }
  weigh(begin, end);
}

void SteppedLoads::weigh(double begin, double end) {
  if (model_->base) {
    const Eigen::Vector2d a = model_->base->mean(begin, end);
    base_ = {a.x(), a.y()};
  }
  for (Load& load : loads_) {
    const AppliedForce& force = *load.force;
    const double x = turns(force.kind) ? force.amplitude * load.cosine : force.vector.x();
    const double y = turns(force.kind) ? force.amplitude * load.sine : force.vector.y();
    if (force.kind == scene::ForceKind::kPulse) {
      load.share = mean_pulse(load, begin, end);
    } else {
      load.share = load.switched ? mean_envelope(load, begin, end) : 1.0;
    }
    load.x = load.share * x;
    load.y = load.share * y;
  }
}

void SteppedLoads::turn_with(double phi) {
  for (Load& load : loads_) {
    if (load.force->kind != scene::ForceKind::kSynchronous) continue;
    sine_cosine(phi + load.force->phase, load.sine, load.cosine);
    load.x = load.share * load.force->amplitude * load.cosine;
    load.y = load.share * load.force->amplitude * load.sine;
  }
}

double SteppedLoads::mean_envelope(const Load& load, double begin, double end) {
  const AppliedForce& force = *load.force;
  // Exactly 1 if nothing changes within the step.
  if (begin >= force.on + force.ramp && end <= load.off) return 1.0;
  const double until_end = std::min(load.off, end), until_begin = std::min(load.off, begin);
  return (risen(force, until_end) - risen(force, until_begin)) / (end - begin);
}

// The mean of sin(pi (t - on)/(off - on)), from its integral.
double SteppedLoads::mean_pulse(const Load& load, double from, double to) {
  const double on = load.force->on, off = load.off;
  const double begin = std::clamp(from, on, off), end = std::clamp(to, on, off);
  const double turn = std::numbers::pi / (off - on);
  // cos a - cos b = 2 sin((a + b)/2) sin((b - a)/2).
  const double integral = 2.0 / turn * std::sin(turn * (0.5 * (begin + end) - on)) *
                          std::sin(0.5 * turn * (end - begin));
  return integral / (to - from);
}

}  // namespace rotorub
