#include "native_model/model/linear_plant.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "native_model/model/closed_loop.h"
#include "native_model/model/sampled_feedback.h"
#include "native_model/scene/record.h"
#include "native_model/scene/text.h"

namespace rotorub {
namespace {

// The model with linear feedbacks; those that work at t = 0 work at all times, the others never.
Model held_at_start(Model model) {
  for (StationFeedback& f : model.feedbacks) {
    f.works = {-scene::kNever, f.works.at(0.0) ? scene::kNever : -scene::kNever, scene::kNever};
  }
  return with_linear_feedback(without_offsets(std::move(model)));
}

// Finds the states of the working feedbacks and their names.
void find_memory(const Model& m, LinearPlant& p) {
  const auto add = [&](int at, const std::string& name) {
    p.memory.push_back(at);
    p.memory_names.push_back(name);
  };
  for (const StationFeedback& f : m.feedbacks) {
    if (!f.works.at(0.0)) continue;
    const std::string bearing =
        f.number == 0 ? "bearing_" : "bearing" + std::to_string(f.number + 1) + "_";
    const auto both = [&](int at, const char* what) {
      if (at == kAbsent) return;
      add(at, bearing + what + "_x");
      add(at + 1, bearing + what + "_y");
    };
    both(f.states.stored, "integral");
    both(f.states.filtered, "rate");
    both(f.states.current, "current");
  }
  for (const SampledFeedback& s : m.samplers) {
    if (std::ranges::none_of(s.bearings,
                             [&](std::size_t k) { return m.feedbacks[k].works.at(0.0); }))
      continue;
    p.every = s.sample_time;
    for (int i = 0; i < static_cast<int>(s.law.ports()) * (1 + s.delay); ++i)
      add(s.command + i, "command_" + std::to_string(i + 1));
    for (int i = 0; i < static_cast<int>(s.law.states()); ++i)
      add(s.state + i, "control_" + std::to_string(i + 1));
  }
}

// Appends the rows and columns of the magnetic bearings' states.
void add_memory(const Model& m, double speed, LinearPlant& p) {
  const Layout& l = m.layout;
  const ClosedLoop loop = closed_loop(m, speed);
  const Eigen::Index half = p.half(), bending = 2 * l.modes;
  const auto s = static_cast<Eigen::Index>(p.memory.size()), n = 2 * half + s;
  std::vector<Eigen::Index> from;  // indices among the states of the model's feedbacks
  for (const int at : p.memory) from.push_back(at - l.feedback_state());
  p.a.conservativeResizeLike(Eigen::MatrixXd::Zero(n, n));
  p.a.block(half, 2 * half, bending, s) =
      loop.mass.cwiseInverse().asDiagonal() * loop.force(Eigen::all, from);
  p.a.block(2 * half, 0, s, bending) = loop.of_q(from, Eigen::all);
  p.a.block(2 * half, half, s, bending) = loop.of_v(from, Eigen::all);
  p.a.bottomRightCorner(s, s) = loop.of_state(from, from);
  for (Eigen::MatrixXd* in : {&p.b, &p.d})
    in->conservativeResizeLike(Eigen::MatrixXd::Zero(n, in->cols()));
  p.c.conservativeResizeLike(Eigen::MatrixXd::Zero(4, n));
  if (p.every == 0.0) return;
  const Eigen::MatrixXd taken = linear_sample(m);
  p.sample = Eigen::MatrixXd::Identity(n, n);
  p.sample.block(2 * half, 0, s, bending) = taken(from, Eigen::seqN(0, bending));
  p.sample.bottomRightCorner(s, s) = taken.rightCols(taken.cols() - bending)(from, from);
}

}  // namespace

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
  const Model held = held_at_start(model);
  find_memory(held, p);
  if (!p.memory.empty()) add_memory(held, speed, p);
  return p;
}

std::string beyond_linear_plant(const scene::Scene& scene, std::size_t bearing, const Model& model,
                                double every) {
  if (const auto& ring = scene.auxiliary[bearing].stator; ring && !ring->on_springs_alone()) {
    return "the law's linear plant has a ring on a spring and damper only, without stator.mount, "
           "dry_friction, squeeze_film, ball_bearing and dry drag of the spin";
  }
  double other = 0.0;  // s, sample time of an earlier control
  for (const SampledFeedback& s : model.samplers) {
    const auto working = std::ranges::find_if(
        s.bearings, [&](std::size_t k) { return model.feedbacks[k].works.at(0.0); });
    if (working == s.bearings.end()) continue;
    const std::size_t number = model.feedbacks[*working].number;
    const std::string named = scene::magnetic_bearing_name(scene, number);
    const std::string control = "the control of " + named;
    if (s.library) {
      return "the linear plant cannot include " + named +
             ", because a library commands it. Add --set " +
             scene::magnetic_bearing_path(scene, number) +
             ".control.fails_at=0 for the plant without it";
    }
    if (every == 0.0) {
      return "a continuous plant cannot include the sampled control of " + named +
             ". Set its sample_time to 0, or its fails_at to 0";
    }
    const double samples = every / s.sample_time;
    if (samples < 0.5 || std::abs(samples - std::round(samples)) > 1e-9 * samples) {
      return control + " is sampled every " + scene::number_text(s.sample_time) +
             " s, and controller.sample_time is not a whole multiple of it";
    }
    if (other > 0.0 && s.sample_time != other)
      return control + " has a different sample time from another magnetic bearing's control";
    other = s.sample_time;
  }
  return {};
}

}  // namespace rotorub
