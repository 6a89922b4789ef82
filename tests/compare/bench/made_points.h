// Points of a bench written by hand.
#pragma once

#include <optional>
#include <string>

#include "compare/bench/engines.h"
#include "compare/bench/point.h"

namespace rotorub::test {

inline bench::Point made_point(const std::string& engine, std::optional<double> step, double error,
                               double seconds, const std::string& setting = "") {
  bench::Point p;
  p.setting.engine = engine;
  p.setting.setting = setting;
  p.setting.step = step;
  p.errors = bench::PointErrors{error, std::nullopt, std::nullopt};
  p.steps = 100;
  p.end = 1.0;
  p.wall = {seconds, 0.9 * seconds, 1.5 * seconds, 20};
  return p;
}

inline bench::Point failed_point(const std::string& engine, double step, bench::Outcome outcome,
                                 const std::string& reason) {
  bench::Point p;
  p.setting.engine = engine;
  p.setting.step = step;
  p.judgement = {outcome, reason};
  return p;
}

inline bench::BenchEngine made_engine(const std::string& name, bench::Family family) {
  return {name, family, "made up", "", {}};
}

}  // namespace rotorub::test
