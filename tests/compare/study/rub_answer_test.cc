#include <gtest/gtest.h>

#include "compare/run_files/summary.h"

namespace rotorub {
namespace {

Metrics rub(std::size_t hard_impacts, Attractor last) {
  Metrics m;
  m.first_touch = 0.1071;
  m.hard_impacts = hard_impacts;
  m.mean_force = 59.8;
  m.settled.attractor = last;
  return m;
}

TEST(RubAnswer, SaysWhenHowHardAndWhatBecomesOfIt) {
  EXPECT_EQ(rub_answer(rub(699, Attractor::kSynchronousRub)),
            "yes, from 107.1 ms: 699 hard impacts, synchronous rub in the last fifth of the run; "
            "mean normal force 59.80 N");
  EXPECT_EQ(rub_answer(rub(1, Attractor::kNoContact)),
            "yes, from 107.1 ms: 1 hard impact, without contact at the end; mean normal "
            "force 59.80 N");
}

TEST(RubAnswer, SaysHowNearARotorComesThatDoesNotTouch) {
  Metrics m;
  EXPECT_EQ(rub_answer(m), "no, rotor and ring do not touch");
  m.least_gap = 75e-6;
  EXPECT_EQ(rub_answer(m), "no, the rotor stays 75 µm clear of the ring");
  EXPECT_EQ(rub_answer(m, 0.1), "no contact up to 100 ms, where the run stopped");
}

}  // namespace
}  // namespace rotorub
