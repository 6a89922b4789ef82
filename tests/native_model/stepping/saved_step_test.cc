#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "native_model/prepare/prepare.h"
#include "native_model/stepping/stepper.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

// A free spin with unbalance, rotating forces, impacts that take time, a compliant contact, several
// contacts, and magnetic bearings with states.
TEST(SavedStep, HasTheSizeThatFollowsFromTheModel) {
  for (const char* name : {"bench_ring", "blade_loss", "run_up", "finite_impacts", "compliant_ring",
                           "two_catchers", "amb_machine"}) {
    SCOPED_TRACE(name);
    const Model model = prepare(test::shipped(name));
    const VerletStepper stepper(model, 1e-6);
    const auto size = static_cast<std::ptrdiff_t>(VerletStepper::memory_size(model));
    std::vector<double> memory(static_cast<std::size_t>(size) + 1000,
                               std::numeric_limits<double>::quiet_NaN());
    stepper.save(memory.data());
    const auto written = [](double value) { return !std::isnan(value); };
    EXPECT_EQ(std::ranges::count_if(memory, written), size);
    EXPECT_TRUE(std::all_of(memory.begin(), memory.begin() + size, written));
  }
}

}  // namespace
}  // namespace rotorub
