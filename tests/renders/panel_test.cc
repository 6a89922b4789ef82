#include "renders/panel.h"

#include <gtest/gtest.h>

namespace rotorub::renders {
namespace {

TEST(Panel, SaysOfAWhirlHowFastItIs) {
  EXPECT_EQ(strobe_text({-11285.0, 2e-4}),
            "whirl -1,796 Hz: one position every 0.2 ms, 0.36 turns apart");
}

}  // namespace
}  // namespace rotorub::renders
