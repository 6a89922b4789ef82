#include "renders/framing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace rotorub::renders {

namespace {

constexpr int kSteps = 8192;            // of FilmClock's table
constexpr double kFilmOfImpacts = 0.5;  // fraction of the film

// Chooses the first impact, then the others by decreasing impulse, and by time if equal. Impacts
// within `apart` of a chosen one share its slow motion.
std::vector<double> choose(std::span<const Strike> strikes, const Span& part, double apart) {
  std::vector<const Strike*> candidates;
  for (const Strike& strike : strikes) {
    if (part.has(strike.t)) candidates.push_back(&strike);
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

// The part of the run that takes FilmClock::kDecisive of a film of `duration` s, so short that the
// whirl makes at most 1 / kPointsOfATurn of a turn between frames. Nothing if the clock keeps to
// that throughout.
std::optional<Span> decisive_part(std::span<const Playback* const> runs, const FilmClock& clock,
                                  const Span& shown, double duration, double rate) {
  constexpr int kPieces = 64;
  // The largest fraction of the accepted turn between frames in which `slow` is a function of t.
  const auto excess = [&](const Span& part, const auto& slow) {
    const double piece = part.length() / kPieces;
    double most = 0.0;
    for (int k = 0; k < kPieces; ++k) {
      const double from = part.from + k * piece;
      for (const Playback* run : runs) {
        const double whirl = std::abs(run->median_whirl(from, from + piece));
        const double turn = whirl / (2.0 * std::numbers::pi * rate * slow(from + 0.5 * piece));
        most = std::max(most, kPointsOfATurn * turn);
      }
    }
    return most;
  };
  if (excess(shown, [&](double t) { return clock.slow(t); }) <= 1.0) return std::nullopt;

  double touch = 1e300;
  for (const Playback* run : runs) touch = std::min(touch, run->first_touch().value_or(touch));
  const bool touches = touch <= shown.to;
  const double before = touches ? 0.1 : 0.5;  // fraction of the part before the decisive moment
  const double moment = touches ? touch : runs.front()->closest(shown.from, shown.to);
  Span part = shown;
  for (double length = shown.length(); length > 1e-9 * shown.length(); length *= 0.9) {
    part.from = std::clamp(moment - before * length, shown.from, shown.to - length);
    part.to = part.from + length;
    const double slow = FilmClock::kDecisive * kFilmOfImpacts * duration / length;
    if (excess(part, [slow](double) { return slow; }) <= 1.0) break;
  }
  return part;
}

constexpr double kLeadIn = 0.04;  // before the first contact, as a fraction of the rest of the run
constexpr double kSlack = 1e-6;   // fraction of the run by which a window may exceed it
constexpr int kMostFrames = 20000;

template <typename Value>
[[noreturn]] void refuse(const char* option, const Value& value, const char* accepted) {
  throw std::invalid_argument(fmt::format("{} = {}: {}", option, value, accepted));
}

// The shown part of the runs. By default it begins shortly before the first contact of any run.
void set_window(Framing& framing, std::span<const Playback* const> runs,
                const RenderOptions& options) {
  double start = -1e300, end = 1e300, touch = 1e300;
  for (const Playback* run : runs) {
    start = std::max(start, run->start());
    end = std::min(end, run->end());
    touch = std::min(touch, run->first_touch().value_or(touch));
  }
  framing.to = options.to.value_or(end);
  framing.from = start;
  if (touch < 1e300) framing.from = std::max(start, touch - kLeadIn * (framing.to - touch));
  framing.from = options.from.value_or(framing.from);
  // A run of another engine may end slightly earlier because of round-off.
  const double slack = kSlack * (end - start);
  if (framing.from >= start - slack) framing.from = std::max(framing.from, start);
  if (framing.to <= end + slack) framing.to = std::min(framing.to, end);
  if (framing.from >= start && framing.from < framing.to && framing.to <= end) return;
  throw std::invalid_argument(fmt::format(
      "from = {} s, to = {} s: expected a part of the run, which has rows from {} s to {} s",
      framing.from, framing.to, start, end));
}

}  // namespace

FilmClock::FilmClock(const Span& run, double duration)
    : run_(run), decisive_(run), base_(duration / run.length()) {}

FilmClock::FilmClock(const Span& run, double duration, std::span<const Strike> strikes,
                     const std::optional<Span>& decisive)
    : FilmClock(run, duration) {
  decisive_ = decisive.value_or(run);
  // The integral of the bump over u is 16/15.
  const double share = kFilmOfImpacts / (1.0 - kFilmOfImpacts);
  half_ = share * decisive_.length() / ((kStretch - 1.0) * kMostImpacts * 16.0 / 15.0);
  impacts_ = choose(strikes, decisive_, half_);
  if (decisive || !impacts_.empty()) fill();
}

double FilmClock::stretch(double t) const {
  if (!decisive_.has(t)) return rest_;
  double most = 0.0;
  for (const double impact : impacts_) {
    const double u = (t - impact) / half_;
    if (std::abs(u) < 1.0) most = std::max(most, (1.0 - u * u) * (1.0 - u * u));
  }
  return 1.0 + (kStretch - 1.0) * most;
}

// film_ is the integral of stretch() over kSteps equal steps of each part of the run, by the
// trapezoidal rule, scaled to 1.
void FilmClock::fill() {
  const auto integrate = [this](const Span& part) {
    const double step = part.length() / kSteps;
    for (int k = 1; k <= kSteps && step > 0.0; ++k) {
      const double middle = stretch(part.from + (k - 0.5) * step);
      knots_.push_back({part.from + k * step, knots_.back().film + middle * step});
    }
  };
  knots_.assign(1, {run_.from, 0.0});
  integrate(decisive_);
  const double rest = run_.length() - decisive_.length();
  if (rest > 0.0) rest_ = std::min(1.0, (1.0 / kDecisive - 1.0) * knots_.back().film / rest);
  knots_.assign(1, {run_.from, 0.0});
  integrate({run_.from, decisive_.from});
  integrate(decisive_);
  integrate({decisive_.to, run_.to});
  const double all = knots_.back().film;
  base_ *= run_.length() / all;
  for (Knot& knot : knots_) knot.film /= all;
  knots_.back() = {run_.to, 1.0};
}

double FilmClock::time(double share) const {
  if (share <= 0.0) return run_.from;
  if (share >= 1.0) return run_.to;
  if (knots_.empty()) return run_.from + run_.length() * share;
  const auto after = std::ranges::upper_bound(knots_, share, {}, &Knot::film);
  const Knot& before = *std::prev(after);
  const double within = (share - before.film) / (after->film - before.film);
  return before.t + within * (after->t - before.t);
}

double FilmClock::slow(double t) const { return base_ * stretch(t); }

double FilmClock::slowest() const { return impacts_.empty() ? base_ : base_ * kStretch; }

std::string FilmClock::text() const {
  const bool whole = decisive_.length() >= run_.length();
  std::string text = fmt::format("slowed down {:.4g} times", base_);
  if (!whole) {
    text += fmt::format(" from {:.4g} s to {:.4g} s", decisive_.from, decisive_.to);
  }
  if (!impacts_.empty()) {
    text += fmt::format(", {:.4g} times at {} impact{}", slowest(), impacts_.size(),
                        impacts_.size() > 1 ? "s" : "");
  }
  return text + (whole ? "" : fmt::format(", {:.4g} times elsewhere", rest_ * base_));
}

std::string Framing::magnification_text(FilmView view) const {
  const std::string text = fmt::format("displacements magnified {:.3g} times", magnification);
  if (view != FilmView::kRig || machine_magnification == magnification) return text;
  return text +
         fmt::format(" in the cross-section, {:.3g} times in the machine", machine_magnification);
}

void check_options(const RenderOptions& options) {
  constexpr double kAboveZero = std::numeric_limits<double>::min();
  constexpr double kFinite = std::numeric_limits<double>::max();
  const struct {
    const char* name;
    std::optional<double> value;
    double least, most;
    const char* accepted;
  } numbers[] = {
      {"width", options.width, 320, 3840, "expected 320 to 3840"},
      {"height", options.height, 180, 2160, "expected 180 to 2160"},
      {"frames per second", options.frames_per_second, 1, 120, "expected 1 to 120"},
      {"slow motion", options.slow_motion, kAboveZero, kFinite, "expected a number above 0"},
      {"duration", options.duration, kAboveZero, kFinite, "expected a number above 0"},
      {"magnification", options.magnification, 1, 1e6, "expected 1 to 1e6"},
      {"magnification", options.machine_magnification, 1, 1e6, "expected 1 to 1e6"},
  };
  for (const auto& [name, value, least, most, accepted] : numbers) {
    if (value && !(*value >= least && *value <= most)) refuse(name, *value, accepted);
  }
  if (options.samples != 0 && options.samples != 2 && options.samples != 4 &&
      options.samples != 8) {
    refuse("samples", options.samples, "expected 0, 2, 4 or 8");
  }
}

const char* to_string(FilmView view) {
  switch (view) {
    case FilmView::kRig:
      return "rig";
    case FilmView::kAxis:
      return "axis";
    case FilmView::kCloseUp:
      return "close-up";
    case FilmView::kUnrolled:
      return "unrolled";
  }
  return "";
}

std::optional<FilmView> view_of(const std::string& name) {
  for (const FilmView view :
       {FilmView::kRig, FilmView::kAxis, FilmView::kCloseUp, FilmView::kUnrolled}) {
    if (name == to_string(view)) return view;
  }
  return std::nullopt;
}

std::string view_names() { return "rig, axis, close-up or unrolled"; }

Framing make_framing(std::span<const Playback* const> runs, const RenderOptions& options) {
  Framing framing;
  set_window(framing, runs, options);
  const double span = framing.to - framing.from;
  const double duration = options.slow_motion ? *options.slow_motion * span : options.duration;
  const double frames = std::round(duration * options.frames_per_second);
  if (!(frames <= kMostFrames)) {
    refuse("frames", frames,
           "expected at most 20000; show a shorter part, or choose a smaller --slow");
  }
  framing.frames = std::max(2, static_cast<int>(frames));
  const double film = framing.frames / options.frames_per_second;
  framing.slow_motion = film / span;
  std::vector<Strike> strikes;
  for (const Playback* run : runs) {
    strikes.insert(strikes.end(), run->strikes().begin(), run->strikes().end());
  }
  const Span shown{framing.from, framing.to};
  framing.clock = options.slow_motion ? FilmClock(shown, film) : FilmClock(shown, film, strikes);
  if (options.slow_motion) return framing;
  const double rate = options.frames_per_second;
  if (const auto decisive = decisive_part(runs, framing.clock, shown, film, rate)) {
    framing.clock = FilmClock(shown, film, strikes, decisive);
  }
  return framing;
}

double hardest_impact(const Playback& playback, const Framing& framing) {
  const Strike* hardest = nullptr;
  for (const Strike& strike : playback.strikes()) {
    if (strike.t < framing.from || strike.t > framing.to) continue;
    if (hardest == nullptr || strike.impulse > hardest->impulse) hardest = &strike;
  }
  return hardest != nullptr ? hardest->t : 0.5 * (framing.from + framing.to);
}

std::string engine_label(const Trajectory& trajectory) {
  const std::string& contact = trajectory.contact_model;
  std::string label = trajectory.engine.empty() ? "run" : trajectory.engine;
  if (label == "mujoco") label = contact == "cone" ? "MuJoCo alone" : "MuJoCo with the plugin";
  if (!trajectory.integrator.empty()) label += ": " + trajectory.integrator;
  if (!contact.empty()) label += ", " + contact + " contact";
  return label;
}

}  // namespace rotorub::renders
