#include "compare/metrics/attractor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rotorub {
namespace {

constexpr std::size_t kFewestRows = 20;

double mean(const std::vector<double>& values, RowRange range) {
  double sum = 0.0;
  for (std::size_t i = range.first; i < range.last; ++i) sum += values[i];
  return sum / static_cast<double>(range.size());
}

// Median of |slip| over the largest of |whirl speed| and |r Omega| = |slip - whirl speed|.
double relative_slip(const std::vector<RelativePoint>& points, const std::vector<double>& slip,
                     RowRange range) {
  std::vector<double> ratio;
  ratio.reserve(range.size());
  for (std::size_t i = range.first; i < range.last; ++i) {
    const double whirl = std::abs(points[i].whirl_speed);
    const double surface = std::abs(slip[i] - points[i].whirl_speed);
    const double scale = std::max(whirl, surface);
    ratio.push_back(scale > 0.0 ? std::abs(slip[i]) / scale : 0.0);
  }
  const auto middle = ratio.begin() + static_cast<std::ptrdiff_t>(ratio.size() / 2);
  std::nth_element(ratio.begin(), middle, ratio.end());
  return *middle;
}

// span: s, of the rows looked at.
Attractor permanent(const Settled& s, double slip, double span) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  if (std::abs(s.whirl_frequency) * span < kRestingTurn * kTurn) return Attractor::kResting;
  if (slip < kRollingTolerance) return Attractor::kRolling;
  if (s.whirl_frequency < 0.0) return Attractor::kBackwardWhip;
  const bool synchronous =
      std::abs(s.whirl_frequency - s.spin_speed) <= kSynchronousTolerance * std::abs(s.spin_speed);
  return synchronous ? Attractor::kSynchronousRub : Attractor::kForwardRub;
}

}  // namespace

const char* to_string(Attractor attractor) {
  switch (attractor) {
    case Attractor::kNoContact:
      return "no contact";
    case Attractor::kChattering:
      return "chattering";
    case Attractor::kResting:
      return "resting";
    case Attractor::kSynchronousRub:
      return "synchronous rub";
    case Attractor::kForwardRub:
      return "forward rub";
    case Attractor::kBackwardWhip:
      return "backward whip";
    case Attractor::kRolling:
      return "rolling";
    case Attractor::kUnknown:
      return "unknown";
  }
  return "unknown";
}

const char* explanation(Attractor attractor) {
  switch (attractor) {
    case Attractor::kNoContact:
      return "nothing touches in the last fifth of the run";
    case Attractor::kChattering:
      return "contact comes and goes in the last fifth of the run";
    case Attractor::kResting:
      return "permanent contact at one place of the ring";
    case Attractor::kSynchronousRub:
      return "permanent contact that whirls forward with the spin (full annular rub)";
    case Attractor::kForwardRub:
      return "permanent contact that whirls forward, but not with the spin";
    case Attractor::kBackwardWhip:
      return "permanent contact that whirls backward and slips (dry-friction whip)";
    case Attractor::kRolling:
      return "permanent contact that rolls in the ring without slip";
    case Attractor::kUnknown:
      return "too few rows to tell";
  }
  return "";
}

Settled settled(const Trajectory& trajectory) {
  Settled s;
  s.from = (1.0 - kSettledShare) * trajectory.end;
  const auto points = relative_motion(trajectory);
  const RowRange range = rows_between(points, s.from, trajectory.end);
  if (range.size() < kFewestRows) return s;

  const auto& normal = trajectory.column("normal_force");
  std::size_t touching = 0;
  for (std::size_t i = range.first; i < range.last; ++i) touching += normal[i] > 0.0 ? 1 : 0;
  s.contact_share = static_cast<double>(touching) / static_cast<double>(range.size());
  s.impacts = static_cast<std::size_t>(
      std::count_if(trajectory.impacts.begin(), trajectory.impacts.end(),
                    [&](const Impact& i) { return i.t >= s.from && counts(i); }));
  s.whirl_frequency = whirl_frequency(points, range);
  s.spin_speed = mean(trajectory.column("spin_speed"), range);

  if (touching == 0 && s.impacts == 0) {
    s.attractor = Attractor::kNoContact;
  } else if (s.contact_share < kPermanentContact) {
    s.attractor = Attractor::kChattering;
  } else {
    s.attractor = permanent(s, relative_slip(points, trajectory.column("slip"), range),
                            points[range.last - 1].t - points[range.first].t);
  }
  return s;
}

}  // namespace rotorub
