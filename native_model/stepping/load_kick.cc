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
    rotorub::add_actuators(lane_model(x.m, lane), run_q, run_v, asked, run_f);
    for (int i = 0; i < nq; ++i) lanes::set(f[i], lane, run_f[i]);
  }
}

template <class M>
void LoadKick<M>::find_samples(const State& x, double t, double begin) {
  sampled_now_ = false;
  double q[kMaxCoordinates], v[kMaxCoordinates], after[kMaxCoordinates];
  const int first = x.m.layout.integral(), count = x.m.layout.integrals;
  for (int lane = 0; lane < kLanes; ++lane) {
    read_lane(x, x.seen, lane, q);
    read_lane(x, x.start, lane, v);
    std::copy_n(v, x.nq(), after);
    sampled_now_ |= take_samples(lane_model(x.m, lane), t, x.h, q, after);
    for (int i = 0; i < count; ++i) {
      const double mass = lanes::get(x.m.mass.data()[first + i], lane);
      const double jump = (begin == t ? 2.0 : 1.0) * (after[first + i] - v[first + i]);
      lanes::set(sampled_[static_cast<std::size_t>(i)], lane, mass * jump / x.h);
    }
  }
}

template <class M>
void LoadKick<M>::find_working(const M& m, const T& begin, const T& end) {
  for (std::size_t k = 0; k < m.feedbacks.size(); ++k) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const WorkingTimes& works = lane_model(m, lane).feedbacks[k].works;
      lanes::set(working_[k], lane, works.share(lanes::get(begin, lane), lanes::get(end, lane)));
    }
  }
}

#define ROTORUB_DEFINE(...)                                                             \
  template void LoadKick<__VA_ARGS__>::add_actuators(const State&, const T*, T*) const; \
  template void LoadKick<__VA_ARGS__>::find_samples(const State&, double, double);      \
  template void LoadKick<__VA_ARGS__>::find_working(const __VA_ARGS__&, const T&, const T&);
ROTORUB_ALL_MODELS(ROTORUB_DEFINE)
#undef ROTORUB_DEFINE

}  // namespace rotorub
