// A law for magnetic bearings: x' = A x + B r, i = -(C x + D r), with its matrices as texts in
// [magnetic_control.config], summed in the order of `kind = "matrices"`. `show` = "..." makes all
// currents one number of the measurements; `fault` = "..." causes that fault from `at` on.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include <rotorub/controller.h>

namespace {

using List = std::vector<double>;

struct Law {
  std::size_t n = 0, ports = 0;
  List a, b, c, d;
  std::string fault, show;
  double at = 0.0;  // s
};

List numbers(const char* text) {
  List all;
  for (char* end = nullptr;; text = end) {
    const double x = std::strtod(text, &end);
    if (end == text) return all;
    all.push_back(x);
  }
}

int create(const rotorub_magnetic_setup* setup, void** self, char* reason, size_t room) {
  auto* law = new Law;
  law->ports = setup->ports;
  for (size_t i = 0; i < setup->entries; ++i) {
    const rotorub_entry& e = setup->config[i];
    const std::string key = e.key;
    if (key == "fault") law->fault = e.text;
    if (key == "show") law->show = e.text;
    if (key == "at") law->at = e.number;
    if (key == "a") law->a = numbers(e.text);
    if (key == "b") law->b = numbers(e.text);
    if (key == "c") law->c = numbers(e.text);
    if (key == "d") law->d = numbers(e.text);
  }
  law->n = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(law->a.size()))));
  if (law->fault == "create") {
    const rotorub_magnetic_bearing& last = setup->bearings[setup->ports / 2 - 1];
    std::snprintf(reason, room, "%u %zu %g %g: %g %g %g %g %g %g %g", setup->abi, setup->ports,
                  setup->sample_time, setup->delay, last.force_per_current, last.negative_stiffness,
                  last.current_limit, last.force_constant, last.bias_current, last.air_gap,
                  last.bandwidth);
    delete law;
    return 1;
  }
  *self = law;
  return 0;
}

void destroy(void* self) { delete static_cast<Law*>(self); }

size_t state_size(const void* self) {
  const Law& law = *static_cast<const Law*>(self);
  return law.fault == "huge" ? 65 : law.n;
}

// Row `row` of a matrix with as many columns as `of` has numbers.
double row_of(const List& matrix, std::size_t row, const double* of, std::size_t columns) {
  double sum = 0.0;
  for (std::size_t j = 0; j < columns; ++j) sum += matrix[row * columns + j] * of[j];
  return sum;
}

int step(const void* self, const rotorub_magnetic_measurement* now, double* state, double* current,
         char* reason, size_t room) {
  const Law& law = *static_cast<const Law*>(self);
  const double shown = law.show == "spin_angle"   ? now->spin_angle
                       : law.show == "spin_speed" ? now->spin_speed
                       : law.show == "sample"     ? static_cast<double>(now->sample)
                                                  : now->t;
  List after(law.n);
  for (std::size_t i = 0; i < law.ports; ++i) {
    if (law.show == "current") {
      current[i] = 0.5 * now->current[i] + 1.0;  // 1, 1.5, 1.75, ...
    } else if (!law.show.empty()) {
      current[i] = shown;
    } else {
      current[i] = -(row_of(law.c, i, state, law.n) + row_of(law.d, i, now->deflection, law.ports));
    }
  }
  for (std::size_t i = 0; i < law.n; ++i) {
    after[i] = row_of(law.a, i, state, law.n) + row_of(law.b, i, now->deflection, law.ports);
  }
  std::copy(after.begin(), after.end(), state);
  if (now->t < law.at) return 0;
  if (law.fault == "step") {
    std::snprintf(reason, room, "the encoder is lost");
    return 1;
  }
  if (law.fault == "nan") current[law.ports - 1] = std::nan("");
  if (law.fault == "nan state") state[law.n - 1] = INFINITY;
  if (law.fault == "throw") throw std::runtime_error("thrown in step");
  return 0;
}

}  // namespace

extern "C" const rotorub_magnetic_controller* rotorub_magnetic_controller_get(void) {
  static const rotorub_magnetic_controller controller = {
      ROTORUB_TEST_ABI, "magnetic", create, destroy, state_size, nullptr, step};
  return &controller;
}
