// The terminal shows the values of summary.json and of Python.
#include "compare/run_files/summary.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "compare/base/format.h"
#include "compare/figures/figure.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

// The value in the table's line of a label; empty: it has no such line.
std::string told(const std::string& table, const std::string& label) {
  const std::size_t at = table.find("\n  " + label + " ");
  if (at == std::string::npos) return "";
  const std::string line = table.substr(at + 1, table.find('\n', at + 1) - at - 1);
  return line.substr(line.find_last_of(' ') + 1);
}

TEST(RunTable, HasTheFiguresOfTheSummary) {
  const scene::Scene scene = test::shipped("bench_ring", {"run.end=0.1"});
  for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    const Trajectory run = test::run_with(scene, integrator);
    const nlohmann::json summary = summary_json(scene, run);
    const std::string table = result::text_of(run_result(scene, run));
    int lines = 0;
    for (const Figure& f : figures()) {
      const std::string value = told(table, figure_label(f));
      const nlohmann::json& number = summary.at(f.key);
      if (value.empty()) {
        EXPECT_TRUE(number.is_null() || number == 0.0) << f.key;
        continue;
      }
      EXPECT_EQ(value, figure_value(f, number.get<double>())) << f.key;
      ++lines;
    }
    EXPECT_GT(lines, 10);
    EXPECT_EQ(told(table, "first touch, ms"),
              short_number(1e3 * summary.at("first_touch").get<double>()));
    EXPECT_NE(table.find(summary.at("settled").at("attractor").get<std::string>()),
              std::string::npos);
  }
}

// `event` chooses its steps, so figures that depend on the user's step are left out.
TEST(RunTable, OfStepsOfItsOwnHasNoFigureOfTheStep) {
  for (const char* step : {"run.step=1e-5", "run.step=1e-4"}) {
    const scene::Scene scene = test::shipped("bench_ring", {"run.end=0.05", step});
    const Trajectory run = test::run_event(scene);
    static std::string before;
    std::string table = result::text_of(run_result(scene, run));
    table.resize(table.find("\n  steps"));
    if (!before.empty()) {
      EXPECT_EQ(table, before);
    }
    before = table;
    EXPECT_EQ(told(table, "impulse / step, max, N"), "");
    EXPECT_TRUE(summary_json(scene, run).at("peak_force").is_null());
  }
  const scene::Scene scene = test::shipped("bench_ring", {"run.end=0.05"});
  const Trajectory fixed = test::run_with(scene, scene::Integrator::kVerlet);
  EXPECT_NE(told(result::text_of(run_result(scene, fixed)), "impulse / step, max, N"), "");
  EXPECT_GT(summary_json(scene, fixed).at("peak_force").get<double>(), 0.0);
}

TEST(RunTable, HasALineForEachOfSeveralContacts) {
  const scene::Scene scene = test::shipped("two_catchers", {"run.end=0.02"});
  const Trajectory run = test::run_event(scene);
  const nlohmann::json contacts = summary_json(scene, run).at("contacts");
  const std::string table = result::text_of(run_result(scene, run));
  for (const nlohmann::json& contact : contacts) {
    EXPECT_EQ(told(table, contact.at("name").get<std::string>()), contact.at("impacts").dump());
  }
  const scene::Scene one = test::shipped("bench_ring", {"run.end=0.01"});
  EXPECT_EQ(result::text_of(run_result(one, test::run_event(one))).find("at each contact"),
            std::string::npos);
}

}  // namespace
}  // namespace rotorub
