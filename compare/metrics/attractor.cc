#include "compare/metrics/attractor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <type_traits>

#include "compare/metrics/orbit.h"
#include "compare/metrics/rows.h"
#include "native_model/trajectory/columns.h"

namespace rotorub {
namespace {

struct AttractorName {
  const char *name, *explanation;
};
// In the order of Attractor.
constexpr std::array kNames{
    AttractorName{"no contact", "nothing touches at the end of the run"},
    AttractorName{"bouncing", "contact comes and goes in the last fifth of the run"},
    AttractorName{"resting", "permanent contact at one place of the ring, or rocking about it"},
    AttractorName{"synchronous rub",
                  "permanent contact that whirls forward with the spin (full annular rub)"},
    AttractorName{"forward rub", "permanent contact that whirls forward, but not with the spin"},
    AttractorName{"backward whip",
                  "permanent contact that whirls backward and slips (dry-friction whip)"},
    AttractorName{"rolling",
                  "permanent contact that whirls backward and rolls in the ring without slip"},
    AttractorName{"unknown", "too few rows to tell, or too far apart: take a smaller output_step"}};

constexpr std::size_t kFewestRows = 20;

// Median of |slip| relative to the larger of |whirl speed| and |r Omega| = |slip - whirl speed|.
double relative_slip(const LastPart& part) {
  std::vector<double> ratio;
  ratio.reserve(part.points.size());
  for (std::size_t i = 0; i < part.points.size(); ++i) {
    const double whirl = std::abs(part.points[i].whirl_speed);
    const double surface = std::abs(part.slip[i] - part.points[i].whirl_speed);
    const double scale = std::max(whirl, surface);
    ratio.push_back(scale > 0.0 ? std::abs(part.slip[i]) / scale : 0.0);
  }
  const auto middle = ratio.begin() + static_cast<std::ptrdiff_t>(ratio.size() / 2);
  std::nth_element(ratio.begin(), middle, ratio.end());
  return *middle;
}

// net: angle that the rows travel around the ring, rad; all: the same back and forth.
Attractor permanent(const Settled& s, double slip, double net, double all) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  if (std::isnan(s.whirl_frequency)) return Attractor::kUnknown;
  if (std::abs(net) < kRestingTurn * kTurn || std::abs(net) < kRockingShare * all)
    return Attractor::kResting;
  // With a turning ring, a rub can roll forward too.
  if (s.whirl_frequency * (s.spin_speed < 0.0 ? -1.0 : 1.0) < 0.0)
    return slip < kRollingTolerance ? Attractor::kRolling : Attractor::kBackwardWhip;
  const bool synchronous =
      std::abs(s.whirl_frequency - s.spin_speed) <= kSynchronousTolerance * std::abs(s.spin_speed);
  return synchronous ? Attractor::kSynchronousRub : Attractor::kForwardRub;
}

// The period of bouncing. times: of its impacts, s, ascending.
void find_period(const Trajectory& run, const std::vector<double>& times, Settled& s) {
  s.turns = section_period(poincare_points(run, s.from));
  if (s.turns == 0) return;
  std::vector<double> passes;
  for (const KeyphasorPass& pass : run.keyphasor) {
    if (pass.t >= s.from) passes.push_back(pass.t);
  }
  const auto turns = static_cast<std::size_t>(s.turns), periods = (passes.size() - 1) / turns;
  const double begin = passes[passes.size() - 1 - periods * turns], end = passes.back();
  const auto met = std::ranges::count_if(times, [&](double t) { return t > begin && t <= end; });
  // An impact at the mark itself may fall on either side of it, at both ends.
  const double each = static_cast<double>(met) / static_cast<double>(periods);
  if (std::abs(std::round(each) * static_cast<double>(periods) - static_cast<double>(met)) <= 1.0)
    s.bounces = static_cast<int>(std::round(each));
}

}  // namespace

const char* to_string(Attractor attractor) {
  return kNames.at(static_cast<std::size_t>(attractor)).name;
}

const char* explanation(Attractor attractor) {
  return kNames.at(static_cast<std::size_t>(attractor)).explanation;
}

std::string described(const Settled& s) {
  const std::string name = to_string(s.attractor);
  if (s.turns == 0) return name;
  const std::string every = s.turns == 1 ? "every turn" : fmt::format("every {} turns", s.turns);
  if (s.bounces == 0) return fmt::format("{}, the same {}", name, every);
  return fmt::format("{} {} {}", name,
                     s.bounces == 1   ? "once"
                     : s.bounces == 2 ? "twice"
                                      : fmt::format("{} times", s.bounces),
                     every);
}

bool has_ended(const LastPart& part) {
  std::vector<double> touches = part.impact_times;
  for (std::size_t i = 0; i < part.points.size(); ++i) {
    if (part.normal_force[i] > 0.0) touches.push_back(part.points[i].t);
  }
  if (touches.empty()) return true;
  std::sort(touches.begin(), touches.end());
  double longest = 0.0;
  for (std::size_t i = 1; i < touches.size(); ++i)
    longest = std::max(longest, touches[i] - touches[i - 1]);
  const double end = part.points.back().t;
  return end - touches.back() > std::max(0.5 * (end - part.from), 2.0 * longest);
}

Settled settled(const LastPart& part) {
  Settled s;
  s.from = part.from;
  s.impacts = part.impacts;
  s.spin_speed = part.spin_speed;
  const std::size_t rows = part.points.size();
  if (rows < kFewestRows) return s;

  std::size_t touching = 0;
  for (const double force : part.normal_force) touching += force > 0.0 ? 1 : 0;
  s.contact_share = static_cast<double>(touching) / static_cast<double>(rows);
  s.whirl_frequency = whirl_frequency(part.points, {0, rows});

  if (has_ended(part)) {
    s.attractor = Attractor::kNoContact;
  } else if (s.contact_share < kPermanentContact) {
    s.attractor = Attractor::kBouncing;
  } else {
    const Turned turned = turned_by(part.points, {0, rows});
    s.attractor = permanent(s, relative_slip(part), turned.net, turned.all);
  }
  return s;
}

Settled settled(const Trajectory& trajectory) {
  LastPart part;
  part.from = (1.0 - kSettledShare) * trajectory.end;
  RowRange range;
  const auto rows = [&](const auto& all) {
    const auto at = [&](std::size_t i) { return all.begin() + static_cast<std::ptrdiff_t>(i); };
    return std::decay_t<decltype(all)>(at(range.first), at(range.last));
  };
  std::ptrdiff_t most = -1;  // rows in contact
  for (std::size_t k = 0; k < trajectory.contacts; ++k) {
    const auto points = relative_motion(trajectory, k);
    range = rows_between(points, part.from, trajectory.end);
    const auto force = rows(trajectory.column(column_of_contact(k, "normal_force")));
    const auto closed = std::ranges::count_if(force, [](double f) { return f > 0.0; });
    if (closed > most) {
      most = closed;
      part.points = rows(points);
      part.slip = rows(trajectory.column(column_of_contact(k, "slip")));
    }
    part.normal_force.resize(force.size(), 0.0);
    std::ranges::transform(force, part.normal_force, part.normal_force.begin(), std::plus{});
  }
  if (trajectory.rows() > 1)
    part.spin_speed = mean_speed(trajectory, "spin_angle", "spin_speed", part.from);
  for (const Impact& impact : trajectory.impacts) {
    if (impact.t >= part.from && counts(impact)) part.impact_times.push_back(impact.t);
  }
  part.impacts = part.impact_times.size();
  Settled s = settled(part);
  if (s.attractor == Attractor::kBouncing) find_period(trajectory, part.impact_times, s);
  return s;
}

}  // namespace rotorub
