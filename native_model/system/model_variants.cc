// A model as other questions need it: without a part, driven by what another run recorded, or as a
// linear plant.

#include <cassert>
#include <limits>
#include <utility>

#include "native_model/control/quadratic.h"
#include "native_model/dynamics/linear_parts.h"
#include "native_model/system/model.h"

namespace rotorub {

Model without_coils(Model model) {
  const int kept = model.layout.coil();
  model.layout.coils = 0;
  for (AuxiliaryBearing& bearing : model.auxiliary) bearing.coil = kAbsent;
  for (auto* vector :
       {&model.mass, &model.stiffness, &model.damping, &model.gravity_mass, &model.q0, &model.v0}) {
    vector->conservativeResize(kept);
  }
  if (model.weight.size() > 0) model.weight.conservativeResize(kept);
  if (model.pull.size() > 0) model.pull.conservativeResize(kept);
  return model;
}

Model with_ideal_actuator(Model model) {
  model = without_coils(std::move(model));
  for (AuxiliaryBearing& bearing : model.auxiliary) {
    bearing.magnets.reset();
    bearing.force_limit = std::numeric_limits<double>::infinity();
  }
  return model;
}

Model with_linear_feedback(Model model) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  for (StationFeedback& feedback : model.feedbacks) {
    feedback.law.current_limit = feedback.law.amplifier.voltage_limit = kNone;
    feedback.law.opposed = false;
  }
  return model;
}

Model without_offsets(Model model) {
  for (StationFilm& film : model.films) film.law.offset_x = film.law.offset_y = 0.0;
  if (model.pull.size() > 0) {
    model.weight -= model.pull;
    model.pull.resize(0);
  }
  return model;
}

Model without_controller(Model model) {
  for (AuxiliaryBearing& bearing : model.auxiliary) {
    bearing.controller.reset();
    bearing.loop.reset();
  }
  return model;
}

Model replayed(Model model, std::shared_ptr<const CommandRecord> commands) {
  if (!commands) return model;
  model = without_controller(std::move(model));
  model.first().recorded = std::move(commands);
  return model;
}

LinearPlant plant_of(const Model& model, std::size_t bearing, double speed) {
  const AuxiliaryBearing& at = model.auxiliary[bearing];
  assert(at.moves() && at.contact);
  const Layout& l = model.layout;
  LinearPlant p;
  for (int i = 0; i < 2 * l.modes; ++i) p.coordinates.push_back(i);
  for (int k = 0; k < 2; ++k) p.coordinates.push_back(at.ring + k);
  const auto half = static_cast<Eigen::Index>(p.coordinates.size()), n = 2 * half;
  const LinearParts bending = linear_parts(model, speed);
  p.a = Eigen::MatrixXd::Zero(n, n);
  p.a.topRightCorner(half, half).setIdentity();
  const auto set = [&](Eigen::Index column, const Eigen::MatrixXd& rotor,
                       const Eigen::VectorXd& ring) {
    auto block = p.a.block(half, column, half, half);
    block.topLeftCorner(half - 2, half - 2) = -(bending.mass.cwiseInverse().asDiagonal() * rotor);
    for (int k = 0; k < 2; ++k) {
      block(half - 2 + k, half - 2 + k) = -ring[at.ring + k] / model.mass[at.ring + k];
    }
  };
  set(0, bending.stiffness, model.stiffness);
  set(half, bending.damping, model.damping);
  p.b = Eigen::MatrixXd::Zero(n, 2);
  p.c = Eigen::MatrixXd::Zero(4, n);
  for (int k = 0; k < 2; ++k) {
    p.b(n - 2 + k, k) = 1.0 / model.mass[at.ring + k];
    p.c(2 + k, half - 2 + k) = 1.0;
  }
  p.c.block(0, l.x(), 1, l.modes) = at.shape.x.transpose();
  p.c.block(1, l.y(), 1, l.modes) = at.shape.y.transpose();
  p.d = Eigen::MatrixXd::Zero(n, 4);
  p.d.rightCols(2) = p.b;
  const auto mobility = [&](const Eigen::VectorXd& shape, int first) {
    return shape.cwiseQuotient(model.mass.segment(first, l.modes)).eval();
  };
  p.d.block(half + l.x(), 0, l.modes, 1) = mobility(at.shape.x, l.x());
  p.d.block(half + l.y(), 1, l.modes, 1) = mobility(at.shape.y, l.y());
  return p;
}

}  // namespace rotorub
