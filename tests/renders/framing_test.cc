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
  const Trajectory late = late_touch();
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

TEST(Framing, RefusesAFilmOfNothingAndOneWithoutEnd) {
  const Trajectory run = whirling_run();
  RenderOptions nothing, endless;
  nothing.from = nothing.to = 0.05;
  endless.slow_motion = 1e9;
  EXPECT_THROW(make_framing(Playback(run), nothing), std::invalid_argument);
  EXPECT_THROW(make_framing(Playback(run), endless), std::invalid_argument);
}

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
  static constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const struct {
    const char* option;
    void (*spoil)(RenderOptions&);
  } cases[] = {
      {"width", [](RenderOptions& o) { o.width = 4000; }},
      {"width", [](RenderOptions& o) { o.width = 0; }},
      {"height", [](RenderOptions& o) { o.height = 100000; }},
      {"frames per second", [](RenderOptions& o) { o.frames_per_second = 0.0; }},
      {"frames per second", [](RenderOptions& o) { o.frames_per_second = kNan; }},
      {"samples", [](RenderOptions& o) { o.samples = 3; }},
      {"slow motion", [](RenderOptions& o) { o.slow_motion = 0.0; }},
      {"slow motion", [](RenderOptions& o) { o.slow_motion = kNan; }},
      {"duration", [](RenderOptions& o) { o.duration = -1.0; }},
      {"magnification", [](RenderOptions& o) { o.magnification = 0.5; }},
      {"magnification", [](RenderOptions& o) { o.machine_magnification = kNan; }},
  };
  EXPECT_NO_THROW(check_options({}));
  for (const auto& refused : cases) {
    RenderOptions options;
    refused.spoil(options);
    expect_thrown<std::invalid_argument>([&] { check_options(options); }, refused.option);
  }
}

std::vector<Strike> strikes_at(const std::vector<double>& times) {
  std::vector<Strike> strikes;
  for (const double t : times) strikes.push_back({t, 1.0, {1.0, 0.0}});
  return strikes;
}

TEST(FilmClock, RunsEvenlyWithoutImpacts) {
  const FilmClock clock({0.1, 0.3}, 8.0, {});
  EXPECT_EQ(clock.time(0.0), 0.1);
  EXPECT_DOUBLE_EQ(clock.time(0.5), 0.2);
  EXPECT_EQ(clock.time(1.0), 0.3);
  EXPECT_DOUBLE_EQ(clock.slow(0.2), 40.0);
}

TEST(FilmClock, StretchesAroundAnImpactInView) {
  const auto strikes = strikes_at({0.05, 0.2});  // the first is before the film
  const FilmClock clock({0.1, 0.3}, 8.0, strikes);
  EXPECT_EQ(clock.impacts(), std::vector<double>{0.2});
  EXPECT_DOUBLE_EQ(clock.slow(0.2), 10.0 * clock.slow(0.12));
  EXPECT_DOUBLE_EQ(clock.slowest(), clock.slow(0.2));
  EXPECT_LT(clock.base(), 40.0) << "the film is as long as asked: the rest goes faster";
  EXPECT_EQ(clock.time(0.0), 0.1);
  EXPECT_EQ(clock.time(1.0), 0.3);
}

// slow(t) is what time(share) does: d(film)/d(run) by differences.
TEST(FilmClock, SaysHowSlowItIs) {
  const auto strikes = strikes_at({0.15, 0.2, 0.28});
  const double duration = 8.0;
  const FilmClock clock({0.1, 0.3}, duration, strikes);
  double before = clock.time(0.0);
  constexpr int kFrames = 2000;
  for (int k = 1; k <= kFrames; ++k) {
    const double now = clock.time(static_cast<double>(k) / kFrames);
    ASSERT_GT(now, before) << "never stands, never goes back";
    const double slow = duration / kFrames / (now - before);
    EXPECT_NEAR(slow, clock.slow(0.5 * (now + before)), 0.02 * slow) << now;
    before = now;
  }
}

TEST(FilmClock, ManyImpactsShareHalfOfTheFilm) {
  std::vector<double> times;
  for (int k = 0; k < 700; ++k) times.push_back(0.1 + 0.2 * k / 700.0);
  auto strikes = strikes_at(times);
  strikes[350].impulse = 5.0;
  const FilmClock clock({0.1, 0.3}, 8.0, strikes);
  EXPECT_EQ(clock.impacts().size(), 6U);
  EXPECT_EQ(clock.impacts().front(), strikes.front().t) << "the first touch";
  EXPECT_NEAR(clock.slow(strikes[350].t), clock.slowest(), 1e-9 * clock.slowest()) << "the hardest";
  // 8 s for 0.2 s would be 40 throughout; half of the film for impacts leaves 20 for the rest, and
  // a little more where they overlap or reach beyond the film.
  EXPECT_GE(clock.base(), 20.0);
  EXPECT_LT(clock.base(), 30.0);
}

TEST(FilmClock, SlowsDownADecisivePartForTwoThirdsOfTheFilm) {
  const FilmClock clock({0.0, 10.0}, 9.0, {}, Span{1.0, 1.2});
  EXPECT_NEAR(clock.slow(1.1), 6.0 / 0.2, 1e-9);
  EXPECT_NEAR(clock.slow(0.5), 3.0 / 9.8, 1e-9);
  EXPECT_DOUBLE_EQ(clock.slow(5.0), clock.slow(0.5));
  EXPECT_EQ(clock.time(0.0), 0.0);
  EXPECT_EQ(clock.time(1.0), 10.0);
  EXPECT_NEAR(clock.time(1.0 / 9.8 / 3.0), 1.0, 1e-6);
  EXPECT_NEAR(clock.time(1.0 / 9.8 / 3.0 + 2.0 / 3.0), 1.2, 1e-6);
  EXPECT_EQ(clock.text(), "slowed down 30 times from 1 s to 1.2 s, 0.3061 times elsewhere");
}

// A whirl in touch with the ring from `touch` on, with velocities.
Trajectory whirl_of(double turns_a_second, double touch) {
  const double speed = 2.0 * 3.141592653589793 * turns_a_second;
  Trajectory run = made_run(20001, [=](double t) {
    const double size = t < touch ? 0.5 * kClearance : kClearance;
    return Row{.rotor_x = size * std::cos(speed * t),
               .rotor_y = size * std::sin(speed * t),
               .normal_force = t < touch ? 0.0 : 10.0};
  });
  const std::vector<double> x = run.column("rotor_x"), y = run.column("rotor_y");
  const std::vector<double> none(run.rows(), 0.0);
  for (const char* name : {"stator_vx", "stator_vy"}) run.series.push_back({name, "", none});
  run.series.push_back({"rotor_vx", "", y});
  run.series.push_back({"rotor_vy", "", x});
  for (double& v : run.series[run.series.size() - 2].values) v *= -speed;
  for (double& v : run.series.back().values) v *= speed;
  return run;
}

// In an earlier film every frame showed more than a turn of the whirl.
TEST(Framing, AWhirlTurnsAtMostAnEighthBetweenFramesAfterTheFirstTouch) {
  for (const double turns : {20.0, 300.0, 3000.0}) {
    const Trajectory run = whirl_of(turns, 0.03);
    RenderOptions options;
    options.from = 0.0;
    options.duration = 6.0;
    options.frames_per_second = 25.0;
    const Framing framing = make_framing(Playback(run), options);
    const double frame = 1.0 / (25.0 * framing.clock.slow(0.03));
    EXPECT_LE(turns * frame, 1.0 / 8.0) << turns;
    EXPECT_EQ(framing.time(framing.frames - 1), 0.1) << "the rest is shown as well";
    options.slow_motion = 60.0;
    EXPECT_DOUBLE_EQ(make_framing(Playback(run), options).clock.slow(0.03), 60.0);
  }
}

TEST(Framing, LabelsBeginWithTheWordsOfAComparison) {
  Trajectory run;
  run.engine = "mujoco";
  run.integrator = "Euler";
  run.contact_model = "cone";
  EXPECT_EQ(engine_label(run), "MuJoCo alone: Euler, cone contact");
  run.contact_model = "rigid";
  EXPECT_EQ(engine_label(run), "MuJoCo with the plugin: Euler, rigid contact");
  run.engine = "native";
  run.integrator = "event";
  EXPECT_EQ(engine_label(run), "native: event, rigid contact");
}

}  // namespace
}  // namespace rotorub::renders
