#include "native_model/bearing/drive.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rotorub {
namespace {

// Tangents of the monotone piecewise cubic of Fritsch and Carlson (1980): no overshoot between
// the points of a table.
std::vector<double> monotone_tangents(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  std::vector<double> secant(n - 1), tangent(n);
  for (std::size_t i = 0; i + 1 < n; ++i) secant[i] = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
  tangent.front() = secant.front();
  tangent.back() = secant.back();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    tangent[i] = secant[i - 1] * secant[i] > 0.0 ? 0.5 * (secant[i - 1] + secant[i]) : 0.0;
  }
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (secant[i] == 0.0) {
      tangent[i] = tangent[i + 1] = 0.0;
      continue;
    }
    const double a = tangent[i] / secant[i], b = tangent[i + 1] / secant[i];
    const double radius = std::hypot(a, b);
    if (radius > 3.0) {
      tangent[i] = 3.0 / radius * a * secant[i];
      tangent[i + 1] = 3.0 / radius * b * secant[i];
    }
  }
  return tangent;
}

// Kloss without 0/0: T = 2 T_b s s_b / (s^2 + s_b^2).
double kloss(const scene::Drive& d, double slip) {
  const double sb = d.breakdown_slip;
  return 2.0 * d.breakdown_torque * slip * sb / (slip * slip + sb * sb);
}

double kloss_slope(const scene::Drive& d, double slip) {
  const double sb2 = d.breakdown_slip * d.breakdown_slip, s2 = slip * slip;
  const double per_slip =
      2.0 * d.breakdown_torque * d.breakdown_slip * (sb2 - s2) / ((s2 + sb2) * (s2 + sb2));
  return -per_slip / d.synchronous_speed;
}

}  // namespace

Drive::Drive(const scene::Drive& drive, double start) : drive_(drive), start_(start) {
  if (follows()) ramp_end_ = std::abs(drive_.speed - start_) / drive_.acceleration;
  if (drive_.kind == scene::DriveKind::kTable) {
    tangents_ = monotone_tangents(drive_.table_speed, drive_.table_torque);
  }
}

double Drive::torque(double speed) const {
  switch (drive_.kind) {
    case scene::DriveKind::kFree: return 0.0;
    case scene::DriveKind::kLinear: return drive_.gain * (drive_.speed - speed);
    case scene::DriveKind::kKloss:
      return kloss(drive_, 1.0 - speed / drive_.synchronous_speed);
    case scene::DriveKind::kSpeedControlled:
      assert(false);
      return 0.0;
    case scene::DriveKind::kTable: break;
  }
  const auto &x = drive_.table_speed, &y = drive_.table_torque;
  if (speed <= x.front()) return y.front();
  if (speed >= x.back()) return y.back();
  const auto i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), speed) - x.begin() - 1);
  const double h = x[i + 1] - x[i], s = (speed - x[i]) / h;
  const double s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * y[i] + (s3 - 2 * s2 + s) * h * tangents_[i] +
         (3 * s2 - 2 * s3) * y[i + 1] + (s3 - s2) * h * tangents_[i + 1];
}

double Drive::torque(double t, double angle, double speed) const {
  if (!follows()) return torque(speed);
  // The mean of start and present reference over what has passed of the ramp, then the target.
  const double rising = std::min(t, ramp_end_);
  const double reference =
      rising < ramp_end_ ? start_ + (drive_.speed - start_) * (rising / ramp_end_) : drive_.speed;
  const double left = 0.5 * (start_ + reference) * rising + drive_.speed * (t - rising) - angle;
  const auto limited = [most = drive_.torque_limit](double torque) {
    return std::clamp(torque, -most, most);
  };
  return limited(drive_.gain * (reference - speed) + limited(drive_.integral_gain * left));
}

double Drive::slope(double speed) const {
  switch (drive_.kind) {
    case scene::DriveKind::kFree: return 0.0;
    case scene::DriveKind::kLinear:
    case scene::DriveKind::kSpeedControlled: return -drive_.gain;
    case scene::DriveKind::kKloss:
      return kloss_slope(drive_, 1.0 - speed / drive_.synchronous_speed);
    case scene::DriveKind::kTable: break;
  }
  const auto &x = drive_.table_speed, &y = drive_.table_torque;
  if (speed <= x.front() || speed >= x.back()) return 0.0;
  const auto i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), speed) - x.begin() - 1);
  const double h = x[i + 1] - x[i], s = (speed - x[i]) / h;
  const double s2 = s * s;
  return (6 * s2 - 6 * s) * (y[i] - y[i + 1]) / h + (3 * s2 - 4 * s + 1) * tangents_[i] +
         (3 * s2 - 2 * s) * tangents_[i + 1];
}

}  // namespace rotorub
