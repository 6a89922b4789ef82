#include "native_model/bearing/drive.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rotorub {
namespace {

// Kloss's formula without 0/0: T = 2 T_b s s_b / (s^2 + s_b^2).
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
    table_ = MonotoneCubic(drive_.table_speed, drive_.table_torque);
  }
}

double Drive::torque(double speed) const {
  switch (drive_.kind) {
    case scene::DriveKind::kFree:
      return 0.0;
    case scene::DriveKind::kLinear:
      return drive_.gain * (drive_.speed - speed);
    case scene::DriveKind::kKloss:
      return kloss(drive_, 1.0 - speed / drive_.synchronous_speed);
    case scene::DriveKind::kSpeedControlled:
      assert(false);
      return 0.0;
    case scene::DriveKind::kTable:
      break;
  }
  return table_.value(speed);
}

double Drive::torque(double t, double angle, double speed) const {
  if (!follows()) return torque(speed);
  // a_ref: the reference's mean times the elapsed part of the ramp, then the target speed.
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
    case scene::DriveKind::kFree:
      return 0.0;
    case scene::DriveKind::kLinear:
    case scene::DriveKind::kSpeedControlled:
      return -drive_.gain;
    case scene::DriveKind::kKloss:
      return kloss_slope(drive_, 1.0 - speed / drive_.synchronous_speed);
    case scene::DriveKind::kTable:
      break;
  }
  return table_.slope(speed);
}

}  // namespace rotorub
