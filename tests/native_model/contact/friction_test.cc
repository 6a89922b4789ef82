// The friction law by itself, and the sets that the solvers make of it.
#include "native_model/contact/friction.h"

#include <gtest/gtest.h>

#include "native_model/contact/coupled_law.h"
#include "native_model/contact/disc_law.h"
#include "native_model/numerics/lanes.h"

namespace rotorub {
namespace {

TEST(Friction, ANumberIsCoulombsLaw) {
  const FrictionLaw law = 0.3;
  for (const double slip : {-20.0, -1e-9, 0.0, 0.4, 5.0}) EXPECT_EQ(law.at(slip), 0.3);
  EXPECT_EQ(law.sticking(), 0.3);
  EXPECT_TRUE(law.is_constant());
  EXPECT_FALSE(law.none());
  EXPECT_TRUE(FrictionLaw{}.none());
  EXPECT_EQ(law.constant("a cone"), 0.3);
}

TEST(Friction, OfLanesIsThatOfEach) {
  using T = lanes::Lane<2>;
  FrictionOf<T> both;
  lanes::set(both.coefficient, 0, 0.1);
  lanes::set(both.coefficient, 1, 0.4);
  const T slip = lanes::all<T>(0.7);
  for (const int lane : {0, 1}) {
    const FrictionLaw own = both.coefficient[lane];
    EXPECT_EQ(both.at(slip)[lane], own.at(0.7));
  }
}

TEST(Friction, BoundsTheSetsAtTheSlipInQuestion) {
  const ImpactLaw law{0.3, 0.5, 0.2};
  const double slip = -2.0;
  EXPECT_EQ(expansion_set(law, slip, 1.0, 0.0).high(2.0), 2.0 * law.friction.at(slip));
  EXPECT_EQ(expansion_disc(law, slip, 1.0, {0.0, 0.0}).friction, law.friction.at(slip));
}

}  // namespace
}  // namespace rotorub
