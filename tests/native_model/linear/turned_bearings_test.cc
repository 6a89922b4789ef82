// Mirrored and turned machines with films and pedestals: eigenvalues and motion must be the images.
#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <string>
#include <vector>

#include "native_model/linear/campbell.h"
#include "tests/support/native_run.h"
#include "tests/support/pairs.h"
#include "tests/support/symmetry.h"

namespace rotorub::test {
namespace {

Pair on_bearings(const std::vector<std::string>& names) {
  Pair pair{Form::kGeometry, {}};
  for (const Part& part : pair_parts()) {
    if (std::ranges::find(names, part.name) != names.end()) pair.parts.push_back(part);
  }
  return pair;
}

class TurnedBearings : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(TurnedBearings, AreTheImage) {
  const Pair pair = on_bearings(GetParam());
  ASSERT_EQ(pair.parts.size(), GetParam().size());
  // Modal damping belongs to the modes of x and of y. The speed is one of the table's, because a
  // monotone cubic of turned values is not the turned cubic.
  const std::vector<std::string> common{"rotor.damping_ratio=0.0", "rotor.speed=305.0"};
  const scene::Scene plain = scene_of(pair.form, pair.parts, common);
  const auto eigenvalues = whirl_eigenvalues(whirl_system(plain), plain.rotor.speed);
  const Trajectory run = run_event(plain);
  for (const Symmetry symmetry : {Symmetry::kMirrored, Symmetry::kTurned, Symmetry::kAskew}) {
    SCOPED_TRACE(static_cast<int>(symmetry));
    const Transformed by(plain, symmetry);
    if (!by.not_expressible().empty()) continue;
    std::vector<std::string> overrides = common;
    overrides.insert(overrides.end(), by.overrides().begin(), by.overrides().end());
    const scene::Scene scene = scene_of(pair.form, pair.parts, overrides);
    const auto turned = whirl_eigenvalues(whirl_system(scene), scene.rotor.speed);
    ASSERT_EQ(turned.size(), eigenvalues.size());
    for (const std::complex<double>& s : eigenvalues) {
      // With different planes each s stands for a conjugate pair.
      double least = std::abs(s);
      for (const std::complex<double>& other : turned) {
        least = std::min({least, std::abs(other - s), std::abs(std::conj(other) - s)});
      }
      EXPECT_LT(least, 1e-8 * std::abs(s)) << s;
    }
    if (symmetry == Symmetry::kAskew) continue;  // the few modes kept in x and y are others
    const Trajectory image = run_event(scene);
    ASSERT_EQ(image.rows(), run.rows());
    for (std::size_t k = 0; k < run.rows(); ++k) {
      const Eigen::Vector2d here = by.of({run.column("rotor_x")[k], run.column("rotor_y")[k]});
      const Eigen::Vector2d there(image.column("rotor_x")[k], image.column("rotor_y")[k]);
      EXPECT_LT((here - there).norm(), 1e-12) << run.column("t")[k];
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Of, TurnedBearings,
                         testing::Values(std::vector<std::string>{"film_tables"},
                                         std::vector<std::string>{"journal"},
                                         std::vector<std::string>{"pedestal"},
                                         std::vector<std::string>{"journal", "pedestal"}));

}  // namespace
}  // namespace rotorub::test
