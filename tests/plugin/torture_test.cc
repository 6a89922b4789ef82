// Everything that a program may do with models and data, a thousand times at random and interleaved
// over several models: each run has the bits of an undisturbed run.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <vector>

#include "mjcf/writer.h"
#include "plugin/hooks.h"
#include "tests/plugin/own/two_rings.h"
#include "tests/plugin/shadow.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

constexpr int kScenes = 10;

// Two contacts on one shaft, in a user's own model, which has its own entries of userdata before
// ours.
std::string pairs(const char* contact) {
  TwoRings x;
  x.contact = contact;
  x.friction = 0.15;
  x.ring_mass = 1.0;
  x.clearance[1] = 4e-4;
  x.custom = "<numeric name=\"rotorub_userdata\" data=\"11\"/>";
  x.constraints = "<keyframe><key name=\"start\" qvel=\"0.3 0.1 0.5 1 100 0 0 0 0\"/></keyframe>";
  return document(x);
}

// Scenes that use all of the plugin's memory, two of them with a shadow, and a model that is not
// ours.
const std::array<std::string, kScenes>& documents() {
  static const std::array<std::string, kScenes> all = {
      pairs("rigid"),
      pairs("coulomb"),
      mjcf(shipped("bench_ring", {"mujoco.contact=\"coulomb\""})),
      mjcf(shipped("bench_ring", {"mujoco.contact=\"cone\"", "contact.friction=0.3"})),
      mjcf(shipped("bench_billiard", {"mujoco.contact=\"rigid\""})),
      mjcf(shipped("paper_sliding",
                   {"controller.on=0.0", "controller.sample_time=1e-4", "force[0].on=0.0",
                    "initial.steady=false", "contact.clearance=\"0.1 mm\"", "rotor.modes=2",
                    "mujoco.contact=\"rigid\""})),
      mjcf(shipped(
          "paper_passive",
          {"mujoco={rotor=\"segments\", segments=10, contact=\"coulomb\"}", "force[0].on=0.0",
           "initial.steady=false", "contact.clearance=\"0.1 mm\"", "rotor.modes=2"})),
      mjcf(shadowed("paper_sliding",
                    {"controller.on=0.0", "controller.sample_time=1e-4", "force[0].on=0.0",
                     "initial.steady=false", "contact.clearance=\"0.1 mm\"", "rotor.modes=2"})),
      mjcf(shadowed("bench_ring", {"mujoco.contact=\"coulomb\""})),
      R"(<mujoco><size nuserdata="30"/><worldbody><geom type="plane" size="1 1 1"/>
           <body pos="0 0 1"><freejoint/><geom type="capsule" size="0.1 0.2"/></body>
         </worldbody></mujoco>)"};
  return all;
}

constexpr int kMostSteps = 1500;

// With the sensors of the shadow, if there is one.
std::vector<double> whole_state(const mjModel* m, const mjData* d) {
  std::vector<double> state = state_of(m, d);
  if (m->nmocap == 0) return state;
  state.insert(state.end(), d->sensordata, d->sensordata + m->nsensordata);
  return state;
}

// State after every number of steps from the start, of an undisturbed run.
class PlainRun {
 public:
  explicit PlainRun(const std::string& document) {
    const ModelPointer m = load(document);
    const DataPointer d = start(m.get());
    states_.push_back(whole_state(m.get(), d.get()));
    for (int k = 0; k < kMostSteps; ++k) {
      mj_step(m.get(), d.get());
      states_.push_back(whole_state(m.get(), d.get()));
    }
  }
  const std::vector<double>& at(int steps) const {
    return states_[static_cast<std::size_t>(steps)];
  }

 private:
  std::vector<std::vector<double>> states_;
};

struct Life {
  std::size_t scene = 0;
  ModelPointer model;
  DataPointer data;
  int steps = 0;  // from the start
};

class TortureTest : public HookedTest {
 protected:
  TortureTest() {
    for (const std::string& document : documents()) plain_.emplace_back(document);
    for (int i = 0; i < kScenes; ++i) runs_.push_back(fresh(static_cast<std::size_t>(i % kScenes)));
  }

  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
  Life& any() { return runs_[static_cast<std::size_t>(below(static_cast<int>(runs_.size())))]; }

  static Life fresh(std::size_t scene) {
    Life run{scene, load(documents()[scene]), nullptr, 0};
    run.data = start(run.model.get());
    return run;
  }
  // A model that is made again, perhaps at the address of the previous one.
  void reload() {
    Life& run = any();
    run.data.reset();
    run.model.reset();
    run = fresh(static_cast<std::size_t>(below(kScenes)));
  }
  static void step(Life& run, int count) {
    for (int k = 0; k < count && run.steps < kMostSteps; ++k, ++run.steps) {
      mj_step(run.model.get(), run.data.get());
    }
  }
  static void restart(Life& run) {
    mj_resetData(run.model.get(), run.data.get());
    if (run.model->nkey > 0) mj_resetDataKeyframe(run.model.get(), run.data.get(), 0);
    run.steps = 0;
  }
  // Into another mjData of an equal model, or else a new one.
  void copy() {
    const Life& from = any();
    Life& to = any();
    if (&from == &to) return;
    if (to.scene != from.scene) to = fresh(from.scene);
    mj_copyData(to.data.get(), to.model.get(), from.data.get());
    to.steps = from.steps;
  }
  // mj_copyModel gives the same model at another address.
  void copy_model() {
    Life& run = any();
    ModelPointer model(mj_copyModel(nullptr, run.model.get()));
    DataPointer data(mj_makeData(model.get()));
    mj_copyData(data.get(), model.get(), run.data.get());
    run.data = std::move(data);
    run.model = std::move(model);
  }
  // (mj_forward between steps is left out, because MuJoCo's solver then starts elsewhere and the
  // bits differ.)
  static void look(Life& run) {
    if (run.steps == kMostSteps) return;
    mj_step1(run.model.get(), run.data.get());
    mj_step2(run.model.get(), run.data.get());
    ++run.steps;
  }
  void expect_plain(const Life& run) {
    EXPECT_EQ(whole_state(run.model.get(), run.data.get()), plain_[run.scene].at(run.steps))
        << "scene " << run.scene << " after " << run.steps << " steps";
  }
  void act(int kind) {
    switch (kind) {
      case 0:
        return reload();
      case 1:
        return copy();
      case 2:
        return copy_model();
      case 3:
        return restart(any());
      case 4:
        return look(any());
      default:
        return step(any(), below(200));
    }
  }

  std::mt19937 random_{20240229};
  std::vector<PlainRun> plain_;
  std::vector<Life> runs_;
};

TEST_F(TortureTest, ResetsCopiesAndReloadsLeaveTheBits) {
  for (int k = 0; k < 1000 && !HasFailure(); ++k) {
    act(below(10));
    if (k % 4 == 0) expect_plain(any());
  }
  for (const Life& run : runs_) expect_plain(run);
}

// Foreign callbacks, before and after ours, removed in any order.
using Callback = void (*)(const mjModel*, mjData*);
constexpr int kOthers = 4;
std::array<Callback, kOthers> below_other{};
std::array<int, kOthers> other_calls{};
template <int I>
void other(const mjModel* m, mjData* d) {
  ++other_calls[I];
  if (below_other[I]) below_other[I](m, d);
}
constexpr std::array<Callback, kOthers> kOther = {other<0>, other<1>, other<2>, other<3>};

// Takes one link out of the chain that begins at `head`.
void unlink(Callback& head, int which) {
  if (head == kOther[static_cast<std::size_t>(which)]) {
    head = below_other[static_cast<std::size_t>(which)];
    return;
  }
  for (int i = 0; i < kOthers; ++i) {
    Callback& next = below_other[static_cast<std::size_t>(i)];
    if (next != kOther[static_cast<std::size_t>(which)]) continue;
    next = below_other[static_cast<std::size_t>(which)];
  }
}

TEST(Chains, CallbacksOfOthersInAnyOrder) {
  std::mt19937 random(7);
  const ModelPointer m = load(documents()[2]);
  std::vector<double> plain;
  {
    const plugin::Hooks hooks;
    plain = state_after(m.get(), 300);
  }
  for (int round = 0; round < 50; ++round) {
    below_other = {};
    const Callback before = mjcb_control;
    // Only foreign callbacks before ours: those after ours are called by it and cannot be removed.
    std::optional<plugin::Hooks> hooks(std::in_place);
    std::vector<int> order = {0, 1, 2, 3};
    std::shuffle(order.begin(), order.end(), random);
    for (const int i : order) {
      below_other[static_cast<std::size_t>(i)] = mjcb_control;
      mjcb_control = kOther[static_cast<std::size_t>(i)];
    }
    other_calls = {};
    EXPECT_EQ(state_after(m.get(), 300), plain);
    for (const int calls : other_calls) EXPECT_EQ(calls, 300);

    std::shuffle(order.begin(), order.end(), random);
    const int ours = static_cast<int>(random() % 5);
    for (int k = 0; k < 5; ++k) {
      if (k == ours) {
        hooks.reset();
        EXPECT_NE(state_after(m.get(), 300), plain) << "ours must be silent";
        EXPECT_EQ(mjcb_passive, nullptr);
      }
      if (k < 4) unlink(mjcb_control, order[static_cast<std::size_t>(k)]);
      if (k < ours) {
        EXPECT_EQ(state_after(m.get(), 300), plain);
      }
    }
    // Buried when it was restored, ours stays as a link that only passes on; a new Hooks takes that
    // place again, and gives it back now that nobody is in front.
    { const plugin::Hooks again; }
    EXPECT_EQ(mjcb_control, before) << "round " << round;
  }
}

}  // namespace
}  // namespace rotorub::test
