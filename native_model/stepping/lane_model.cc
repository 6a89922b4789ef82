#include "native_model/stepping/lane_model.h"

#include <algorithm>
#include <cassert>
#include <tuple>
#include <utility>

namespace rotorub {
namespace {

template <class T>
lanes::Array<T> side_by_side(const std::vector<const Model*>& models, auto of) {
  lanes::Array<T> out(static_cast<std::size_t>(of(*models.front()).size()), T{});
  int lane = 0;
  for (const Model* m : models) put_lane(out, of(*m), lane++);
  return out;
}

template <class T>
T number(const std::vector<const Model*>& models, auto of) {
  T out{};
  int lane = 0;
  for (const Model* m : models) lanes::set(out, lane++, of(*m));
  return out;
}

template <class T>
typename LaneModel<T>::Shape shape(const std::vector<const Model*>& models, auto of) {
  return {
      side_by_side<T>(models, [&](const Model& m) -> const Eigen::VectorXd& { return of(m).x; }),
      side_by_side<T>(models, [&](const Model& m) -> const Eigen::VectorXd& { return of(m).y; })};
}

template <class T>
typename LaneModel<T>::Plane plane(const std::vector<const Model*>& models, auto of) {
  return {{number<T>(models, [&](const Model& m) { return of(m).x(); }),
           number<T>(models, [&](const Model& m) { return of(m).y(); })}};
}

// Of the fullest kind that one of the lanes has.
template <class T>
BasicModeMatrix<T> matrix(const std::vector<const Model*>& models, auto of) {
  auto kind = ModeMatrix::Kind::kAbsent;
  for (const Model* m : models) kind = std::max(kind, of(*m).kind());
  if (kind == ModeMatrix::Kind::kAbsent) return {};
  const int n = models.front()->layout.modes;
  const bool full = kind == ModeMatrix::Kind::kFull;
  const auto flat = [&](const Model& m) -> Eigen::VectorXd {
    const Eigen::MatrixXd dense = of(m).dense(n);
    if (full) return dense.reshaped();
    return dense.diagonal();
  };
  return {static_cast<typename BasicModeMatrix<T>::Kind>(kind), side_by_side<T>(models, flat), n};
}

}  // namespace

template <class T>
LaneModel<T>::LaneModel(const std::vector<const Model*>& all)
    : models(all), layout(all.front()->layout) {
  assert(models.size() == static_cast<std::size_t>(lanes::kWidth<T>));
  const Model& first = *all.front();
  const auto vector = [&](auto member) {
    return side_by_side<T>(all,
                           [=](const Model& m) -> const Eigen::VectorXd& { return m.*member; });
  };
  mass = vector(&Model::mass);
  stiffness = vector(&Model::stiffness);
  damping = vector(&Model::damping);
  weight = vector(&Model::weight);
  if (first.base) gravity_mass = vector(&Model::gravity_mass);
  drive_shape = vector(&Model::drive_shape);
  gyroscopic = matrix<T>(all, [](const Model& m) { return m.gyroscopic; });
  internal_xx = matrix<T>(all, [](const Model& m) { return m.internal_xx; });
  internal_xy = matrix<T>(all, [](const Model& m) { return m.internal_xy; });
  internal_yy = matrix<T>(all, [](const Model& m) { return m.internal_yy; });
  bearing = {
      shape<T>(all, [](const Model& m) -> const ModeShape& { return m.first().shape; }),
      side_by_side<T>(
          all, [](const Model& m) -> const Eigen::VectorXd& { return m.first().torsion_shape; }),
      plane<T>(all, [](const Model& m) -> const Eigen::Vector2d& { return m.first().ring_offset; }),
      number<T>(all, [](const Model& m) { return m.first().ring_ratio; }),
      first.first().ring,
      first.first().ring_angle};
  for (std::size_t i = 0; i < first.dampers.size(); ++i) {
    const auto of = [i](const Model& m) -> const StationDamper& { return m.dampers[i]; };
    dampers.push_back(
        {shape<T>(all, [&](const Model& m) -> const ModeShape& { return of(m).shape; }),
         plane<T>(all, [&](const Model& m) { return of(m).damping; })});
  }
  for (std::size_t i = 0; i < first.films.size(); ++i) {
    const auto of = [i](const Model& m) -> const StationFilm& { return m.films[i]; };
    BearingFilm<T> law;
    for (std::size_t k = 0; k < law.constant.size(); ++k) {
      law.constant[k] = number<T>(all, [&](const Model& m) { return of(m).law.constant[k]; });
    }
    law.offset_x = number<T>(all, [&](const Model& m) { return of(m).law.offset_x; });
    law.offset_y = number<T>(all, [&](const Model& m) { return of(m).law.offset_y; });
    for (const Model* m : all) {
      if (of(*m).law.follows()) law.tables.push_back(of(*m).law.tables.front());
    }
    films.push_back({shape<T>(all, [&](const Model& m) -> const ModeShape& { return of(m).shape; }),
                     std::move(law)});
  }
  for (std::size_t i = 0; i < first.springs.size(); ++i) {
    const auto of = [i](const Model& m) -> const StationSpring& { return m.springs[i]; };
    springs.push_back(
        {shape<T>(all, [&](const Model& m) -> const ModeShape& { return of(m).shape; }),
         plane<T>(all, [&](const Model& m) { return of(m).stiffness; })});
  }
  for (std::size_t i = 0; i < first.feedbacks.size(); ++i) {
    const auto of = [i](const Model& m) -> const StationFeedback& { return m.feedbacks[i]; };
    const auto law = [&](auto member) {
      return number<T>(all, [=](const Model& m) { return of(m).law.*member; });
    };
    using Law = MagneticFeedback<double>;
    const auto coil = [&](auto member) {
      return number<T>(all, [=](const Model& m) { return of(m).law.amplifier.*member; });
    };
    const auto magnets = [&](auto member) {
      return number<T>(all, [=](const Model& m) { return of(m).law.magnets.*member; });
    };
    using Magnets = OpposedMagnets<double>;
    feedbacks.push_back(
        {shape<T>(all, [&](const Model& m) -> const ModeShape& { return of(m).shape; }),
         {.negative_stiffness = law(&Law::negative_stiffness),
          .force_per_current = law(&Law::force_per_current),
          .proportional = law(&Law::proportional),
          .derivative = law(&Law::derivative),
          .current_limit = law(&Law::current_limit),
          .held = law(&Law::held),
          .integral = law(&Law::integral),
          .derivative_lag = law(&Law::derivative_lag),
          .amplifier = {coil(&Coil<double>::lag), coil(&Coil<double>::rate_limit),
                        coil(&Coil<double>::voltage_limit), coil(&Coil<double>::inductance),
                        coil(&Coil<double>::resistance)},
          .opposed = of(first).law.opposed,
          .magnets = {magnets(&Magnets::force_constant), magnets(&Magnets::bias_current),
                      magnets(&Magnets::air_gap)}},
         {},
         of(first).states});
    if (!of(first).sensor) continue;
    feedbacks.back().sensor =
        shape<T>(all, [&](const Model& m) -> const ModeShape& { return *of(m).sensor; });
  }
  for (std::size_t i = 0; i < first.unbalances.size(); ++i) {
    const auto of = [i](const Model& m) -> const DiscUnbalance& { return m.unbalances[i]; };
    unbalances.push_back(
        {shape<T>(all, [&](const Model& m) -> const ModeShape& { return of(m).shape; }),
         number<T>(all, [&](const Model& m) { return of(m).static_moment; }),
         number<T>(all, [&](const Model& m) { return of(m).phase; }),
         number<T>(all, [&](const Model& m) { return of(m).on; })});
  }
  speed = number<T>(all, [](const Model& m) { return m.speed; });
  spin_angle = number<T>(all, [](const Model& m) { return m.spin_angle; });
  linear_drive = first.drive && first.drive->kind() == scene::DriveKind::kLinear;
  following_drive = first.drive_follows();
  drive_angle = number<T>(all, [](const Model& m) { return m.drive_angle; });
  if (linear_drive) {
    drive_gain = number<T>(all, [](const Model& m) { return -m.drive->slope(0.0); });
    drive_speed = number<T>(all, [](const Model& m) { return m.drive->target(); });
  }
}

bool same_structure(const Model& a, const Model& b) {
  const auto structure = [](const Model& m) {
    std::vector<int> forces;
    for (const AppliedForce& f : m.forces) forces.push_back(static_cast<int>(f.kind));
    std::vector<bool> films;
    for (const StationFilm& film : m.films) films.push_back(film.law.follows());
    std::vector<std::tuple<int, int, int, int, bool, bool>> feedbacks;
    for (const StationFeedback& f : m.feedbacks) {
      feedbacks.emplace_back(f.states.stored, f.states.filtered, f.states.current, f.states.command,
                             f.sensor.has_value(), f.law.opposed);
    }
    const Layout& l = m.layout;
    return std::tuple(
        l.modes, l.spin, l.torsion, l.stator, l.ring_spin, l.integrals, l.coils, forces, films,
        m.springs.size(), feedbacks, m.dampers.size(), m.unbalances.size(), m.weight.size(),
        m.base != nullptr, m.drive ? static_cast<int>(m.drive->kind()) : -1, m.auxiliary.size(),
        m.first().contact.has_value(), m.first().magnets.has_value(), m.gyroscopic.absent(),
        m.internal_xx.absent(), m.internal_yy.absent(), m.first().commanded());
  };
  return structure(a) == structure(b);
}

template struct LaneModel<lanes::Lane<2>>;
template struct LaneModel<lanes::Lane<4>>;
template struct LaneModel<lanes::Lane<8>>;

}  // namespace rotorub
