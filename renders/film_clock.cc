#include "renders/film_clock.h"

#include <algorithm>
#include <cmath>

namespace rotorub::renders {

namespace {

constexpr int kSteps = 8192;            // of the table
constexpr double kFilmOfImpacts = 0.5;  // share of the film

// First the first one, then by falling impulse, ties by time; those within `apart` of a chosen one
// share its slow motion.
std::vector<double> choose(std::span<const Strike> strikes, double from, double to, double apart) {
  std::vector<const Strike*> candidates;
  for (const Strike& strike : strikes) {
    if (strike.t >= from && strike.t <= to) candidates.push_back(&strike);
  }
  const auto earlier = [](const Strike* a, const Strike* b) { return a->t < b->t; };
  std::stable_sort(candidates.begin(), candidates.end(), earlier);
  if (candidates.empty()) return {};
  std::stable_sort(candidates.begin() + 1, candidates.end(),
                   [](const Strike* a, const Strike* b) { return a->impulse > b->impulse; });
  std::vector<double> chosen;
  for (const Strike* strike : candidates) {
    if (static_cast<int>(chosen.size()) == FilmClock::kMostImpacts) break;
    const bool near = std::any_of(chosen.begin(), chosen.end(),
                                  [&](double t) { return std::abs(t - strike->t) < apart; });
    if (!near) chosen.push_back(strike->t);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace

FilmClock::FilmClock(double from, double to, double duration)
    : from_(from), to_(to), base_(duration / (to - from)) {}

FilmClock::FilmClock(double from, double to, double duration, std::span<const Strike> strikes)
    : FilmClock(from, to, duration) {
  // The bump's integral over u is 16/15.
  const double share = kFilmOfImpacts / (1.0 - kFilmOfImpacts);
  half_ = share * (to - from) / ((kStretch - 1.0) * kMostImpacts * 16.0 / 15.0);
  impacts_ = choose(strikes, from, to, half_);
  if (!impacts_.empty()) fill();
}

double FilmClock::stretch(double t) const {
  double most = 0.0;
  for (const double impact : impacts_) {
    const double u = (t - impact) / half_;
    if (std::abs(u) < 1.0) most = std::max(most, (1.0 - u * u) * (1.0 - u * u));
  }
  return 1.0 + (kStretch - 1.0) * most;
}

// film_: the integral of stretch(), by the trapezoidal rule, scaled to 1.
void FilmClock::fill() {
  const double step = (to_ - from_) / kSteps;
  film_.assign(1, 0.0);
  double before = stretch(from_);
  for (int k = 1; k <= kSteps; ++k) {
    const double now = stretch(from_ + k * step);
    film_.push_back(film_.back() + 0.5 * (before + now) / kSteps);
    before = now;
  }
  base_ /= film_.back();
  for (double& value : film_) value /= film_.back();
  film_.back() = 1.0;
}

double FilmClock::time(double share) const {
  if (share <= 0.0) return from_;
  if (share >= 1.0) return to_;
  if (film_.empty()) return from_ + (to_ - from_) * share;
  const auto after = std::upper_bound(film_.begin(), film_.end(), share);
  const auto k = static_cast<std::size_t>(after - film_.begin());
  const double within = (share - film_[k - 1]) / (film_[k] - film_[k - 1]);
  return from_ + (to_ - from_) * (static_cast<double>(k - 1) + within) / kSteps;
}

double FilmClock::slow(double t) const { return base_ * stretch(t); }

double FilmClock::slowest() const { return impacts_.empty() ? base_ : base_ * kStretch; }

}  // namespace rotorub::renders
