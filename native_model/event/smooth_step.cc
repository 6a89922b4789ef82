#include "native_model/event/smooth_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "native_model/model/dynamics.h"
#include "native_model/scene/text.h"

namespace rotorub {

namespace {

constexpr double kLeastDisplacement = 1e-6, kLeastSpeed = 1e-6;  // m, m/s: for a system at rest
constexpr double kLeastCurrent = 1e-6;                           // A

}  // namespace

SmoothStep::SmoothStep(const Model& model, const EventParameters& parameters, SmoothSystem& system)
    : model_(&model),
      parameters_(&parameters),
      system_(&system),
      step_(2 * model.nq() + integral_count(model)),
      tolerance_(static_cast<std::size_t>(step_.size())),
      round_off_(model.is_compliant() ? static_cast<std::size_t>(model.nq()) : 0),
      allowed_(model.is_compliant() ? tolerance_.size() : 0),
      y_(tolerance_),
      slope_(tolerance_),
      lowest_(model.auxiliary.size()),
      largest_normal_(lowest_.size()) {}

void SmoothStep::begin(const Motion& start, double first) {
  next_ = first;
  displacement_ = model_->has_contact() ? 0.0 : kLeastDisplacement;
  for (const AuxiliaryBearing& bearing : model_->auxiliary) {
    if (bearing.contact) displacement_ = std::max(displacement_, bearing.contact->clearance);
  }
  speed_ = kLeastSpeed;
  spin_ = 0.0;
  update_tolerances(start);
}

void SmoothStep::update_tolerances(const Motion& motion) {
  const Layout& l = model_->layout;
  const int n = l.nq();
  const auto angle = [&l](int i) { return l.turns(i); };
  for (int i = 0; i < l.mechanical(); ++i) {
    if (!angle(i)) displacement_ = std::max(displacement_, std::abs(motion.q()[i]));
    double& rate = angle(i) ? spin_ : speed_;
    rate = std::max(rate, std::abs(motion.v()[i]));
  }
  const double tolerance = parameters_->tolerance;
  const auto coil_limit = [&](int i) {
    const auto has = [i](const AuxiliaryBearing& at) { return i == at.coil || i == at.coil + 1; };
    return std::find_if(model_->auxiliary.begin(), model_->auxiliary.end(), has)
        ->magnets->current_limit;
  };
  // The size of a feedback's state, from the size of the motion. Lagging states are faster than the
  // motion, and their dense output is less accurate than their steps.
  constexpr double kLags = 1e-2;
  const auto state_size = [&](int i) {
    for (const StationFeedback& f : model_->feedbacks) {
      const auto is = [i](int at) { return i == at || i == at + 1; };
      if (is(f.states.stored)) return f.law.proportional * displacement_;
      if (is(f.states.filtered)) return kLags * speed_;
      if (is(f.states.current)) {
        return kLags *
               (f.law.proportional * displacement_ + f.law.derivative * speed_ + kLeastCurrent);
      }
    }
    return kInfinity;  // for the memory of a sampler, which is constant between samples
  };
  double *of_q = tolerance_.data(), *of_v = of_q + n;
  for (int i = 0; i < l.mechanical(); ++i) {
    of_q[i] = tolerance * (angle(i) ? 1.0 : displacement_);
    of_v[i] = tolerance * (angle(i) ? std::max(1.0, spin_) : speed_);
  }
  // Nothing depends on the integral of a bristle, the integral of an integrator, the charge of a
  // coil, or the integrals of the run.
  for (int i = l.bristle(); i < n; ++i) {
    of_q[i] = kInfinity;
    of_v[i] = tolerance * (i < l.feedback_state()  ? 1.0
                           : i < l.coil()          ? state_size(i)
                           : i < l.control_state() ? coil_limit(i)
                                                   : kInfinity);
  }
  std::fill(tolerance_.begin() + 2 * n, tolerance_.end(), kInfinity);
  if (!round_off_.empty()) find_round_off(motion);
}

// The accelerations by round-off of the penetration in compliant contacts. For a hard spring on a
// light ring they exceed the tolerance, and even the shortest step cannot avoid them.
void SmoothStep::find_round_off(const Motion& motion) {
  constexpr double kOfDepth = 4.0 * std::numeric_limits<double>::epsilon();  // of the clearance
  std::fill(round_off_.begin(), round_off_.end(), 0.0);
  for (std::size_t k = 0; k < model_->auxiliary.size(); ++k) {
    if (!model_->auxiliary[k].is_compliant() || !system_->in_contact(k)) continue;
    const ContactParameters& contact = *model_->auxiliary[k].contact;
    const CompliantLaw& law = contact.compliance;
    const double depth = -contact_point(*model_, motion.q(), motion.v(), k).gap;
    if (!(depth > 0.0)) continue;
    const double slope = law.exponent * law.spring(depth) / depth;
    const double force = slope * kOfDepth * contact.clearance;
    double load[kMaxCoordinates] = {};
    add_contact_load(*model_, {force, force, 0.0}, load, k);
    for (std::size_t i = 0; i < round_off_.size(); ++i) {
      round_off_[i] += std::abs(load[i]) / model_->mass[static_cast<Eigen::Index>(i)];
    }
  }
}

// The tolerance of a step of h (s), including the error by round-off.
const double* SmoothStep::tolerance_of(double h) {
  if (round_off_.empty()) return tolerance_.data();
  const std::size_t n = round_off_.size();
  allowed_ = tolerance_;
  for (std::size_t i = 0; i < n; ++i) {
    allowed_[i] += h * h * round_off_[i];
    allowed_[n + i] += h * round_off_[i];
  }
  return allowed_.data();
}

double SmoothStep::largest_contact_speed(std::size_t contact) const {
  return std::max(speed_, model_->auxiliary[contact].contact->radius * spin_);
}

void SmoothStep::restart(const Motion& motion) {
  system_->derivative(motion.t, motion.y.data(), step_.first_slope());
}

bool SmoothStep::advance(const Motion& from, double limit) {
  start_ = from.t;
  smooth_end_ = std::nextafter(limit, start_);
  dense_ready_ = false;
  const auto f = [this](double t, const double* y, double* dy) {
    system_->derivative(before_break(t), y, dy);
    for (std::size_t k = 0; k < lowest_.size(); ++k) {
      const Margins& m = system_->margins(k);
      lowest_[k] = {std::min(lowest_[k].force, m.force),
                    std::min(lowest_[k].tangential, m.tangential)};
      largest_normal_[k] = std::max(largest_normal_[k], system_->multipliers(k).normal);
    }
  };
  while (next_ > 1e-15 * std::max(1e-3, std::abs(start_))) {
    const double h = std::min(next_, limit - start_);
    std::fill(lowest_.begin(), lowest_.end(), Margins{kInfinity, kInfinity});
    std::fill(largest_normal_.begin(), largest_normal_.end(), 0.0);
    const double error = step_.trial(f, start_, from.y.data(), h, tolerance_of(h));
    const double factor = Dop853::step_factor(error);
    if (error <= 1.0) {
      // A step cut short by a break says little about the next one.
      next_ = h < next_ ? std::max(next_, h * factor) : h * factor;
      end_time_ = start_ + h;
      if (limit - end_time_ <= 1e-14 * limit || h >= limit - start_) end_time_ = limit;
      return true;
    }
    next_ = h * std::min(factor, 0.9);
  }
  return false;
}

SmoothStep::Stability SmoothStep::stability() const {
  const auto [rate, component] = step_.fastest(tolerance_.data());
  return {rate, component % model_->nq()};
}

void SmoothStep::accept(Motion& motion) {
  std::copy_n(step_.end(), motion.y.size(), motion.y.begin());
  step_.advance();
}

void SmoothStep::prepare_dense() {
  if (dense_ready_) return;
  step_.prepare_dense([this](double t, const double* y,
                             double* dy) { system_->derivative(before_break(t), y, dy); },
                      start_);
  dense_ready_ = true;
}

void SmoothStep::dense(double theta, double* y) {
  prepare_dense();
  step_.dense(theta, y);
}

const double* SmoothStep::at(double theta) {
  if (theta == 1.0) return step_.end();
  dense(theta, y_.data());
  return y_.data();
}

void SmoothStep::add_increments(int i, std::span<const double> times, double* to) {
  prepare_dense();
  step_.find_terms_of(i);
  const double share = 1.0 / step_.step();
  for (const double t : times) *to++ += step_.nested(i, (t - start_) * share);
}

const double* SmoothStep::term(int d) {
  prepare_dense();
  return step_.term(d);
}

void SmoothStep::evaluate(const Motion& motion) {
  system_->derivative(before_break(motion.t), motion.y.data(), slope_.data());
}

const Margins& SmoothStep::margins(std::size_t contact, double theta) {
  evaluate_at(theta);
  return system_->margins(contact);
}

double SmoothStep::normal_force(std::size_t contact, double theta) {
  evaluate_at(theta);
  return system_->multipliers(contact).normal;
}

void SmoothStep::evaluate_at(double theta) {
  dense(theta, y_.data());
  system_->derivative(before_break(time(theta)), y_.data(), slope_.data());
}

namespace {

// After Hairer, Norsett, Wanner, section IV.2, and their code DOP853: the run is checked every
// kStepsBetween steps. It is stiff after more than kStiffLooks checks that found it stiff, unless
// kSmoothLooks in a row did not. h |lambda| is 6.1 at the limit of stability, about which the step
// control oscillates. A motion that follows the fastest rate needs h |lambda| below 1 to be
// resolved; steps beyond kBorder do not resolve it.
constexpr std::int64_t kStepsBetween = 1000;
constexpr double kBorder = 2.0;
constexpr int kStiffLooks = 15, kSmoothLooks = 6;

// The name of coordinate i for a message.
std::string part_of(const Layout& l, int i) {
  const auto numbered = [i](const char* what, int first) {
    return what + std::to_string(i - first + 1);
  };
  if (i < l.y()) return numbered("the rotor's bending mode x_", l.x());
  if (i < l.phi()) return numbered("the rotor's bending mode y_", l.y());
  if (i < l.theta()) return "the rotor's spin";
  if (i < l.ring()) return numbered("the rotor's torsion mode ", l.theta());
  if (i < l.ring_angle()) return "the ring's motion";
  if (i < l.bristle()) return "the ring's spin";
  if (i < l.feedback_state()) return "dry friction under the ring";
  if (i < l.coil()) return "a magnetic bearing's integrator, filter or amplifier";
  return numbered("the current of coil ", l.coil());
}

}  // namespace

std::optional<std::string> StiffnessWatch::check(double t, double end, const SmoothStep& step) {
  if (++count_.steps % kStepsBetween != 0) return {};
  const SmoothStep::Stability now = step.stability();
  // The number of remaining steps at the pace since the last check.
  const double at_pace =
      count_.steps > kStepsBetween
          ? (end - t) * static_cast<double>(kStepsBetween) / (t - count_.last_check)
          : 0.0;
  const double impacts_at_pace =
      at_pace / static_cast<double>(kStepsBetween) * static_cast<double>(count_.impacts);
  // A short pause between bursts must not begin the count anew.
  const bool fast = impacts_at_pace > parameters_->most_impacts;
  count_.fast_impacts = fast ? count_.fast_impacts + count_.impacts : count_.fast_impacts / 2;
  const bool bounces = 2 * count_.impacts > kStepsBetween;
  count_.impacts = 0;
  count_.last_check = t;
  const auto text = [](double value) { return scene::number_text(value, 2); };
  // An accumulation that ends by itself has fewer, unless the restitution is above 0.99999.
  constexpr double kWatched = 0.2;  // of most_impacts
  if (static_cast<double>(count_.fast_impacts) > kWatched * parameters_->most_impacts) {
    return "the rotor bounces without end, " + text(impacts_at_pace) +
           " more impacts at the present pace (lower contact.restitution, or take the integrator "
           "`verlet`, whose steps do not follow every bounce)";
  }
  if (bounces) return {};  // impacts, not stability, shorten the steps
  const bool hopeless = at_pace > parameters_->most_steps;
  if (!hopeless && now.rate * step.length() < kBorder) {
    if (++count_.smooth == kSmoothLooks) count_.stiff = 0;
    return {};
  }
  count_.smooth = 0;
  if (count_.stiff++ == 0) {
    count_.first_stiff = count_.steps;
    count_.first_stiff_time = t;
  }
  if (count_.stiff <= kStiffLooks) return {};
  const double to_go = (end - t) * static_cast<double>(count_.steps - count_.first_stiff) /
                       (t - count_.first_stiff_time);
  if (to_go < parameters_->most_stiff_steps) return {};
  const double time = 1.0 / std::max(now.rate, kBorder / step.length());
  return part_of(model_->layout, now.coordinate) + " follows within " + text(time) +
         " s, which holds `event` to steps of that size, " + text(to_go) +
         " more of them (give it more inertia or less damping, or take the integrator `verlet`, "
         "whose damping is implicit)";
}

}  // namespace rotorub
