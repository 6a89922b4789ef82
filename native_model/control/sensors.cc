#include "native_model/control/sensors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "native_model/control/abi/rotorub/controller.h"

namespace rotorub {
namespace {

// A measurement as plain numbers, without its time.
constexpr std::size_t kChannels = 14;
using Channels = std::array<double, kChannels>;

Channels channels_of(const Measurement& m) {
  return {m.rotor.x(),
          m.rotor.y(),
          m.stator.x(),
          m.stator.y(),
          m.rotor_velocity.x(),
          m.rotor_velocity.y(),
          m.stator_velocity.x(),
          m.stator_velocity.y(),
          m.spin_angle,
          m.spin_speed,
          m.current.x(),
          m.current.y(),
          m.rotor_acceleration.x(),
          m.rotor_acceleration.y()};
}

void set_channels(const double* c, Measurement& m) {
  m.rotor = {c[0], c[1]};
  m.stator = {c[2], c[3]};
  m.rotor_velocity = {c[4], c[5]};
  m.stator_velocity = {c[6], c[7]};
  m.spin_angle = c[8];
  m.spin_speed = c[9];
  m.current = {c[10], c[11]};
  m.rotor_acceleration = {c[12], c[13]};
}

// What is remembered: samples taken, time and positions of the last one, and the delayed ones.
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
  memory[kTaken] += 1.0;
  return delay_ > 0 ? delayed(shown, memory + kBuffer, first) : shown;
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

// Backward differences of what is shown, 0 at the first sample.
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

// The oldest goes out, the newest comes in behind; the first sample stands for all before it.
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

}  // namespace rotorub
