// Where events are: the first contact of a flight, the end of lasting contact, within a step.
#include <algorithm>
#include <cmath>
#include <limits>

#include "native_model/integrate/event.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/trajectory/range_check.h"

namespace rotorub {
namespace {

constexpr double kNone = 2.0;  // theta of no event

}  // namespace

double EventIntegrator::locate() {
  if (!model_->contact) return kNone;
  return phase_.mode() == Mode::kFree ? locate_contact() : locate_margin();
}

// Free flight: the first root of |d| = delta_0 on the dense output.
double EventIntegrator::locate_contact() {
  const Model& m = *model_;
  const int n = m.nq();
  const auto centre = [&](const double* at) -> Eigen::Vector2d {
    return rotor_point(m, at) - stator_point(m, at);
  };
  const Eigen::Vector2d d0 = centre(y_.data()), d1 = centre(step_.end());
  // Out of reach: no further than the larger end plus what the speeds, twice over, could add.
  const double speed = std::max(centre(y_.data() + n).norm(), centre(step_.end() + n).norm());
  const double reach = std::max(d0.norm(), d1.norm()) + 2.0 * speed * step_.step();
  if (reach < m.contact->clearance) return kNone;

  prepare_dense();
  std::array<Eigen::Vector2d, kPathDegree> nested;
  for (int k = 0; k < kPathDegree; ++k) nested[static_cast<std::size_t>(k)] = centre(step_.term(k));
  const auto theta = first_contact(path_from_nested(nested), d0, m.contact->clearance, departure_);
  return theta.value_or(kNone);
}

// The trial ends out of range: the last theta within it.
double EventIntegrator::locate_loss() {
  prepare_dense();
  double in = 0.0, out = 1.0;
  while (out - in > 1e-12) {
    const double middle = 0.5 * (in + out);
    step_.dense(middle, row_.data());
    (out_of_range(*model_, row_.data()) ? out : in) = middle;
  }
  return out;
}

// The least of the margins at theta, each scaled; negative: the phase has ended before.
double EventIntegrator::margin_at(double theta) {
  step_.dense(theta, row_.data());
  phase_.derivative(before_break(t_ + theta * step_.step()), row_.data(), row_slope_.data());
  const Phase::Margins& m = phase_.margins();
  const double speed = std::max(largest_speed_, model_->contact->radius * largest_spin_);
  const double cone_scale = phase_.mode() == Mode::kSlide ? speed : force_scale_;
  return std::min(m.force / force_scale_, m.cone / cone_scale);
}

// Lasting contact: the stages of the step tell whether a margin was crossed; the dense output says
// when. Round-off below zero is no crossing: a phase may begin on its margin.
double EventIntegrator::locate_margin() {
  force_scale_ = std::max(force_scale_, std::abs(phase_.multipliers().normal));
  const double speed = std::max(largest_speed_, model_->contact->radius * largest_spin_);
  const double cone_scale = phase_.mode() == Mode::kSlide ? speed : force_scale_;
  constexpr double kRoundOff = 1e-13;
  if (lowest_.force > -options_.no_force * force_scale_ && lowest_.cone > -kRoundOff * cone_scale) {
    return kNone;
  }
  prepare_dense();
  constexpr int kSamples = 16;
  double lo = 0.0, hi = 0.0, f_lo = 0.0, f_hi = 0.0;
  bool found = false;
  for (int k = 1; k <= kSamples && !found; ++k) {
    hi = static_cast<double>(k) / kSamples;
    f_hi = margin_at(hi);
    found = f_hi < -kRoundOff;
    if (!found) {
      lo = hi;
      f_lo = f_hi;
    }
  }
  if (!found) return kNone;
  if (lo == 0.0) f_lo = std::max(margin_at(0.0), 0.0);
  // Regula falsi with the Illinois weights, closed by bisection where it crawls.
  for (int k = 0; k < 200 && hi - lo > 1e-16 * hi; ++k) {
    double x =
        k % 8 == 7 || f_lo <= 0.0 ? 0.5 * (lo + hi) : (lo * f_hi - hi * f_lo) / (f_hi - f_lo);
    if (!(x > lo && x < hi)) x = 0.5 * (lo + hi);
    if (x == lo || x == hi) break;
    const double f = margin_at(x);
    if (f < 0.0) {
      hi = x;
      f_hi = f;
      f_lo *= 0.5;
    } else {
      lo = x;
      f_lo = f;
      f_hi *= 0.5;
      if (f == 0.0) break;
    }
  }
  return std::max(lo, std::numeric_limits<double>::min());
}

}  // namespace rotorub
