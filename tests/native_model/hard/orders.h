// The order of a fixed-step scheme from its errors against `event` over several steps; and what the
// schemes refuse.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/native_model/hard/rules.h"
#include "tests/support/order.h"
#include "tests/support/pairs.h"
#include "tests/support/said.h"

namespace rotorub::test {

using scene::Integrator;

// Over two decades, 50 us to 0.5 us, close together where impacts fall at random within their
// steps. 1 ms, where the rows and the samples are, is a whole number of each.
inline constexpr int kStepsInAMillisecond[] = {20,  25,  30,  40,  60,   90,   135,
                                               200, 300, 450, 680, 1000, 1400, 2000};
inline constexpr double kVerletOrder = 1.7;  // 2, less the scatter of impacts within their steps
// m: `event` and 30,000 steps of round-off come to 1e-14; what is judged stands well above, and is
// five errors at least.
inline constexpr double kFloor = 1e-13;
inline constexpr std::size_t kErrors = 5;

inline std::vector<double> steps() {
  std::vector<double> out;
  for (const int n : kStepsInAMillisecond) out.push_back(1e-3 / n);
  return out;
}

// ---------------------------------------------------------------- what is refused
// A part, or a pair, that a scheme refuses, with words of the message. Empty: none is refused.
struct Refusal {
  Integrator integrator;
  const char* part;
  const char* with;  // null: with anything
  const char* message;
};
// A sample of a controller falls into an impact, over which loads and command are held.
inline constexpr const char* kSampled = "under a sampled controller need the integrator event";
inline constexpr std::array<Refusal, 2> kRefused{
    {{Integrator::kVerlet, "finite_impacts", "sampled_support", kSampled},
     {Integrator::kVerlet, "finite_impacts", "sampled_magnets", kSampled}}};

// Schemes whose measured order is lower; the bound follows from the measurement.
struct Kink {
  Integrator integrator;
  const char *one, *other;
  double order;
};
inline constexpr std::array<Kink, 1> kKinks{{
    // Errors scatter by a factor of 30 between neighbouring steps: 1.66.
    {Integrator::kVerlet, "anisotropic_rotor", "switched_load", 1.5},
}};

inline double least_order(Integrator integrator, const std::vector<Part>& parts, double least) {
  const auto has = [&](const std::string& name) {
    return std::any_of(parts.begin(), parts.end(), [&](const auto& p) { return p.name == name; });
  };
  for (const Kink& k : kKinks) {
    if (integrator == k.integrator && has(k.one) && has(k.other)) return k.order;
  }
  return least;
}

inline const char* refused(Integrator integrator, const std::vector<Part>& parts) {
  for (const Refusal& r : kRefused) {
    const auto has = [&](const std::string& name) {
      return std::any_of(parts.begin(), parts.end(), [&](const auto& p) { return p.name == name; });
    };
    if (r.integrator == integrator && has(r.part) && (!r.with || has(r.with))) return r.message;
  }
  return nullptr;
}

// ---------------------------------------------------------------- runs
inline Trajectory reference(const scene::Scene& scene) {
  Trajectory t = run_event(scene);
  EXPECT_FALSE(t.impacts.empty()) << scene.name << ": nothing happens";
  return t;
}

inline constexpr double kArm = 0.02;  // m, of the spin's error where there is no contact

inline Convergence converge(const scene::Scene& scene, Integrator integrator,
                            const Trajectory& exact) {
  Convergence c;
  for (const double step : steps()) {
    const Trajectory t = run_with(scene, integrator, step);
    if (t.rows() != exact.rows()) continue;
    c.steps.push_back(step);
    c.errors.push_back(
        trajectory_error(t, exact, scene.first().contact ? scene.first().contact->radius : kArm));
  }
  return c;
}

// One line for each scene; the whole table is printed if one has too low an order.
struct Table {
  std::string text;
  bool short_of_order = false;

  void judge(const std::string& name, const Convergence& c, double least) {
    const Convergence judged = c.above(kFloor);
    const bool good = judged.steps.size() >= kErrors && judged.order() >= least;
    short_of_order = short_of_order || !good;
    char head[96];
    std::snprintf(head, sizeof head, "%s %-46s", good ? "     " : "SHORT", name.c_str());
    text += head + c.text() + '\n';
  }
};

inline void expect_order(const std::vector<Pair>& pairs, Integrator integrator, double least) {
  Table table;
  for (const Pair& pair : pairs) {
    const scene::Scene scene = pair.scene();
    if (const char* message = refused(integrator, pair.parts)) {
      EXPECT_TRUE(contains(
          message_of<scene::SceneError>([&] { run_with(scene, integrator, steps().back()); }),
          message))
          << scene.name << " is listed as refused";
      continue;
    }
    table.judge(scene.name, converge(scene, integrator, reference(scene)),
                least_order(integrator, pair.parts, least));
  }
  EXPECT_FALSE(table.short_of_order) << "least order " << least << '\n' << table.text;
}

}  // namespace rotorub::test
