#include "native_model/model/control_states.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "native_model/control/control_loop.h"
#include "native_model/model/actuation.h"

namespace rotorub {
namespace {

constexpr int kCommands = 2;  // before the memory of the loop

}  // namespace

int control_states(const AuxiliaryBearing& at) {
  return at.loop ? kCommands + static_cast<int>(at.loop->memory_size()) : 0;
}

Model with_control_states(Model model) {
  const int first = model.nq();
  for (AuxiliaryBearing& at : model.auxiliary) {
    const int states = control_states(at);
    if (states == 0 || has_control_states(at) || model.nq() + states > kMaxCoordinates) continue;
    at.control_state = model.nq();
    at.loop = std::make_shared<ControlLoop>(at.loop->with_exact_sensors());
    model.layout.control_states += states;
  }
  const int added = model.nq() - first;
  const auto extend = [&](Eigen::VectorXd& vector, double value) {
    vector.conservativeResize(first + added);
    vector.tail(added).setConstant(value);
  };
  extend(model.mass, 1.0);
  for (auto* vector :
       {&model.stiffness, &model.damping, &model.gravity_mass, &model.q0, &model.v0}) {
    extend(*vector, 0.0);
  }
  for (auto* vector : {&model.weight, &model.pull}) {
    if (vector->size() > 0) extend(*vector, 0.0);
  }
  return model;
}

void take_control_sample(const Model& m, std::size_t k, double t, const double* q, double* v) {
  const AuxiliaryBearing& at = m.auxiliary[k];
  double* states = v + at.control_state;
  std::vector<double> memory(states + kCommands, states + control_states(at));
  const Eigen::Vector2d held(states[0], states[1]);
  const Eigen::Vector2d current =
      at.magnets ? actuator_state(m, q, v, held, k).current : Eigen::Vector2d(0.0, 0.0);
  const Eigen::Vector2d command = control_sample(m, t, q, v, current, memory.data(), k);
  states[0] = command.x();
  states[1] = command.y();
  std::ranges::copy(memory, states + kCommands);
}

std::array<double, kMostOutputs> outputs_in_state(const Model& m, std::size_t k, const double* v) {
  std::array<double, kMostOutputs> values{};
  const double* memory = v + m.auxiliary[k].control_state + kCommands;
  std::copy_n(ControlLoop::outputs(memory), values.size(), values.begin());
  return values;
}

std::vector<int> returning_control_states(const Model& m, std::size_t k) {
  const AuxiliaryBearing& at = m.auxiliary[k];
  std::vector<int> all;
  if (!has_control_states(at)) return all;
  for (int i = 0; i < kCommands; ++i) all.push_back(at.control_state + i);
  for (const std::size_t i : at.loop->returning_entries()) {
    all.push_back(at.control_state + kCommands + static_cast<int>(i));
  }
  return all;
}

void set_control_clock(const Model& m, double t, double* v) {
  constexpr double kRoundOff = 1e-9;  // share of the sample time
  for (const AuxiliaryBearing& at : m.auxiliary) {
    if (!has_control_states(at)) continue;
    const double due = std::ceil(t / at.sample_time - kRoundOff) - 1.0;
    const double last = std::max(due * at.sample_time, at.control_on);
    double* memory = v + at.control_state + kCommands;
    at.loop->set_time(last, memory);
    if (m.layout.spin == 0) {
      at.loop->set_spin_angles(m.spin_angle + m.speed * last, m.speed * at.sample_time, memory);
    }
  }
}

}  // namespace rotorub
