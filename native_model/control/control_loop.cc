#include "native_model/control/control_loop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "native_model/contact/kinematics.h"
#include "native_model/control/abi/rotorub/controller.h"

namespace rotorub {
namespace {

// The numbers of a measurement in one array, without its time.
constexpr std::size_t kChannels = 14, kSpinAngle = 8;
using Channels = std::array<double, kChannels>;

// Calls action(channel, number of m) for each of them in order.
template <class M, class Action>
void for_each_channel(M& m, Action action) {
  std::size_t at = 0;
  for (auto* v : {&m.rotor, &m.stator, &m.rotor_velocity, &m.stator_velocity}) {
    for (auto& x : *v) action(at++, x);
  }
  for (auto* x : {&m.spin_angle, &m.spin_speed}) action(at++, *x);
  for (auto* v : {&m.current, &m.rotor_acceleration}) {
    for (auto& x : *v) action(at++, x);
  }
}
Channels channels_of(const Measurement& m) {
  Channels c;
  for_each_channel(m, [&c](std::size_t at, double x) { c[at] = x; });
  return c;
}
void set_channels(const double* c, Measurement& m) {
  for_each_channel(m, [c](std::size_t at, double& x) { x = c[at]; });
}

// Layout of the sensors' memory: 1 after the first sample, time and positions of the last one, and
// the delayed samples.
enum SensorMemory : std::size_t { kTaken, kLastTime, kLastPosition, kBuffer = kLastPosition + 4 };

std::uint64_t mixed(std::uint64_t x) {  // splitmix64, Steele et al. 2014
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

double uniform(std::uint64_t bits) {  // in (0, 1]
  return (static_cast<double>(bits >> 11) + 1.0) * 0x1p-53;
}

double rounded(double x, double resolution) {
  return resolution > 0.0 ? resolution * std::round(x / resolution) : x;
}

struct MeasuredGap {
  double gap = 0.0, rate = 0.0;  // m, m/s
};
// The gap and its rate as the sensors show them. The rate is 0 if the rotor is centred.
MeasuredGap measured_gap(const Measurement& now, double clearance) {
  const Eigen::Vector2d d = now.rotor - now.stator;
  const double delta = d.norm();
  if (delta <= kNoNormal) return {clearance - delta, 0.0};
  return {clearance - delta, -d.dot(now.rotor_velocity - now.stator_velocity) / delta};
}

// Layout of the loop's memory; the memory of the sensors and of the law follows.
enum LoopMemory : std::size_t {
  kRuns,
  kOnTime,
  kOnGap,
  kOnGapRate,
  kTouch,
  kOutputs = kTouch + kTouchState,
  kSingle = kOutputs + kMostOutputs
};

}  // namespace

double noise(int seed, std::int64_t sample, int channel) {
  const std::uint64_t at =
      mixed(mixed(static_cast<std::uint64_t>(seed)) ^
            mixed(static_cast<std::uint64_t>(sample) * 64u + static_cast<std::uint64_t>(channel)));
  // Box and Muller 1958.
  return std::sqrt(-2.0 * std::log(uniform(mixed(at)))) *
         std::cos(2.0 * std::numbers::pi * uniform(mixed(at + 1u)));
}

Sensors::Sensors(const scene::Sensors& settings, double sample_time)
    : settings_(settings),
      delay_(static_cast<std::size_t>(std::lround(settings.delay / sample_time))) {}

std::size_t Sensors::memory_size() const {
  const bool differences = settings_.velocity == scene::VelocitySensor::kDifference;
  return delay_ > 0 || differences ? kBuffer + delay_ * kChannels : 0;
}

unsigned Sensors::measured() const {
  const auto bit = [](bool is, unsigned value) { return is ? value : 0u; };
  const bool velocity = settings_.velocity != scene::VelocitySensor::kNone;
  return bit(settings_.rotor, ROTORUB_MEASURES_ROTOR) |
         bit(settings_.stator, ROTORUB_MEASURES_STATOR) | bit(velocity, ROTORUB_MEASURES_VELOCITY) |
         bit(settings_.spin, ROTORUB_MEASURES_SPIN) |
         bit(settings_.current, ROTORUB_MEASURES_CURRENT);
}

Measurement Sensors::measure(const Measurement& now, double* memory) const {
  Measurement shown = with_errors(now);
  if (memory_size() == 0) return shown;
  const bool first = memory[kTaken] == 0.0;
  if (settings_.velocity == scene::VelocitySensor::kDifference) put_differences(shown, memory);
  memory[kTaken] = 1.0;
  return delay_ > 0 ? delayed(shown, memory + kBuffer, first) : shown;
}

Sensors Sensors::exact() const {
  Sensors same = *this;
  scene::Sensors& s = same.settings_;
  s.position_noise = s.velocity_noise = s.current_noise = 0.0;
  s.position_resolution = s.velocity_resolution = s.current_resolution = 0.0;
  return same;
}

std::vector<std::size_t> Sensors::returning_entries() const {
  std::vector<std::size_t> all;
  if (settings_.velocity == scene::VelocitySensor::kDifference) {
    for (std::size_t i = 0; i < 4; ++i) all.push_back(kLastPosition + i);
  }
  for (std::size_t i = 0; i < delay_ * kChannels; ++i) {
    if (i % kChannels != kSpinAngle) all.push_back(kBuffer + i);
  }
  return all;
}

void Sensors::set_time(double last, double* memory) const {
  if (memory_size() > 0 && memory[kTaken] != 0.0) memory[kLastTime] = last;
}

void Sensors::set_spin_angles(double last, double growth, double* memory) const {
  if (delay_ == 0 || !settings_.spin || memory[kTaken] == 0.0) return;
  for (std::size_t i = 0; i < delay_; ++i) {
    const auto earlier = static_cast<double>(delay_ - 1 - i);  // samples before the last one
    memory[kBuffer + i * kChannels + kSpinAngle] = last - earlier * growth;
  }
}

Measurement Sensors::with_errors(const Measurement& now) const {
  const Channels truth = channels_of(now);
  Channels shown = truth;
  const auto spoil = [&](int begin, int end, double sigma, double resolution) {
    for (int i = begin; i < end; ++i) {
      double& x = shown[static_cast<std::size_t>(i)];
      if (sigma > 0.0) x += sigma * noise(settings_.seed, now.sample, i);
      x = rounded(x, resolution);
    }
  };
  const auto drop = [&](int begin, int end) {
    std::fill(shown.begin() + begin, shown.begin() + end, 0.0);
  };
  const scene::Sensors& s = settings_;
  spoil(0, 4, s.position_noise, s.position_resolution);
  spoil(4, 8, s.velocity_noise, s.velocity_resolution);
  spoil(10, 12, s.current_noise, s.current_resolution);
  const bool velocity = s.velocity == scene::VelocitySensor::kMeasured;
  if (!s.rotor) drop(0, 2);
  if (!s.stator) drop(2, 4);
  if (!s.rotor || !velocity) drop(4, 6);
  if (!s.stator || !velocity) drop(6, 8);
  if (!s.spin) drop(8, 10);
  if (!s.current) drop(10, 12);
  Measurement m = now;
  set_channels(shown.data(), m);
  return m;
}

// Backward differences of the shown positions; the velocities stay 0 at the first sample.
void Sensors::put_differences(Measurement& shown, double* memory) const {
  double* last = memory + kLastPosition;
  const double passed = shown.t - memory[kLastTime];
  if (memory[kTaken] > 0.0 && passed > 0.0) {
    shown.rotor_velocity = (shown.rotor - Eigen::Vector2d(last[0], last[1])) / passed;
    shown.stator_velocity = (shown.stator - Eigen::Vector2d(last[2], last[3])) / passed;
  }
  memory[kLastTime] = shown.t;
  last[0] = shown.rotor.x();
  last[1] = shown.rotor.y();
  last[2] = shown.stator.x();
  last[3] = shown.stator.y();
}

// Returns the oldest sample and appends the newest. The first sample stands for all earlier ones.
Measurement Sensors::delayed(const Measurement& shown, double* buffer, bool first) const {
  const Channels newest = channels_of(shown);
  double* end = buffer + delay_ * kChannels;
  if (first) {
    for (double* at = buffer; at != end; at += kChannels) std::ranges::copy(newest, at);
  }
  Measurement oldest = shown;
  set_channels(buffer, oldest);
  std::copy(buffer + kChannels, end, buffer);
  std::ranges::copy(newest, end - kChannels);
  return oldest;
}

bool touched(const Measurement& now, double clearance, double sample_time, double* state) {
  // The time (s) after which the last shown gap would close (0: never), and the gap's rate.
  enum : std::size_t { kTimeLeft, kRate };
  const MeasuredGap measured = measured_gap(now, clearance);
  const bool due =
      state[kTimeLeft] > 0.0 && sample_time >= state[kTimeLeft] && measured.rate > state[kRate];
  state[kTimeLeft] = measured.rate < 0.0 ? -measured.gap / measured.rate : 0.0;
  state[kRate] = measured.rate;
  // While contact lasts the gap is 0 up to the round-off of the engine, with either sign.
  constexpr double kClosed = 1e-5;  // share of the clearance
  return measured.gap <= kClosed * clearance || due;
}

ControlLoop::ControlLoop(std::shared_ptr<const Controller> law, const scene::Sensors& sensors,
                         const std::optional<scene::Trigger>& trigger, double sample_time,
                         double clearance)
    : law_(std::move(law)),
      sensors_(sensors, sample_time),
      trigger_(trigger),
      sample_time_(sample_time),
      clearance_(clearance) {}

std::size_t ControlLoop::memory_size() const {
  return kSingle + sensors_.memory_size() + law_->state_size();
}

Eigen::Vector2d ControlLoop::sample(const Measurement& truth, double* memory) const {
  const Measurement now = sensors_.measure(truth, memory + kSingle);
  double* state = memory + kSingle + sensors_.memory_size();
  if (memory[kRuns] == 0.0) {
    const MeasuredGap gap = measured_gap(now, clearance_);
    const SwitchOn on{now.t, gap.gap, gap.rate};
    const bool touch =
        trigger_ && trigger_->touch && touched(now, clearance_, sample_time_, memory + kTouch);
    if (!touch && !lets_in(on)) return {0.0, 0.0};
    memory[kRuns] = 1.0;
    memory[kOnTime] = on.t;
    memory[kOnGap] = on.gap;
    memory[kOnGapRate] = on.gap_rate;
    law_->start(state);
  }
  const SwitchOn on{memory[kOnTime], memory[kOnGap], memory[kOnGapRate]};
  const Eigen::Vector2d asked = law_->command(now, on, state);
  law_->output(now, on, state, memory + kOutputs);
  return asked;
}

ControlLoop ControlLoop::with_exact_sensors() const {
  ControlLoop same = *this;
  same.sensors_ = sensors_.exact();
  return same;
}

std::vector<std::size_t> ControlLoop::returning_entries() const {
  std::vector<std::size_t> all = sensors_.returning_entries();
  for (std::size_t& at : all) at += kSingle;
  if (trigger_ && trigger_->touch) {
    for (std::size_t i = 0; i < kTouchState; ++i) all.push_back(kTouch + i);
  }
  for (std::size_t i = kSingle + sensors_.memory_size(); i < memory_size(); ++i) all.push_back(i);
  return all;
}

void ControlLoop::set_time(double last, double* memory) const {
  sensors_.set_time(last, memory + kSingle);
}

void ControlLoop::set_spin_angles(double last, double growth, double* memory) const {
  sensors_.set_spin_angles(last, growth, memory + kSingle);
}

const double* ControlLoop::outputs(const double* memory) { return memory + kOutputs; }

bool ControlLoop::lets_in(const SwitchOn& now) const {
  if (!trigger_) return true;
  if (trigger_->gap && now.gap <= *trigger_->gap) return true;
  return trigger_->time_to_touch && now.gap_rate < 0.0 &&
         now.gap <= -now.gap_rate * *trigger_->time_to_touch;
}

}  // namespace rotorub
