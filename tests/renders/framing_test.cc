#include "renders/framing.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/renders/samples.h"

namespace rotorub::renders {
namespace {

TEST(Framing, FirstFrameAndLastAreTheEndsOfTheWindow) {
  const Trajectory run = whirling_run();
  RenderOptions options;
  options.from = 0.02;
  options.to = 0.06;
  options.frames_per_second = 20.0;
  options.slow_motion = 50.0;
  const Framing framing = make_framing(Playback(run), options);
  EXPECT_EQ(framing.frames, 40);  // 0.04 s * 50 * 20 / s
  EXPECT_DOUBLE_EQ(framing.slow_motion, 50.0);
  EXPECT_EQ(framing.time(0), 0.02);
  EXPECT_DOUBLE_EQ(framing.time(39), 0.06);
}

TEST(Framing, DurationGivesTheSlowMotion) {
  const Trajectory run = whirling_run();
  RenderOptions options;
  options.from = 0.0;
  options.duration = 4.0;
  options.frames_per_second = 25.0;
  const Framing framing = make_framing(Playback(run), options);
  EXPECT_EQ(framing.frames, 100);
  EXPECT_DOUBLE_EQ(framing.slow_motion, 40.0);
}

TEST(Framing, BeginsShortlyBeforeTheFirstContact) {
  const Trajectory late = made_run(101, [](double t) {
    return Row{.rotor_x = kClearance, .normal_force = t > 0.0495 ? 5.0 : 0.0};
  });
  const Framing framing = make_framing(Playback(late), {});
  EXPECT_LT(framing.from, 0.05);
  EXPECT_GT(framing.from, 0.04);
  EXPECT_EQ(framing.to, 0.1);
  const Trajectory never = resting_run({});
  EXPECT_EQ(make_framing(Playback(never), {}).from, 0.0);
}

TEST(Framing, WindowEndingARoundingErrorLaterIsTaken) {
  const Trajectory run = whirling_run();
  RenderOptions options;
  options.to = 0.1 * (1.0 + 1e-12);
  EXPECT_EQ(make_framing(Playback(run), options).to, 0.1);
}

TEST(Framing, RefusesAWindowOutsideOfTheRun) {
  const Trajectory run = whirling_run();
  const Playback playback(run);
  for (const auto& [from, to] : {std::pair{-0.01, 0.05}, {0.02, 0.2}, {0.05, 0.05}, {0.06, 0.02}}) {
    RenderOptions options;
    options.from = from;
    options.to = to;
    EXPECT_THROW(make_framing(playback, options), std::invalid_argument) << from << ' ' << to;
  }
  RenderOptions endless;
  endless.slow_motion = 1e9;
  EXPECT_THROW(make_framing(playback, endless), std::invalid_argument);
}

struct Refused {
  const char* option;
  void (*spoil)(RenderOptions&);
};

TEST(Framing, HardestImpactIsOneThatIsShown) {
  Trajectory run = resting_run({});
  const auto impact = [](double t, double impulse) {
    return Impact{.t = t, .normal_impulse = impulse, .gap_rate_before = -0.1};
  };
  run.impacts = {impact(0.02, 9.0), impact(0.05, 1.0), impact(0.06, 3.0)};
  const Playback playback(run);
  RenderOptions options;
  options.from = 0.04;
  EXPECT_EQ(hardest_impact(playback, make_framing(playback, options)), 0.06);
  options.from = 0.08;
  EXPECT_DOUBLE_EQ(hardest_impact(playback, make_framing(playback, options)), 0.09);
}

TEST(Framing, RefusesOptionsByName) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  static double value;
  value = nan;
  const Refused cases[] = {
      {"width", [](RenderOptions& o) { o.width = 4000; }},
      {"width", [](RenderOptions& o) { o.width = 0; }},
      {"height", [](RenderOptions& o) { o.height = 100000; }},
      {"frames per second", [](RenderOptions& o) { o.frames_per_second = 0.0; }},
      {"frames per second", [](RenderOptions& o) { o.frames_per_second = value; }},
      {"samples", [](RenderOptions& o) { o.samples = 3; }},
      {"slow motion", [](RenderOptions& o) { o.slow_motion = 0.0; }},
      {"slow motion", [](RenderOptions& o) { o.slow_motion = value; }},
      {"duration", [](RenderOptions& o) { o.duration = -1.0; }},
      {"magnification", [](RenderOptions& o) { o.magnification = 0.5; }},
      {"magnification", [](RenderOptions& o) { o.machine_magnification = value; }},
  };
  EXPECT_NO_THROW(check_options({}));
  for (const Refused& refused : cases) {
    RenderOptions options;
    refused.spoil(options);
    try {
      check_options(options);
      ADD_FAILURE() << refused.option << " was taken";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(refused.option), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace rotorub::renders
