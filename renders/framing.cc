#include "renders/framing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rotorub::renders {

namespace {

constexpr double kLeadIn = 0.04;  // before the first contact, share of the rest of the run
constexpr double kSlack = 1e-6;   // of the run, by which a window may go beyond it
constexpr int kMostFrames = 20000;

template <typename Value>
[[noreturn]] void refuse(const char* option, const Value& value, const char* accepted) {
  throw std::invalid_argument(fmt::format("render: {} = {}: {}", option, value, accepted));
}

void check_size(const char* option, int value, int least, int most, const char* accepted) {
  if (value < least || value > most) refuse(option, value, accepted);
}

void check_positive(const char* option, const std::optional<double>& value) {
  if (value && !(*value > 0.0 && std::isfinite(*value))) refuse(option, *value, "must be above 0");
}

// The part of the runs that is shown: from shortly before the first touch of any, by default.
void set_window(Framing& framing, std::span<const Playback* const> runs,
                const RenderOptions& options) {
  double start = -1e300, end = 1e300, touch = -1.0;
  for (const Playback* run : runs) {
    start = std::max(start, run->start());
    end = std::min(end, run->end());
    const double own = run->first_touch();
    if (own >= 0.0) touch = touch < 0.0 ? own : std::min(touch, own);
  }
  framing.to = options.to.value_or(end);
  framing.from = start;
  if (touch >= 0.0) framing.from = std::max(start, touch - kLeadIn * (framing.to - touch));
  framing.from = options.from.value_or(framing.from);
  // A run of another engine may end a rounding error earlier.
  const double slack = kSlack * (end - start);
  if (framing.from >= start - slack) framing.from = std::max(framing.from, start);
  if (framing.to <= end + slack) framing.to = std::min(framing.to, end);
  if (framing.from >= start && framing.from < framing.to && framing.to <= end) return;
  throw std::invalid_argument(
      fmt::format("render: from = {} s, to = {} s: a part of the run is accepted, which has rows "
                  "from {} s to {} s",
                  framing.from, framing.to, start, end));
}

}  // namespace

void check_options(const RenderOptions& options) {
  check_size("width", options.width, 320, 3840, "320 to 3840 is accepted");
  check_size("height", options.height, 180, 2160, "180 to 2160 is accepted");
  if (!(options.frames_per_second >= 1.0 && options.frames_per_second <= 120.0)) {
    refuse("frames per second", options.frames_per_second, "1 to 120 is accepted");
  }
  if (options.samples != 0 && options.samples != 2 && options.samples != 4 &&
      options.samples != 8) {
    refuse("samples", options.samples, "0, 2, 4 or 8 is accepted");
  }
  if (options.quality < 0 || options.quality > 51) {
    refuse("quality", options.quality, "0 (lossless) to 51 is accepted");
  }
  if (options.threads < 0 || options.threads > 64) {
    refuse("threads", options.threads, "0 (one a processor) to 64 is accepted");
  }
  check_positive("slow motion", options.slow_motion);
  check_positive("duration", options.duration);
  for (const auto& magnification : {options.magnification, options.machine_magnification}) {
    if (magnification && !(*magnification >= 1.0 && *magnification <= 1e6)) {
      refuse("magnification", *magnification, "1 to 1e6 is accepted");
    }
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
           "at most 20000 are made: shorten the part shown, or ask for less slow motion");
  }
  framing.frames = std::max(2, static_cast<int>(frames));
  const double film = framing.frames / options.frames_per_second;
  framing.slow_motion = film / span;
  std::vector<Strike> strikes;
  for (const Playback* run : runs) {
    strikes.insert(strikes.end(), run->strikes().begin(), run->strikes().end());
  }
  framing.clock = options.slow_motion ? FilmClock(framing.from, framing.to, film)
                                      : FilmClock(framing.from, framing.to, film, strikes);
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
  std::string label = trajectory.engine.empty() ? "run" : trajectory.engine;
  if (!trajectory.integrator.empty()) label += " " + trajectory.integrator;
  if (!trajectory.contact_model.empty()) label += ", " + trajectory.contact_model + " contact";
  return label;
}

}  // namespace rotorub::renders
