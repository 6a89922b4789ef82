// Every shipped scene, mirrored and turned, by every engine: the motion must be the mirrored and
// the turned one. No engine knows which way is up or round, so a sign, an axis or a sense that
// stands where it should not shows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "native_model/scene/diagnostic.h"
#include "tests/compare/shipped/engines.h"
#include "tests/support/every_third.h"
#include "tests/support/order.h"
#include "tests/support/symmetry.h"

namespace rotorub::test {
namespace {

// Largest distance of rotor, ring and the rotor's mark on its circumference from the image of the
// other run, m.
double distance(const Trajectory& a, const Trajectory& image, const Transformed& by,
                double radius) {
  double most = 0.0;
  const auto &turn = a.column("spin_angle"), &image_turn = image.column("spin_angle");
  for (std::size_t k = 0; k < std::min(a.rows(), image.rows()); ++k) {
    for (const auto& [x, y] :
         {std::pair{"rotor_x", "rotor_y"}, std::pair{"stator_x", "stator_y"}}) {
      const Eigen::Vector2d here = by.of({a.column(x)[k], a.column(y)[k]});
      most =
          std::max(most, (here - Eigen::Vector2d(image.column(x)[k], image.column(y)[k])).norm());
    }
    const double turned = by.sense() * (turn[k] - turn[0]) - (image_turn[k] - image_turn[0]);
    most = std::max(most, radius * std::abs(turned));
  }
  return most;
}

// Machines with axes that no key turns: an actuator at 45 degrees, magnetic bearings, a ring or
// modes with values of their own in x and y.
constexpr std::string_view kScenesWithAxes =
    " amb_machine drop dtu_rig finite_impacts hard/current_saturation hard/force_saturation "
    "hard/late_control hard/magnet_past_stiffness hard/painleve hard/painleve_below "
    "paper_cross_coupled paper_emulated paper_magnetic paper_passive paper_passive_high_friction "
    "paper_rolling paper_sliding paper_sliding_sampled paper_two_phase relevitation touchdown "
    "hard/unstable_magnet ";

const char* word(Symmetry symmetry) {
  return symmetry == Symmetry::kMirrored ? ", mirrored"
         : symmetry == Symmetry::kTurned ? ", turned"
                                         : ", turned askew";
}

// To round-off, as far as a twin that starts some units in the last place aside stays beside it.
void expect_symmetric(const std::string& name) {
  std::optional<scene::Scene> whole;
  try {
    whole = shipped(name);
  } catch (const scene::SceneError&) {
    return;  // one that is there to be refused
  }
  const std::vector<std::string> plain{"run.end=" +
                                       std::to_string(std::min(whole->run.end, 0.115))};
  const double clearance = whole->first().contact->clearance,
               radius = whole->first().contact->radius;
  for (const Symmetry symmetry : {Symmetry::kMirrored, Symmetry::kTurned, Symmetry::kAskew}) {
    const Transformed by(*whole, symmetry);
    if (!by.not_expressible().empty()) {
      EXPECT_TRUE(kScenesWithAxes.find(" " + name.substr(1) + " ") != std::string_view::npos)
          << by.not_expressible();
      continue;
    }
    std::vector<std::string> overrides = plain;
    overrides.insert(overrides.end(), by.overrides().begin(), by.overrides().end());
    if (by.sense() < 0.0 && whole->drive && whole->drive->kind == scene::DriveKind::kKloss) {
      EXPECT_THROW(shipped(name, overrides), scene::SceneError)
          << "Kloss' formula is of a motor that turns forward";
      continue;
    }
    for (const NamedEngine& e : engines()) {
      const auto a = run(e, name, plain), image = run(e, name, overrides);
      const std::string what = e.engine->name() + " " + e.override_ + word(symmetry);
      ASSERT_EQ(a.has_value(), image.has_value()) << what;
      if (!a) continue;
      const bool askew = symmetry == Symmetry::kAskew;
      // One step of euler goes as deep as the clearance there: whether that is too deep is
      // round-off.
      if (askew && name == "/hard/tiny_clearance" && a->integrator == "euler") continue;
      EXPECT_EQ(a->status, image->status) << what << ": " << a->message << " | " << image->message;
      if (a->status != Status::kOk) continue;
      const double apart = distance(*a, *image, by, radius);
      const double arc = radius * std::abs(a->column("spin_angle").back());  // its round-off counts
      // Turned askew every number of the scene is rounded anew, and event's error norm is of other
      // axes.
      const double floor = askew ? std::max(e.floor, kSolver) : e.floor;
      const auto bound = [&](double of) {
        return floor * clearance + (askew ? 1e4 : 100.0) * of + 1e-14 * arc;
      };
      double scatter = 0.0;
      // One twin may by chance stay near where others do not: where it does, those of the image are
      // asked too.
      for (const auto& [start, of, aside] : {std::tuple{&plain, &a, 8},
                                             {&overrides, &image, 8},
                                             {&plain, &a, 7},
                                             {&overrides, &image, 7},
                                             {&plain, &a, 64},
                                             {&overrides, &image, 64}}) {
        scatter = std::max(scatter, rotor_error(**of, *run(e, name, *start, aside)));
        if (apart <= bound(scatter)) break;
      }
      EXPECT_LE(apart, bound(scatter)) << what << ": twins differ by " << scatter << " m";
    }
  }
}

class LongSymmetry : public ::testing::TestWithParam<std::string> {};
TEST_P(LongSymmetry, EveryEngineSeesTheSameMachine) { expect_symmetric(GetParam()); }

class NightlySymmetry : public ::testing::TestWithParam<std::string> {};
TEST_P(NightlySymmetry, EveryEngineSeesTheSameMachine) { expect_symmetric(GetParam()); }

std::vector<std::string> all_scenes() {
  std::vector<std::string> all = scenes_of("");
  const std::vector<std::string> hard = scenes_of("/hard");
  all.insert(all.end(), hard.begin(), hard.end());
  return all;
}

std::string name_of(const ::testing::TestParamInfo<std::string>& scene) {
  std::string name = scene.param.substr(1);
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Shipped, LongSymmetry, ::testing::ValuesIn(every_third(all_scenes())),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Shipped, NightlySymmetry, ::testing::ValuesIn(all_scenes()), name_of);

}  // namespace
}  // namespace rotorub::test
