#include "native_model/film/journal_bearing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "native_model/bearing/bearing_film.h"
#include "native_model/linear/campbell.h"
#include "native_model/scene/reader.h"
#include "tests/support/refusal.h"

namespace rotorub {
namespace {

constexpr double kSpeed = 1500.0 * std::numbers::pi / 30.0;  // rad/s

// Friswell, Penny, Garvey, Lees, "Dynamics of Rotating Machines", example 5.9.6.
JournalBearing friswell_bearing(FilmTheory theory = FilmTheory::kShort) {
  return {.diameter = 0.1,
          .length = 0.03,
          .clearance = 1e-4,
          .viscosity = 0.1,
          .load = 525.0,
          .theory = theory};
}

FilmPoint point_at(const JournalBearing& bearing, double speed) {
  const std::vector<FilmPoint> all = film_points(bearing, {speed});
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const FilmPoint& p) { return p.speed == speed; });
  EXPECT_NE(found, all.end());
  return found == all.end() ? FilmPoint{} : *found;
}

TEST(JournalBearing, FriswellsShortBearing) {
  const FilmPoint p = point_at(friswell_bearing(), kSpeed);
  EXPECT_NEAR(p.eccentricity, 0.2663, 5e-5);
  const double book[] = {12.808e6, 16.394e6, -25.060e6, 8.815e6};  // N/m
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(p.coefficients[k], book[k], 0.5e3) << k;
  // C_xy = C_yx.
  EXPECT_NEAR(p.coefficients[5] / p.coefficients[6], 1.0, 1e-12);
}

// With length / diameter = 0.3 the full equation gives 2 to 8 % less.
TEST(JournalBearing, FriswellsBearingOfFiniteLength) {
  const FilmPoint finite = point_at(friswell_bearing(FilmTheory::kFinite), kSpeed),
                  brief = point_at(friswell_bearing(), kSpeed);
  EXPECT_GT(finite.eccentricity, brief.eccentricity);
  EXPECT_NEAR(finite.eccentricity, 0.2748, 1e-3);
  for (std::size_t k = 0; k < 8; ++k) {
    const double ratio = finite.coefficients[k] / brief.coefficients[k];
    EXPECT_LT(ratio, 1.0) << k;
    EXPECT_GT(ratio, 0.9) << k;
  }
}

// The coefficients are the derivatives of the force that carries the load: at a slightly different
// load (and so position) the static force changes by K dr.
TEST(JournalBearing, StiffnessIsTheChangeOfTheLoad) {
  for (const FilmTheory theory : {FilmTheory::kShort, FilmTheory::kFinite}) {
    const double d = 1e-3;
    const auto place = [&](double share, double turned) {
      JournalBearing b = friswell_bearing(theory);
      b.load *= share;
      b.load_angle += turned;
      const FilmPoint p = point_at(b, kSpeed);
      const double angle = b.load_angle + p.attitude, r = b.clearance * p.eccentricity;
      return Eigen::Vector2d(r * std::cos(angle), r * std::sin(angle));
    };
    const FilmPoint p = point_at(friswell_bearing(theory), kSpeed);
    Eigen::Matrix2d K;
    K << p.coefficients[0], p.coefficients[1], p.coefficients[2], p.coefficients[3];
    const Eigen::Vector2d heavier = place(1.0 + d, 0.0) - place(1.0 - d, 0.0);
    const Eigen::Vector2d aside = place(1.0, d) - place(1.0, -d);
    // The load is (0, -W); turned by d it gains W d along x.
    const double W = 525.0;
    EXPECT_NEAR((K * heavier).y() / (-2.0 * W * d), 1.0, 2e-3);
    EXPECT_NEAR((K * heavier).x() / (W * d), 0.0, 4e-3);
    EXPECT_NEAR((K * aside).x() / (2.0 * W * d), 1.0, 2e-3);
    EXPECT_NEAR((K * aside).y() / (W * d), 0.0, 4e-3);
  }
}

// A turned load turns the matrices; the other sense of rotation mirrors them.
TEST(JournalBearing, TurnsAndMirrors) {
  const FilmPoint down = film_point(friswell_bearing(), 0.5);
  JournalBearing right = friswell_bearing();
  right.load_angle = 0.0;
  const FilmPoint p = film_point(right, 0.5);
  for (const std::size_t k : {std::size_t{0}, std::size_t{4}}) {
    const double size = std::abs(down.coefficients[k]);
    EXPECT_NEAR(p.coefficients[k], down.coefficients[k + 3], 1e-12 * size);
    EXPECT_NEAR(p.coefficients[k + 1], -down.coefficients[k + 2], 1e-12 * size);
    EXPECT_NEAR(p.coefficients[k + 2], -down.coefficients[k + 1], 1e-12 * size);
  }
  const FilmPoint back = film_point(friswell_bearing(), 0.5, -1.0);
  EXPECT_EQ(back.speed, -down.speed);
  for (std::size_t k = 0; k < 8; ++k) {
    const double sign = k % 4 == 1 || k % 4 == 2 ? -1.0 : 1.0;
    EXPECT_NEAR(back.coefficients[k], sign * down.coefficients[k],
                1e-9 * std::abs(down.coefficients[k]))
        << k;
  }
}

TEST(JournalBearing, InterpolatesBetweenItsPoints) {
  for (const FilmTheory theory : {FilmTheory::kShort, FilmTheory::kFinite}) {
    const JournalBearing b = friswell_bearing(theory);
    std::vector<double> speed;
    std::array<std::vector<double>, 8> lists;
    for (const FilmPoint& p : film_points(b)) {
      EXPECT_TRUE(speed.empty() || p.speed > speed.back());
      speed.push_back(p.speed);
      for (std::size_t k = 0; k < 8; ++k) lists[k].push_back(p.coefficients[k]);
    }
    const CoefficientTable table(speed, lists);
    for (const double e : {0.013, 0.05, 0.21, 0.47, 0.72, 0.88}) {
      const FilmPoint p = film_point(b, e);
      const BearingCoefficients found = table.at(p.speed);
      for (std::size_t k = 0; k < 8; ++k) {
        double size = 0.0;
        for (std::size_t j = k / 4 * 4; j < k / 4 * 4 + 4; ++j)
          size = std::max(size, std::abs(p.coefficients[j]));
        EXPECT_NEAR(found[k], p.coefficients[k], 4e-3 * size) << e << " " << k;
      }
    }
  }
}

std::string scene_text(const std::string& bearing, double speed = kSpeed) {
  return "[rotor]\nspeed = " + std::to_string(speed) +
         "\nlength = 1.5\nE = 211e9\nG = 81.2e9\nrho = 7810\nmodes = 3\n"
         "[[rotor.section]]\nfrom = 0.0\nto = 1.5\ndiameter = 0.05\n"
         "[[rotor.disc]]\nz = 0.5\ndiameter = 0.28\ninner_diameter = 0.05\nthickness = 0.07\n"
         "[[rotor.disc]]\nz = 1.0\ndiameter = 0.35\ninner_diameter = 0.05\nthickness = 0.07\n"
         "[[rotor.bearing]]\nz = 0.0\n" +
         bearing + "[[rotor.bearing]]\nz = 1.5\n" + bearing;
}

const std::string kJournal =
    "journal = {diameter = \"100 mm\", length = \"30 mm\", clearance = \"0.1 mm\", viscosity = "
    "0.1, "
    "load = 525.0, theory = \"short\"}\n";

TEST(JournalBearing, OfAScene) {
  const scene::Scene s = scene::parse_scene(scene_text(kJournal), "film.toml");
  const scene::ShaftBearing& b = s.rotor.geometry->bearings.at(1);
  EXPECT_NEAR(b.stiffness.x(), 12.808e6, 0.5e3);
  EXPECT_NEAR(b.stiffness.y(), 8.815e6, 0.5e3);
  EXPECT_NEAR(b.cross_stiffness.x(), 16.394e6, 0.5e3);
  EXPECT_NEAR(b.cross_stiffness.y(), -25.060e6, 0.5e3);
  EXPECT_NEAR(b.cross_damping.x() / b.cross_damping.y(), 1.0, 1e-12);
  const auto film = film_of(b);
  ASSERT_TRUE(film && film->follows());
  EXPECT_NEAR(film->at(kSpeed)[1], 16.394e6, 0.5e3);
  // Oil whip begins at about twice the lowest critical speed.
  const WhirlSystem system = whirl_system(s);
  const std::optional<double> threshold = stability_threshold(system);
  ASSERT_TRUE(threshold);
  EXPECT_NEAR(*threshold / critical_speeds(system).at(0), 2.05, 0.1);
}

TEST(JournalBearing, RefusedKeys) {
  const auto refused = [](const std::string& bearing) {
    return test::refusals([&] { scene::parse_scene(scene_text(bearing), "film.toml"); });
  };
  const auto beside = refused(kJournal + "stiffness = 1e6\n");
  ASSERT_EQ(beside.size(), 2u);
  EXPECT_EQ(beside[0].key, "rotor.bearing[0].stiffness");
  EXPECT_EQ(refused("").at(0).key, "rotor.bearing[0].stiffness");
  EXPECT_EQ(refused("journal = {diameter = 0.1}\n").at(0).key, "rotor.bearing[0].journal.length");
  EXPECT_EQ(refused(kJournal + "table_speed = [1.0, 2.0]\ntable_kxx = [1.0, 2.0]\n").at(0).key,
            "rotor.bearing[0].table_speed");
}

}  // namespace
}  // namespace rotorub
