// What a sampled controller is shown: choice, resolution, noise, delay, velocities from positions.
#include "native_model/control/sensors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "native_model/control/abi/rotorub/controller.h"

namespace rotorub {
namespace {

constexpr double kSensorSample = 1e-4;

// No two numbers alike.
Measurement truth(std::int64_t k) {
  const double t = static_cast<double>(k) * kSensorSample;
  Measurement m;
  m.t = t;
  m.sample = k;
  m.rotor = {1.1e-4 + 0.3 * t, -2.2e-4 + 0.7 * t};
  m.rotor_velocity = {0.3, 0.7};
  m.stator = {3.3e-5 - 0.2 * t, 4.4e-5 + 0.1 * t};
  m.stator_velocity = {-0.2, 0.1};
  m.spin_angle = 314.0 * t;
  m.spin_speed = 314.0;
  m.current = {1.5, -0.5};
  m.rotor_acceleration = {7.0, 8.0};
  return m;
}

std::vector<Measurement> shown(const scene::Sensors& settings, int samples) {
  const Sensors sensors(settings, kSensorSample);
  std::vector<double> memory(sensors.memory_size(), 0.0);
  std::vector<Measurement> all;
  for (int k = 0; k < samples; ++k) all.push_back(sensors.measure(truth(k), memory.data()));
  return all;
}

TEST(Sensors, ShowTheTruthAndRememberNothingByDefault) {
  EXPECT_EQ(Sensors({}, kSensorSample).memory_size(), 0u);
  const Measurement m = shown({}, 3).back(), wanted = truth(2);
  EXPECT_EQ(m.rotor, wanted.rotor);
  EXPECT_EQ(m.stator_velocity, wanted.stator_velocity);
  EXPECT_EQ(m.spin_angle, wanted.spin_angle);
  EXPECT_EQ(m.current, wanted.current);
  EXPECT_EQ(m.rotor_acceleration, wanted.rotor_acceleration);
}

TEST(Sensors, WhatIsNotMeasuredIsZeroAndSaidSo) {
  scene::Sensors s;
  s.rotor = s.spin = s.current = false;
  const Measurement m = shown(s, 1).front();
  EXPECT_TRUE(m.rotor.isZero(0.0));
  EXPECT_TRUE(m.rotor_velocity.isZero(0.0)) << "of what is not measured";
  EXPECT_EQ(m.stator_velocity, truth(0).stator_velocity);
  EXPECT_EQ(m.spin_speed, 0.0);
  EXPECT_TRUE(m.current.isZero(0.0));
  EXPECT_EQ(Sensors(s, kSensorSample).measured(),
            unsigned{ROTORUB_MEASURES_STATOR | ROTORUB_MEASURES_VELOCITY});
}

TEST(Sensors, RoundToTheResolution) {
  scene::Sensors s;
  s.position_resolution = 1e-5;
  s.velocity_resolution = 0.25;
  const Measurement m = shown(s, 1).front();
  EXPECT_DOUBLE_EQ(m.rotor.x(), 1.1e-4);
  EXPECT_DOUBLE_EQ(m.stator.x(), 3e-5);
  EXPECT_EQ(m.rotor_velocity, Eigen::Vector2d(0.25, 0.75));
}

TEST(Sensors, NoiseIsNormalIndependentAndAlwaysTheSame) {
  scene::Sensors s;
  s.position_noise = 2e-6;
  const int count = 20'000;
  const auto a = shown(s, count), b = shown(s, count);
  double sum = 0.0, square = 0.0, across = 0.0, next = 0.0, fourth = 0.0, last = 0.0;
  for (int k = 0; k < count; ++k) {
    const auto i = static_cast<std::size_t>(k);
    ASSERT_EQ(a[i].rotor, b[i].rotor);
    const Eigen::Vector2d e = (a[i].rotor - truth(k).rotor) / s.position_noise;
    sum += e.x();
    square += e.x() * e.x();
    fourth += std::pow(e.x(), 4);
    across += e.x() * e.y();
    next += e.x() * last;
    last = e.x();
  }
  // Five standard deviations of each mean.
  const double bound = 5.0 / std::sqrt(count);
  EXPECT_LT(std::abs(sum / count), bound);
  EXPECT_LT(std::abs(square / count - 1.0), std::sqrt(2.0) * bound);
  EXPECT_LT(std::abs(fourth / count - 3.0), std::sqrt(96.0) * bound);
  EXPECT_LT(std::abs(across / count), bound);
  EXPECT_LT(std::abs(next / count), bound);
  EXPECT_EQ(a[5].rotor_velocity, truth(5).rotor_velocity) << "no noise of its own";
  s.seed = 2;
  EXPECT_NE(shown(s, 1).front().rotor, a.front().rotor);
}

TEST(Sensors, DelayIsOfWholeSamplesAndTheFirstStandsForAllBefore) {
  scene::Sensors s;
  s.delay = 3 * kSensorSample;
  const auto all = shown(s, 8);
  for (int k = 0; k < 8; ++k) {
    const Measurement wanted = truth(std::max(0, k - 3));
    const Measurement& m = all[static_cast<std::size_t>(k)];
    EXPECT_EQ(m.rotor, wanted.rotor) << k;
    EXPECT_EQ(m.spin_angle, wanted.spin_angle) << k;
    EXPECT_EQ(m.t, truth(k).t) << "the time is now";
    EXPECT_EQ(m.sample, k);
  }
}

TEST(Sensors, VelocitiesFromTheShownPositions) {
  scene::Sensors s;
  s.velocity = scene::VelocitySensor::kDifference;
  s.position_resolution = 1e-6;
  const auto all = shown(s, 4);
  EXPECT_TRUE(all[0].rotor_velocity.isZero(0.0)) << "nothing to differ from";
  for (std::size_t k = 1; k < all.size(); ++k) {
    EXPECT_LT((all[k].rotor_velocity - (all[k].rotor - all[k - 1].rotor) / kSensorSample).norm(),
              1e-12);
    EXPECT_LT((all[k].rotor_velocity - truth(0).rotor_velocity).norm(), 1.5e-6 / kSensorSample);
  }
  s.delay = kSensorSample;
  const auto late = shown(s, 4);
  EXPECT_EQ(late[3].rotor_velocity, all[2].rotor_velocity) << "late as they are";
}

}  // namespace
}  // namespace rotorub
