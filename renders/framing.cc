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
  if (value < least || value > most || value % 2 != 0) refuse(option, value, accepted);
}

void check_positive(const char* option, const std::optional<double>& value) {
  if (value && !(*value > 0.0 && std::isfinite(*value))) refuse(option, *value, "must be above 0");
}

}  // namespace

void check_options(const RenderOptions& options) {
  check_size("width", options.width, 320, 3840, "an even number from 320 to 3840 is accepted");
  check_size("height", options.height, 180, 2160, "an even number from 180 to 2160 is accepted");
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
  check_positive("slow motion", options.slow_motion);
  check_positive("duration", options.duration);
  for (const auto& magnification : {options.magnification, options.machine_magnification}) {
    if (magnification && !(*magnification >= 1.0 && *magnification <= 1e6)) {
      refuse("magnification", *magnification, "1 to 1e6 is accepted");
    }
  }
}

Framing make_framing(const Playback& playback, const RenderOptions& options) {
  Framing framing;
  const double start = playback.start();
  const double end = playback.end();
  framing.to = options.to.value_or(end);
  framing.from = start;
  const double touch = playback.first_touch();
  if (touch >= 0.0) framing.from = std::max(start, touch - kLeadIn * (framing.to - touch));
  framing.from = options.from.value_or(framing.from);
  // A run of another engine may end a rounding error earlier.
  const double slack = kSlack * (end - start);
  if (framing.from >= start - slack) framing.from = std::max(framing.from, start);
  if (framing.to <= end + slack) framing.to = std::min(framing.to, end);
  if (!(framing.from >= start && framing.from < framing.to && framing.to <= end)) {
    throw std::invalid_argument(
        fmt::format("render: from = {} s, to = {} s: a part of the run is accepted, which has rows "
                    "from {} s to {} s",
                    framing.from, framing.to, start, end));
  }

  const double span = framing.to - framing.from;
  const double duration = options.slow_motion ? *options.slow_motion * span : options.duration;
  const double frames = std::round(duration * options.frames_per_second);
  if (!(frames <= kMostFrames)) {
    refuse("frames", frames,
           "at most 20000 are made: shorten the part shown, or ask for less slow motion");
  }
  framing.frames = std::max(2, static_cast<int>(frames));
  framing.slow_motion = framing.frames / options.frames_per_second / span;
  return framing;
}

std::string engine_label(const Trajectory& trajectory) {
  std::string label = trajectory.engine.empty() ? "run" : trajectory.engine;
  if (!trajectory.integrator.empty()) label += " " + trajectory.integrator;
  if (!trajectory.contact_model.empty()) label += ", " + trajectory.contact_model + " contact";
  return label;
}

}  // namespace rotorub::renders
