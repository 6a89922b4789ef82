// The shadow's step takes no memory from the heap.
#include <gtest/gtest.h>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "plugin/hooks.h"
#include "tests/plugin/shadow.h"
#include "tests/support/counted_new.h"

namespace rotorub::test {
namespace {

class ShadowAllocation : public MujocoTest {};

TEST_F(ShadowAllocation, NoneInAStepAfterTheFirst) {
  if (!ROTORUB_COUNTS_ALLOCATIONS) GTEST_SKIP() << "the sanitizer owns operator new";
  // The counter counts, or nothing below means anything.
  const std::int64_t begun = allocations;
  ::operator delete(::operator new(64));
  ASSERT_EQ(allocations - begun, 1);
  const plugin::Hooks hooks;
  const std::vector<std::string> early = {"force[0].on=0.0", "initial.steady=false",
                                          "contact.clearance=0.1 mm", "rotor.modes=2"};
  for (const char* name : {"paper_passive", "paper_sliding", "bench_ring"}) {
    SCOPED_TRACE(name);
    const std::string scene = name;
    const auto overrides = scene == "bench_ring" ? std::vector<std::string>{} : early;
    const ModelPointer m = load(mjcf(shadowed(scene, overrides)));
    const DataPointer d = start(m.get());
    mj_step(m.get(), d.get());
    bool touched = false;
    const std::int64_t before = allocations;
    for (int k = 0; k < 3000; ++k) {
      mj_step(m.get(), d.get());
      touched = touched || sensor(m.get(), d.get(), mjcf_names::kShadowNormalForce) > 0.0;
    }
    const std::int64_t count = allocations - before;
    EXPECT_EQ(count, 0);
    EXPECT_TRUE(touched);
  }
}

}  // namespace
}  // namespace rotorub::test
