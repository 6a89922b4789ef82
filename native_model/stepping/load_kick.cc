#include "native_model/stepping/load_kick.h"

#include <algorithm>
#include <cmath>

#include "native_model/system/actuation.h"

namespace rotorub {
namespace {

// What a magnetic bearing does leaves its linear law, of which the damper is in the matrix.
bool feedback_switches(const Model& m) {
  return std::any_of(m.feedbacks.begin(), m.feedbacks.end(), [](const StationFeedback& bearing) {
    const MagneticFeedback<double>& law = bearing.law;
    const bool constant = std::ranges::all_of(
        bearing.works.all(), [](double t) { return t <= 0.0 || t >= scene::kNever; });
    if (law.damping() == 0.0 || (constant && !bearing.works.at(0.0))) return false;
    return std::isfinite(law.current_limit) || law.opposed || !constant;
  });
}

// At a limit of its amplifier the mean of a coil's rates, under the command before a jump and that
// after it, is not its rate under the mean command.
void add_jump(const Model& m, std::size_t bearing, const CommandJump& jump,
              const Eigen::Vector2d& asked, const double* v, double* f) {
  constexpr double kRoundOff = 1e-9;
  if (jump.share == 0.0 || bearing >= m.auxiliary.size()) return;
  const AuxiliaryBearing& at = m.auxiliary[bearing];
  if (at.coil == kAbsent) return;
  const double early = jump.share, late = 1.0 - early;
  const Eigen::Vector2d mean = early * jump.before + late * jump.after;
  // A part of the kick has one of the two.
  if ((asked - mean).norm() > kRoundOff * (jump.after - jump.before).norm()) return;
  for (int i = 0; i < 2; ++i) {
    const auto load = [&](double command) {
      return coil_load(*at.magnets, command, v[at.coil + i]);
    };
    f[at.coil + i] += early * load(jump.before[i]) + late * load(jump.after[i]) - load(asked[i]);
  }
}

}  // namespace

bool beyond_matrix(const std::vector<const Model*>& models) {
  const Model& m = *models.front();
  const Layout& l = m.layout;
  const bool turns = l.spin && (!m.gyroscopic.absent() || !m.internal_xx.absent() ||
                                !m.internal_yy.absent() || m.coupled_mass());
  const bool curve = m.drive && m.drive->kind() != scene::DriveKind::kLinear &&
                     m.drive->kind() != scene::DriveKind::kFree;
  // Bearings follow the spin, where that is free.
  const bool follows = l.spin && std::ranges::any_of(m.films, [](const StationFilm& film) {
                         return film.law.follows();
                       });
  const bool switches =
      std::ranges::any_of(models, [](const Model* of) { return feedback_switches(*of); });
  return turns || curve || follows || switches || l.integrals > 0 || l.coils > 0 ||
         !m.supports.empty();
}

template <class M>
void LoadKick<M>::add_actuators(const State& x, const T* v, T* f) const {
  double run_q[kMaxCoordinates], run_v[kMaxCoordinates], run_f[kMaxCoordinates];
  std::array<Eigen::Vector2d, kMaxContacts> asked;
  const int nq = x.nq();
  for (int lane = 0; lane < kLanes; ++lane) {
    read_lane(x, x.seen, lane, run_q);
    for (int i = 0; i < nq; ++i) {
      run_v[i] = lanes::get(v[i], lane);
      run_f[i] = lanes::get(f[i], lane);
    }
    for (std::size_t b = 0; b < command.size(); ++b) {
      asked[b] = {lanes::get(command[b].x, lane), lanes::get(command[b].y, lane)};
    }
    const Model& m = lane_model(x.m, lane);
    rotorub::add_actuators(m, run_q, run_v, asked, run_f);
    for (std::size_t i = 0; i < jumps.size(); ++i) {
      if (kLanes == 1) {
        add_jump(m, i, jumps[i], asked[i], run_v, run_f);
      } else if (static_cast<int>(i) == lane) {
        add_jump(m, 0, jumps[i], asked[0], run_v, run_f);
      }
    }
    for (int i = 0; i < nq; ++i) lanes::set(f[i], lane, run_f[i]);
  }
}

template <class M>
void LoadKick<M>::find_samples(const State& x, double t, double begin) {
  sampled_now_ = false;
  double q[kMaxCoordinates], v[kMaxCoordinates], after[kMaxCoordinates];
  const int first = x.m.layout.integral(), count = x.m.layout.integrals;
  const double share = begin == t ? 1.0 : 0.5;  // of the kick that comes after the sample
  for (int lane = 0; lane < kLanes; ++lane) {
    const Model& m = lane_model(x.m, lane);
    read_lane(x, x.seen, lane, q);
    read_lane(x, x.start, lane, v);
    std::copy_n(v, x.nq(), after);
    sampled_now_ |= take_samples(m, t, x.h, q, after);
    for (int i = 0; i < count; ++i) {
      const double mass = lanes::get(x.m.mass.data()[first + i], lane);
      const double jump = 2.0 * share * (after[first + i] - v[first + i]);
      lanes::set(sampled_[static_cast<std::size_t>(i)], lane, mass * jump / x.h);
    }
    for (std::size_t k = 0; k < m.feedbacks.size(); ++k) {
      const int at = m.feedbacks[k].states.command;
      if (at == kAbsent) continue;
      KickCommand& c = commands_[k];
      const auto note = [&](int i, T& early, T& mean, T& late) {
        lanes::set(early, lane, v[i]);
        lanes::set(mean, lane, v[i] + share * (after[i] - v[i]));
        lanes::set(late, lane, after[i]);
      };
      note(at, c.before.x, c.mean.x, c.after.x);
      note(at + 1, c.before.y, c.mean.y, c.after.y);
    }
  }
}

template <class M>
void LoadKick<M>::add_samples(const M& m, T* f) const {
  for (int i = 0; i < m.layout.integrals; ++i) {
    f[m.layout.integral() + i] += sampled_[static_cast<std::size_t>(i)];
  }
  for (std::size_t k = 0; k < m.feedbacks.size(); ++k) {
    const auto& bearing = m.feedbacks[k];
    const KickCommand& c = commands_[k];
    if (bearing.states.command == kAbsent) continue;
    if (const int at = bearing.states.current; at != kAbsent) {
      f[at] += m.mass[static_cast<std::size_t>(at)] * c.rate.x;
      f[at + 1] += m.mass[static_cast<std::size_t>(at) + 1] * c.rate.y;
    } else {
      equations::add_station_force<T>(m.layout.modes, bearing.shape, c.force.x, c.force.y, f);
    }
  }
}

template <class M>
void LoadKick<M>::find_working(const State& x, const T& begin, const T& end) {
  for (std::size_t k = 0; k < x.m.feedbacks.size(); ++k) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const WorkingTimes& works = lane_model(x.m, lane).feedbacks[k].works;
      lanes::set(working_[k], lane, works.share(lanes::get(begin, lane), lanes::get(end, lane)));
    }
  }
  if (sampled_now_) find_switched(x, begin, end);
}

template <class M>
void LoadKick<M>::find_switched(const State& x, const T& begin, const T& end) {
  double q[kMaxCoordinates];
  for (int lane = 0; lane < kLanes; ++lane) {
    const Model& m = lane_model(x.m, lane);
    read_lane(x, x.seen, lane, q);
    const double from = lanes::get(begin, lane), to = lanes::get(end, lane);
    const double sample = std::clamp(instant_, from, to);
    for (std::size_t k = 0; k < m.feedbacks.size(); ++k) {
      const StationFeedback& bearing = m.feedbacks[k];
      if (bearing.states.command == kAbsent) continue;
      const MagneticFeedback<double>& law = bearing.law;
      const double share = lanes::get(working_[k], lane);
      const double early = bearing.works.share(from, sample) * (sample - from) / (to - from);
      const double late = share - early;
      KickCommand& c = commands_[k];
      const auto r = equations::at_station(m.layout.modes, bearing.shape, q);
      const auto beyond_mean = [&](const T& of_before, const T& of_mean, const T& of_after,
                                   double place, int current, T& force, T& rate) {
        const double before = lanes::get(of_before, lane), mean = lanes::get(of_mean, lane),
                     after = lanes::get(of_after, lane);
        lanes::set(force, lane, 0.0);
        lanes::set(rate, lane, 0.0);
        if (before == after) return;  // of another lane's sample
        if (current == kAbsent) {
          lanes::set(force, lane,
                     law.force(early, place, before) + law.force(late, place, after) -
                         law.force(share, place, mean) - law.held * place);
          return;
        }
        const double i = lanes::get(x.start[static_cast<std::size_t>(current)], lane);
        const auto load = [&](double asked) { return law.amplifier.load(asked, i); };
        lanes::set(
            rate, lane,
            (early * load(before) + late * load(after) - share * load(mean)) / law.amplifier.lag);
      };
      const int at = bearing.states.current;
      beyond_mean(c.before.x, c.mean.x, c.after.x, r.x, at, c.force.x, c.rate.x);
      beyond_mean(c.before.y, c.mean.y, c.after.y, r.y, at == kAbsent ? at : at + 1, c.force.y,
                  c.rate.y);
    }
  }
}

#define ROTORUB_DEFINE(...)                                                             \
  template void LoadKick<__VA_ARGS__>::add_actuators(const State&, const T*, T*) const; \
  template void LoadKick<__VA_ARGS__>::find_samples(const State&, double, double);      \
  template void LoadKick<__VA_ARGS__>::add_samples(const __VA_ARGS__&, T*) const;       \
  template void LoadKick<__VA_ARGS__>::find_working(const State&, const T&, const T&);  \
  template void LoadKick<__VA_ARGS__>::find_switched(const State&, const T&, const T&);
ROTORUB_ALL_MODELS(ROTORUB_DEFINE)
#undef ROTORUB_DEFINE

}  // namespace rotorub
