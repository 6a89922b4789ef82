// The page's data on whirl, against motions made by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <numbers>

#include "compare/report/whirl_plots.h"
#include "tests/support/orbit_run.h"

namespace rotorub {
namespace {

using nlohmann::json;
constexpr double kTurn = 2.0 * std::numbers::pi;

// 1 s at 40 Hz: a backward whirl of 20 um at 100 Hz beside a synchronous one of 5 um.
Trajectory whirling(double spin = 40.0, std::size_t rows = 4001) {
  return test::orbit_run(1.0, rows, [&](double t) {
    const double with = kTurn * spin * t;
    const auto back = 20e-6 * std::polar(1.0, -kTurn * 100.0 * t),
               forward = 5e-6 * std::polar(1.0, with);
    const std::complex<double> rate(0.0, kTurn);
    return test::OrbitRow{back + forward, rate * (spin * forward - 100.0 * back), with,
                          kTurn * spin};
  });
}

TEST(WhirlPlots, TheSpectrumPeaksAtTheWhirl) {
  const Trajectory run = whirling();
  EXPECT_NEAR(mean_spin(run), 40.0, 1e-9);
  const json spectrum = whirl_data(run, nullptr, 320.0).at("spectrum");
  const auto f = spectrum.at("x").get<std::vector<double>>(),
             y = spectrum.at("y").get<std::vector<double>>();
  ASSERT_EQ(f.size(), y.size());
  EXPECT_GE(f.front(), -320.0);
  EXPECT_LE(f.back(), 320.0);
  const auto peak = std::max_element(y.begin(), y.end());
  EXPECT_NEAR(f[static_cast<std::size_t>(peak - y.begin())], -100.0, 1.1)
      << "the second half: 2 Hz apart";
  EXPECT_GT(*peak, 0.84 * 20.0e-6);
  EXPECT_LE(*peak, 20.01e-6);
}

// A circle of 617.7 um at 60 Hz, which lies between the frequencies that 0.27 s tell apart.
TEST(WhirlPlots, TheSpectrumHasTheSizeAndTheFrequencyOfACircle) {
  const Trajectory run = test::orbit_run(0.54, 4001, [](double t) {
    const auto z = 617.7e-6 * std::polar(1.0, kTurn * 60.0 * t);
    return test::OrbitRow{z, std::complex<double>(0.0, kTurn * 60.0) * z, kTurn * 60.0 * t,
                          kTurn * 60.0};
  });
  const json spectrum = whirl_data(run, nullptr, 480.0).at("spectrum");
  const auto f = spectrum.at("x").get<std::vector<double>>(),
             y = spectrum.at("y").get<std::vector<double>>();
  const auto peak = std::max_element(y.begin(), y.end());
  EXPECT_NEAR(f[static_cast<std::size_t>(peak - y.begin())], 60.0, 0.1);
  EXPECT_NEAR(*peak, 617.7e-6, 0.5e-6);
}

TEST(WhirlPlots, TheWaterfallHasNoEmptyColumns) {
  const json w = whirl_data(whirling(), nullptr, 320.0).at("waterfall");
  const auto columns = w.at("columns").get<int>(), rows = w.at("rows").get<int>();
  EXPECT_LE(columns, 240);
  const double low = w.at("f")[0], high = w.at("f")[1];
  EXPECT_NEAR(low, -high, 1e-9) << "as far backward as forward";
  EXPECT_LE(high, 330.0);
  // 8 turns of 25 ms: 5 Hz apart, and as wide a column.
  EXPECT_NEAR((high - low) / columns, 5.0, 0.05);
  EXPECT_EQ(w.at("levels").get<std::string>().size(),
            static_cast<std::size_t>((rows * columns + 2) / 3 * 4));
  EXPECT_NEAR(w.at("high").get<double>(), std::log10(20.0e-6), 0.08);
}

TEST(WhirlPlots, TheResidualIsTheDistance) {
  const Trajectory run = whirling(), other = whirling(40.0, 2001);
  const json none = whirl_data(run, nullptr, 320.0), same = whirl_data(run, &other, 320.0);
  EXPECT_TRUE(none.at("residual").is_null());
  for (const double y : same.at("residual").at("y").get<std::vector<double>>()) EXPECT_LT(y, 1e-15);
  Trajectory away = whirling();
  for (Column& column : away.series) {
    if (column.name == "rotor_x") {
      for (double& x : column.values) x += 3e-6;
    }
  }
  const json apart = whirl_data(away, &other, 320.0).at("residual");
  for (const double y : apart.at("y").get<std::vector<double>>()) EXPECT_NEAR(y, 3e-6, 1e-12);
}

// 1x of a run-up from 20 to 60 Hz: 5 um, whose phase is that of the mark.
TEST(WhirlPlots, ARunUpHasItsOrders) {
  Trajectory run = test::orbit_run(1.0, 4001, [](double t) {
    const double phi = kTurn * (20.0 + 20.0 * t) * t, omega = kTurn * (20.0 + 40.0 * t);
    const auto place = 5e-6 * std::polar(1.0, phi - 2.0);
    return test::OrbitRow{place, std::complex<double>(0.0, omega) * place, phi, omega};
  });
  ASSERT_TRUE(changes_speed(run));
  const json orders = whirl_data(run, nullptr, 320.0).at("orders");
  ASSERT_EQ(orders.at("t").size(), 145u) << "40 turns, four in a stretch, a quarter between two";
  for (std::size_t k = 0; k < 145; ++k) {
    EXPECT_NEAR(orders.at("speed")[k].get<double>(),
                kTurn * (20.0 + 40.0 * orders.at("t")[k].get<double>()), 0.01);
    const json &once = orders.at("orders")[0][k], &twice = orders["orders"][1][k];
    EXPECT_NEAR(std::hypot(once[0].get<double>(), once[1].get<double>()), 5e-6, 1e-9);
    EXPECT_NEAR(std::atan2(once[1].get<double>(), once[0].get<double>()), -2.0, 4e-4);
    EXPECT_NEAR(std::hypot(twice[0].get<double>(), twice[1].get<double>()), 0.0, 1e-9) << "no 2x";
  }
  const json cascade = whirl_data(run, nullptr, 320.0).at("cascade");
  EXPECT_EQ(cascade.at("speed").size() * cascade.at("columns").get<std::size_t>(),
            cascade.at("levels").get<std::string>().size() / 4 * 3);
  EXPECT_NEAR(cascade.at("high").get<double>(), std::log10(5.0e-6), 0.1);
  for (double& s : run.series.back().values) s = kTurn * 20.0;
  EXPECT_FALSE(changes_speed(run));
  EXPECT_TRUE(whirl_data(run, nullptr, 320.0).at("orders").is_null()) << "no run-up";
  EXPECT_TRUE(whirl_data(run, nullptr, 320.0).at("cascade").is_null());
}

// A run that ends at once, and one of a rotor at rest.
TEST(WhirlPlots, OfTooLittleThereIsNothing) {
  for (const char* what : {"spectrum", "waterfall", "poincare", "residual"}) {
    EXPECT_TRUE(whirl_data(whirling(40.0, 1), nullptr, 320.0).at(what).is_null()) << what;
  }
  const json short_run = whirl_data(whirling(40.0, 20), nullptr, 320.0);
  EXPECT_TRUE(short_run.at("spectrum").is_null());
  EXPECT_TRUE(short_run.at("waterfall").is_null());
  EXPECT_TRUE(whirl_data(whirling(0.0), nullptr, 320.0).at("poincare").is_null());
}

}  // namespace
}  // namespace rotorub
