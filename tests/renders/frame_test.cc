#include "renders/frame.h"

#include <gtest/gtest.h>

#include "tests/renders/samples.h"

namespace rotorub::renders {
namespace {

// Small and without smoothing: every pixel has one of the plain colours.
RenderOptions small_options() {
  RenderOptions options;
  options.width = 640;
  options.height = 360;
  options.samples = 0;
  options.from = 0.0;
  options.magnification = 40.0;
  return options;
}

Picture picture_of(const Row& row, const RenderOptions& options = small_options()) {
  const scene::Scene scene = ring_scene();
  const Trajectory run = resting_run(row);
  return FramePainter(scene, run, options).paint(0.05);
}

// The cross-section is the right part above the curves; its first line is text.
Found in_section(const Picture& picture, const Test& test) {
  return find(picture, picture.width() * 58 / 100, 30, picture.width(), picture.height() * 3 / 4,
              test);
}
Found in_machine(const Picture& picture, const Test& test) {
  return find(picture, 0, 0, picture.width() / 2, picture.height() * 3 / 4, test);
}

TEST(Frame, ShowsEveryPartInItsColour) {
  const Picture picture = picture_of({});
  ASSERT_EQ(picture.width(), 640);
  ASSERT_EQ(picture.height(), 360);
  EXPECT_GT(in_section(picture, is_rotor).count, 2000);
  EXPECT_GT(in_section(picture, is_ring).count, 2000);
  EXPECT_GT(in_machine(picture, is_rotor).count, 100);
  EXPECT_GT(in_machine(picture, is_ring).count, 50);
  EXPECT_GT(find(picture, is_light).count, 640 * 360 / 5);  // the ground stays light
  // Text: dark pixels in the corner above the machine.
  EXPECT_GT(find(picture, 0, 0, 200, 30, [](int r, int g, int b) { return r + g + b < 330; }).count,
            50);
}

// Each of two contacts has its cross-section, the first above, and each moves as its own columns
// do.
TEST(Frame, ShowsEachOfSeveralContacts) {
  scene::Scene scene = ring_scene();
  scene.auxiliary.push_back(scene.first());
  const auto picture = [&](const Row& first, const Row& second) {
    Trajectory run = resting_run(first);
    for (const Column& column : resting_run(second).series) {
      const bool own = column.name.starts_with("rotor_") || column.name.starts_with("stator_") ||
                       column.name == "gap" || column.name == "normal_force" ||
                       column.name == "friction_force" || column.name == "mode";
      if (own) run.series.push_back({"contact2_" + column.name, column.unit, column.values});
    }
    return FramePainter(scene, run, small_options()).paint(0.05);
  };
  const auto half = [](const Picture& from, bool upper) {
    const int middle = 30 + (from.height() * 3 / 4 - 30) / 2;
    return find(from, from.width() * 58 / 100, upper ? 30 : middle, from.width(),
                upper ? middle : from.height() * 3 / 4, is_rotor);
  };
  constexpr double kMove = 0.4 * kClearance;
  const Picture rest = picture({}, {}), moved = picture({}, {.rotor_x = kMove});
  EXPECT_GT(half(rest, true).count, 500);
  EXPECT_GT(half(rest, false).count, 500);
  EXPECT_NEAR(half(moved, true).column, half(rest, true).column, 1e-9);
  EXPECT_GT(half(moved, false).column - half(rest, false).column, 2.0);
}

TEST(Frame, RotorMovesAsItsStateDoes) {
  constexpr double kMove = 0.4 * kClearance;
  const Found rest = in_section(picture_of({}), is_rotor);
  const Found right = in_section(picture_of({.rotor_x = kMove}), is_rotor);
  const Found up = in_section(picture_of({.rotor_y = kMove}), is_rotor);
  // x to the right, y up: the picture is neither mirrored nor upside down. Rows count downwards.
  EXPECT_GT(right.column - rest.column, 4.0);
  EXPECT_GT(rest.row - up.row, 4.0);
  // The same length in both directions, and none across: within what the mark, which hides a part
  // of the rotor, and whole pixels change of a mean.
  constexpr double kPixels = 1.0;
  EXPECT_NEAR(right.column - rest.column, rest.row - up.row, kPixels);
  EXPECT_NEAR(right.row, rest.row, kPixels);
  EXPECT_NEAR(up.column, rest.column, kPixels);
}

TEST(Frame, RingMovesAsItsStateDoes) {
  // The ring of a resting rotor, off centre. The visible area is wider then, so the test measures
  // the direction.
  const Picture picture = picture_of({.stator_x = 0.4 * kClearance});
  const Found ring = in_section(picture, is_ring);
  const Found rotor = in_section(picture, is_rotor);
  EXPECT_GT(ring.column, rotor.column + 4.0);
}

TEST(Frame, MagnificationScalesTheMotionAlone) {
  RenderOptions options = small_options();
  const auto moved = [&](double magnification) {
    options.magnification = magnification;
    return in_section(picture_of({.rotor_x = 0.4 * kClearance}, options), is_rotor).column -
           in_section(picture_of({}, options), is_rotor).column;
  };
  EXPECT_GT(moved(40.0), 1.5 * moved(20.0));
}

// The number of light pixels between the rotor's middle and the ring.
int light_pixels_outwards(const Picture& picture, int column, int row, int step) {
  int light = 0;
  for (; column > 0 && column < picture.width(); column += step) {
    const auto p = picture.pixel(column, row);
    if (is_ring(p[0], p[1], p[2])) return light;
    if (is_light(p[0], p[1], p[2])) ++light;
  }
  return -1;
}

TEST(Frame, CirclesTouchWhenTheRotorTouches) {
  const Picture touching = picture_of({.rotor_x = kClearance});
  const Found rotor = in_section(touching, is_rotor);
  // A row below the axis through the middle, which is a line.
  const int row = static_cast<int>(rotor.row) + 4;
  const int column = static_cast<int>(rotor.column);
  // At most the pixels that the grid leaves open, against the whole clearance on the other side.
  EXPECT_LE(light_pixels_outwards(touching, column, row, 1), 2);
  EXPECT_GT(light_pixels_outwards(touching, column, row, -1), 20);
}

TEST(Frame, ForcesAreDrawnInContactOnly) {
  const Picture free = picture_of({.rotor_x = kClearance});
  const Picture pressed =
      picture_of({.rotor_x = kClearance, .normal_force = 100.0, .friction_force = -30.0});
  // Right of the legend, whose bars have the forces' colours.
  const auto drawn = [](const Picture& picture, const renders::Test& test) {
    return find(picture, picture.width() * 66 / 100, 30, picture.width(), picture.height() * 3 / 4,
                test);
  };
  EXPECT_EQ(drawn(free, is_red).count, 0);
  EXPECT_EQ(drawn(free, is_green).count, 0);
  const Found normal = drawn(pressed, is_red);
  const Found friction = drawn(pressed, is_green);
  EXPECT_GT(normal.count, 60);
  EXPECT_GT(friction.count, 15);
  // On the rotor: the normal force points from the ring inwards, to the left here; friction -30 N
  // along e_t = e_y points down.
  const Found rotor = in_section(pressed, is_rotor);
  EXPECT_GT(normal.column, rotor.column);
  EXPECT_GT(friction.row, normal.row);
}

TEST(Frame, MarkTurnsWithTheRotor) {
  const auto mark = [](int r, int g, int b) { return b > 240 && r > 170 && r < 230 && g > 200; };
  const Found first = in_section(picture_of({}), mark);
  const Found quarter = in_section(picture_of({.spin_angle = 1.5707963}), mark);
  ASSERT_GT(first.count, 100);
  ASSERT_GT(quarter.count, 100);
  // From the right upper quarter to the left upper one: spin about +z is counter-clockwise.
  EXPECT_LT(quarter.column, first.column - 10.0);
  EXPECT_NEAR(quarter.row, first.row, 3.0);
}

TEST(Frame, ShaftBendsWithTheRotor) {
  const Found rest = in_machine(picture_of({}), is_rotor);
  const Found up = in_machine(picture_of({.rotor_y = 0.8 * kClearance}), is_rotor);
  EXPECT_GT(rest.row - up.row, 2.0);
}

TEST(Frame, ShadowIsDrawnTranslucent) {
  const auto ghost = [](int r, int g, int b) {
    return r > 100 && b > 120 && g + 50 < std::min(r, b);
  };
  const scene::Scene scene = ring_scene();
  const Trajectory run = resting_run({});
  const Trajectory other = resting_run({.rotor_x = -kClearance});
  RenderOptions options = small_options();
  EXPECT_EQ(in_section(FramePainter(scene, run, options).paint(0.05), ghost).count, 0);
  options.shadow = &other;
  const Picture picture = FramePainter(scene, run, options).paint(0.05);
  EXPECT_GT(in_section(picture, ghost).count, 50);
  // The run itself is visible through the ghost.
  EXPECT_LT(in_section(picture, ghost).column, in_section(picture, is_rotor).column);
}

// One camera and one scale: each run is drawn as beside itself, and equal runs look alike.
TEST(Frame, RunsSideBySideAreDrawnAlike) {
  const scene::Scene scene = ring_scene();
  const Trajectory run = whirling_run();
  const Trajectory other =
      resting_run({.rotor_x = -kClearance, .normal_force = 300.0, .friction_force = 40.0});
  RenderOptions options = small_options();
  options.width = 960;
  options.view = FilmView::kAxis;
  options.beside = &run;
  const Picture twice = FramePainter(scene, run, options).paint(0.03);
  // Below the header, whose text belongs to the whole picture.
  for (int row = 40; row < twice.height(); ++row) {
    for (int column = 0; column < 480; ++column) {
      ASSERT_EQ(twice.pixel(column, row), twice.pixel(column + 480, row)) << column << ' ' << row;
    }
  }
  options.beside = &other;
  const Picture pair = FramePainter(scene, run, options).paint(0.03);
  EXPECT_LT(find(pair, 480, 40, 960, 250, is_rotor).column - 480.0,
            find(pair, 0, 40, 480, 250, is_rotor).column + 60.0);
  EXPECT_FALSE(same(pair, twice));
}

TEST(Frame, EveryViewOfTheContactIsAnotherPicture) {
  const scene::Scene scene = ring_scene();
  const Trajectory run = whirling_run();
  std::vector<Picture> pictures;
  for (const FilmView view :
       {FilmView::kRig, FilmView::kAxis, FilmView::kCloseUp, FilmView::kUnrolled}) {
    EXPECT_EQ(view_of(to_string(view)), view);
    RenderOptions options = small_options();
    options.view = view;
    pictures.push_back(FramePainter(scene, run, options).paint(0.03));
    for (std::size_t k = 0; k + 1 < pictures.size(); ++k) {
      EXPECT_FALSE(same(pictures[k], pictures.back())) << to_string(view);
    }
    EXPECT_GT(find(pictures.back(), is_ring).count, 200) << to_string(view);
    if (view == FilmView::kRig) continue;
    expect_thrown<std::invalid_argument>(
        [&] { FramePainter(free_scene(), resting_run({}), options); }, "expected rig");
  }
}

TEST(Frame, SceneWithoutContactShowsTheMachineAlone) {
  RenderOptions options = small_options();
  options.magnification.reset();
  const scene::Scene scene = free_scene();
  const Trajectory low = resting_run({});
  const Trajectory high = resting_run({.rotor_x = 1e-3, .rotor_y = 1e-3});
  const auto shaft = [](int r, int g, int b) {
    return r > 60 && r < 200 && std::abs(r - g) < 25 && b > r && b < r + 45;
  };
  options.machine_magnification = 50.0;
  const Picture rest = FramePainter(scene, low, options).paint(0.05);
  const Picture moved = FramePainter(scene, high, options).paint(0.05);
  EXPECT_GT(find(rest, shaft).count, 500);
  EXPECT_FALSE(same(rest, moved));
}

TEST(Frame, ShippedRigIsDrawnFromItsGeometry) {
  // The scene has two modes and the run one, so they do not belong together.
  const scene::Scene rig = rig_of_two_modes();
  const Trajectory run = whirling_run();
  expect_thrown<std::runtime_error>([&] { FramePainter(rig, run, small_options()); },
                                    "paper_passive");

  const Trajectory both = with_second_mode(run, 0.0, 0.0);
  FramePainter painter(rig, both, small_options());
  const Picture picture = painter.paint(0.02);
  EXPECT_GT(in_section(picture, is_rotor).count, 1000);
}

TEST(Frame, ChosenMagnificationsArePlainAndStated) {
  RenderOptions options = small_options();
  options.magnification.reset();
  const scene::Scene scene = ring_scene();
  const Trajectory run = whirling_run();
  const FramePainter painter(scene, run, options);
  // 0.45 of the rotor's radius of 50 mm for 0.5 mm: at most 45.
  EXPECT_EQ(painter.framing().magnification, 40.0);
  EXPECT_GT(painter.framing().machine_magnification, 1.0);
}

}  // namespace
}  // namespace rotorub::renders
