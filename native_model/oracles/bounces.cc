#include "native_model/oracles/bounces.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace rotorub::oracle {

Billiard::Billiard(double clearance, const Eigen::Vector2d& position,
                   const Eigen::Vector2d& velocity)
    : clearance_(clearance), speed_(velocity.norm()), start_(position), start_velocity_(velocity) {
  assert(clearance > 0.0 && speed_ > 0.0 && position.norm() < clearance);
  // |p + v t| = delta_0.
  const double b = position.dot(velocity) / (speed_ * speed_);
  const double c = (position.squaredNorm() - clearance * clearance) / (speed_ * speed_);
  first_ = -b + std::sqrt(b * b - c);
  const Eigen::Vector2d at = position + first_ * velocity;
  first_angle_ = std::atan2(at.y(), at.x());
  const double cross = position.x() * velocity.y() - position.y() * velocity.x();
  beta_ = std::asin(cross / (clearance * speed_));
  chord_time_ = 2.0 * clearance * std::cos(beta_) / speed_;
  advance_ = std::copysign(std::numbers::pi, beta_) - 2.0 * beta_;
}

int Billiard::impacts_until(double t) const {
  return t < first_ ? 0 : 1 + static_cast<int>(std::floor((t - first_) / chord_time_));
}

Billiard::Flight Billiard::flight(double t) const {
  const int n = impacts_until(t);
  if (n == 0) return {0.0, start_, start_velocity_};
  const double angle = first_angle_ + (n - 1) * advance_;
  const Eigen::Vector2d e_r{std::cos(angle), std::sin(angle)}, e_t{-e_r.y(), e_r.x()};
  const Eigen::Vector2d v = speed_ * (-std::cos(beta_) * e_r + std::sin(beta_) * e_t);
  return {first_ + (n - 1) * chord_time_, clearance_ * e_r, v};
}

Eigen::Vector2d Billiard::position(double t) const {
  const Flight f = flight(t);
  return f.from + (t - f.since) * f.velocity;
}

Eigen::Vector2d Billiard::velocity(double t) const { return flight(t).velocity; }

double Drop::fall_time() const { return std::sqrt(2.0 * height / gravity); }

double Drop::impact_time(int index) const {
  double sum = 1.0, power = 1.0;
  for (int k = 0; k < index; ++k) {
    power *= restitution;
    sum += 2.0 * power;
  }
  return fall_time() * sum;
}

double Drop::rest_time() const { return fall_time() * (1.0 + restitution) / (1.0 - restitution); }

double Drop::height_at(double t) const {
  if (t >= rest_time()) return 0.0;
  if (t < fall_time()) return height - 0.5 * gravity * t * t;
  double speed = restitution * gravity * fall_time(), since = fall_time();
  while (t - since > 2.0 * speed / gravity) {
    since += 2.0 * speed / gravity;
    speed *= restitution;
  }
  const double s = t - since;
  return speed * s - 0.5 * gravity * s * s;
}

}  // namespace rotorub::oracle
