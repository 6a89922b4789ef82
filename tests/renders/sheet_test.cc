#include "renders/sheet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renders/unrolled_view.h"
#include "tests/renders/samples.h"

namespace rotorub::renders {
namespace {

constexpr int kSide = 100;
const Color kBlack{0.0F, 0.0F, 0.0F};

// The area of a drawing in black on white, in pixels.
struct Drawing {
  Picture picture{kSide, kSide};
  Sheet sheet;
  Drawing() : sheet(picture, {0, 0, kSide, kSide}) {}

  double ink(int left = 0, int top = 0, int right = kSide, int bottom = kSide) const {
    double ink = 0.0;
    for (int row = top; row < bottom; ++row) {
      for (int column = left; column < right; ++column) {
        ink += 1.0 - picture.pixel(column, row)[0] / 255.0;
      }
    }
    return ink;
  }
};

// Smooth edges keep the area to 1 %, the error of 8-bit shades.
void expect_area(const Drawing& drawing, double area) {
  EXPECT_NEAR(drawing.ink(), area, 0.01 * area);
}

TEST(Sheet, ShapesHaveTheirAreas) {
  constexpr double kHalfCircle = std::numbers::pi;
  Drawing disc;
  disc.sheet.disc({50.3, 49.8}, 30.25, kBlack);
  expect_area(disc, kHalfCircle * 30.25 * 30.25);
  Drawing ring;
  ring.sheet.ring({50.0, 50.0}, 20.5, 30.5, kBlack);
  expect_area(ring, kHalfCircle * (30.5 * 30.5 - 20.5 * 20.5));
  Drawing sector;
  sector.sheet.sector({50.0, 50.0}, 10.0, 40.0, 0.3, 0.5 * kHalfCircle, kBlack);
  expect_area(sector, 0.25 * kHalfCircle * (1600.0 - 100.0));
  Drawing fill;
  fill.sheet.fill(10.25, 20.5, 30.5, 40.25, kBlack);
  expect_area(fill, 30.5 * 40.25);
  Drawing line;
  line.sheet.polyline(std::vector<Sheet::Point>{{10.0, 20.0}, {70.0, 63.0}}, 6.0, kBlack);
  expect_area(line, 6.0 * std::hypot(60.0, 43.0) + kHalfCircle * 9.0);
}

TEST(Sheet, AnglesGoCounterClockwiseFromTheRight) {
  Drawing sector;
  sector.sheet.sector({50.0, 50.0}, 0.0, 40.0, 0.0, 1.5707963, kBlack);
  EXPECT_GT(sector.ink(50, 0, 100, 50), 0.99 * sector.ink());
}

TEST(Sheet, ATrailHasNoBeadsAndFades) {
  Drawing trail;
  std::vector<Sheet::Point> points;
  for (int k = 0; k <= 40; ++k) points.push_back({10.0 + 2.0 * k, 50.0});
  trail.sheet.trail(points, 3.0, kBlack);
  double before = 0.0;
  for (int column = 12; column < 88; ++column) {
    const double ink = trail.ink(column, 40, column + 1, 60);
    EXPECT_GE(ink, before - 0.02) << column;
    before = ink;
  }
  EXPECT_NEAR(before, 3.0, 0.2);
  Drawing broken;
  const std::vector<Sheet::Point> apart = {{10.0, 50.0}, {90.0, 50.0}};
  broken.sheet.trail(apart, 3.0, kBlack, 40.0);
  EXPECT_EQ(broken.ink(), 0.0);
}

TEST(Sheet, NothingLeavesItsArea) {
  Drawing drawing;
  Sheet part = drawing.sheet.part({20, 30, 40, 20});
  part.disc({0.0, 0.0}, 200.0, kBlack);
  part.text(-20.0, -5.0, "outside", 30, kBlack);
  part.bar({-50.0, 5.0}, {500.0, 5.0}, 300.0, kBlack);
  EXPECT_EQ(drawing.ink(), 40.0 * 20.0);
  EXPECT_EQ(drawing.ink(20, 30, 60, 50), 40.0 * 20.0);
}

TEST(Font, HasTheLettersOfUnits) {
  const auto drawn = [](const char* letter) {
    Drawing drawing;
    drawing.sheet.text(40.0, 40.0, letter, 20, kBlack);
    const auto bytes = drawing.picture.bytes();
    return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
  };
  const auto nothing = drawn(""), box = drawn("\U0010FFFD");
  EXPECT_NE(box, nothing);
  for (const char* letter : {"µ", "×", "°", "▲", "Ω", "m"}) {
    EXPECT_NE(drawn(letter), nothing) << letter;
    EXPECT_NE(drawn(letter), box) << letter;
  }
  // All digits have the same width, so that readings do not move.
  const Sheet sheet = Drawing().sheet;
  EXPECT_EQ(sheet.text_width("1111", 17), sheet.text_width("8888", 17));
}

// An invalid byte is drawn as a replacement sign, and does not end the drawing.
TEST(Font, ReadsUtf8) {
  const auto drawn = [](const char* words) {
    Drawing drawing;
    drawing.sheet.text(10.0, 40.0, words, 20, kBlack);
    drawing.sheet.disc({80.0, 80.0}, 10.0, kBlack);
    return drawing.picture;
  };
  EXPECT_TRUE(same(drawn("\xff"
                         "a\xc2"),
                   drawn("\uFFFDa\uFFFD")));
  EXPECT_TRUE(same(drawn("\xef\xbf\xbf"), drawn("\uFFFD\uFFFD\uFFFD"))) << "U+FFFF";
  EXPECT_FALSE(same(drawn("aµ"), drawn("a\uFFFD")));
}

TEST(Unrolled, ABounceOfThreeMicrometresIsSeen) {
  const UnrolledView view(kClearance, 0.0);
  // In a plot of 500 pixels a bounce of 3 um rises 150 and more from the ring's line.
  EXPECT_GT(500.0 * (view.height_of(0.0) - view.height_of(3e-6)), 150.0);
  EXPECT_EQ(view.height_of(0.0), 1.0);
  EXPECT_GE(view.height_of(kClearance), 0.0);
  EXPECT_EQ(view.height_of(-1e-3), 1.0) << "no room for a penetration where there is none";
}

TEST(Unrolled, PenetrationGoesDownByTheSameLaw) {
  const UnrolledView view(kClearance, 20e-6);
  EXPECT_NEAR(view.height_of(-1e-6) - view.height_of(0.0),
              view.height_of(0.0) - view.height_of(1e-6), 1e-12);
  EXPECT_GT(view.height_of(-20e-6), view.height_of(-1e-6));
  EXPECT_LE(view.height_of(-20e-6), 1.0);
}

}  // namespace
}  // namespace rotorub::renders
