// A user's law in Python: its command, its state, and the message if it fails.
#include "native_model/control/library.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "native_model/model/actuation.h"
#include "native_model/prepare/prepare.h"
#include "native_model/run/run_native.h"
#include "tests/native_model/control/own_law.h"
#include "tests/support/native_run.h"
#include "tests/support/temporary_folder.h"

namespace rotorub {
namespace {

using test::expect_said;

const std::string kCreate = "def create(setup):\n    return None\n";
const std::string kStep = "def step(law, now, state):\n    ";

class PythonLawTest : public testing::Test {
 protected:
  // A scene with this text as its law.
  scene::Scene law(const std::string& text, const std::string& config = "",
                   const std::vector<std::string>& overrides = {}) const {
    return test::own_law_scene(folder_.write("law.py", text).string(), config, overrides);
  }
  std::string refusal(const std::string& text) const { return test::own_law_refusal(law(text)); }
  std::string message(const std::string& text) const {
    const Trajectory t = run_native(law(text));
    EXPECT_EQ(t.status, Status::kControllerFailed);
    return t.message;
  }
  std::string place(int line) const {
    return "(" + (folder_ / "law.py").string() + ":" + std::to_string(line) + ")";
  }

  const test::TemporaryFolder folder_;
};

// The law of the shipped example, computed here a second time.
TEST_F(PythonLawTest, CommandsWhatItsLawSays) {
  const std::string file =
      std::string(ROTORUB_SOURCE_DIR) + "/native_model/control/examples/tracking_law.py";
  const Model m = prepare(test::own_law_scene(file, "stiffness = 2e5\ndamping = 300\n"));
  std::vector<double> memory(m.first().loop->memory_size(), 0.0);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(m.nq()), v = q;
  for (int k = 0; k < 4; ++k) {
    q << 1e-4 + 2e-5 * k, -5e-5, 1e-5 * k, 3e-5;
    v << 0.05, 0.01, -0.02, 0.03 * k;
    ASSERT_EQ(m.layout.ring(), 2);
    const double t = 0.002 + 5e-4 * k, s = (t - 0.002) / 0.008, r = 1.0 - s;
    const Eigen::Vector2d d = q.head(2) - q.tail(2), e = d.normalized();
    const double error = 0.5e-3 - d.norm() - 0.5e-3 * r * r * r * (1.0 + 3.0 * s + 6.0 * s * s);
    const double push = 2e5 * error - 300.0 * e.dot(v.head(2) - v.tail(2));
    const Eigen::Vector2d u = control_sample(m, t, q.data(), v.data(), {0.0, 0.0}, memory.data());
    EXPECT_LT((u + push * e).norm(), 1e-12 * std::abs(push)) << k;
  }
}

// start() sets the initial state, and every number of the state is kept.
TEST_F(PythonLawTest, KeepsItsStateWithTheRun) {
  const std::string counts =
      "def create(setup):\n    return setup['config']\n"
      "def state_size(law):\n    return 3\n"
      "def start(law, state):\n    state[0], state[2] = law['first'], 0.1\n" +
      kStep +
      "state[0] += 1.0\n    state[1] = now['sample']\n"
      "    return state[0], state[1] + (1000.0 if state[2] != 0.1 else 0.0)\n";
  const scene::Scene s = law(counts, "first = 40\n");
  const Model m = prepare(s);
  EXPECT_EQ(m.first().controller->state_size(), 3u);
  std::vector<double> begun(3, 0.0);
  m.first().controller->start(begun.data());
  EXPECT_EQ(begun, (std::vector<double>{40.0, 0.0, 0.1}));
  scene::Scene run = s;
  run.run.output_step = 5e-4;
  const Trajectory t = test::complete(run_native(run));
  const auto &x = t.column("control_x"), &y = t.column("control_y");
  ASSERT_GT(x.size(), 18u);
  // Sample k coincides with row k, which has the command before or after it.
  for (std::size_t row = 2; row < x.size(); ++row) EXPECT_NEAR(x[row] - y[row], 41.0, 1e-9) << row;
}

// The law does not affect the rotor here, so both integrators sample the same states.
TEST_F(PythonLawTest, ARunIsTheSameEachTime) {
  // The order of a set of texts depends on Python's seed.
  const std::string text = "names = {'alpha', 'beta', 'gamma', 'delta', 'epsilon'}\n" + kCreate +
                           kStep +
                           "return sum(k * len(n) for k, n in enumerate(names)), now['rotor'][0]\n";
  const Trajectory first = test::complete(run_native(law(text)));
  for (int again = 0; again < 3; ++again) {
    const Trajectory t = test::complete(run_native(law(text)));
    EXPECT_EQ(first.column("control_x"), t.column("control_x"));
    EXPECT_EQ(first.column("rotor_x"), t.column("rotor_x"));
  }
}

// One process runs one law after the other, and each starts afresh: the file and its imports from
// its folder are read again, after the previous law has ended.
TEST_F(PythonLawTest, EveryRunBeginsAlikeInTheSameProcess) {
  folder_.write("gains.py", "count = 0\nbase = 10.0\n");
  const std::string text =
      "import gains, os\n"
      "def create(setup):\n    gains.count += 1\n    return gains.base + gains.count\n" +
      kStep + "return law, 1e-9 * os.getpid()\n" +
      "def destroy(law):\n    open(__file__ + '.ended', 'a').write(f'{law} ')\n";
  const auto command = [&] {
    scene::Scene s = law(text);
    s.run.end = 1e-3;
    const Trajectory t = test::complete(run_native(s));
    return std::pair(t.column("control_x").back(), t.column("control_y").back());
  };
  const auto first = command(), second = command();
  EXPECT_NEAR(first.first, 11.0, 1e-9);
  EXPECT_NEAR(second.first, 11.0, 1e-9);
  EXPECT_NEAR(first.second, second.second, 1e-12) << "the same process";
  folder_.write("gains.py", "count = 0\nbase = 20.0\n");
  EXPECT_NEAR(command().first, 21.0, 1e-9) << "an edited file is read again";
  std::ifstream ended(folder_ / "law.py.ended");
  std::string said;
  std::getline(ended, said);
  EXPECT_EQ(said, "11.0 11.0 21.0 ");
}

// As in a comparison of many settings, whose models live until its end.
TEST_F(PythonLawTest, ManyLawsAtATimeShareProcesses) {
  const std::string text = "import os\ndef create(setup):\n    return setup['config']['gain']\n" +
                           kStep + "return law, float(os.getpid())\n";
  const std::size_t processors = std::max(1u, std::thread::hardware_concurrency());
  std::vector<Model> models;
  for (std::size_t k = 0; k < 8 * processors; ++k)
    models.push_back(prepare(law(text, "gain = " + std::to_string(k) + "\n")));
  std::set<double> processes;
  for (std::size_t k = 0; k < models.size(); ++k) {
    const Eigen::Vector2d u = models[k].first().controller->command({}, {}, nullptr);
    EXPECT_EQ(u.x(), static_cast<double>(k));
    processes.insert(u.y());
  }
  EXPECT_GE(processes.size(), processors);
  EXPECT_LE(processes.size(), 4 * processors);
}

TEST_F(PythonLawTest, OneLawServesSeveralThreads) {
  const Model m = prepare(law(kCreate + kStep + "return 3.0, now['rotor'][0]\n"));
  std::vector<std::thread> threads;
  std::vector<int> right(4, 0);
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&, thread] {
      Measurement now{};
      now.rotor = {10.0 + thread, 0.0};
      for (int k = 0; k < 200; ++k) {
        const Eigen::Vector2d u = m.first().controller->command(now, {}, nullptr);
        right[static_cast<std::size_t>(thread)] += u == Eigen::Vector2d(3.0, 10.0 + thread);
      }
    });
  }
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(right, std::vector<int>(4, 200));
}

TEST_F(PythonLawTest, AnExceptionEndsTheRunWithItsTraceback) {
  const std::string said = message(kCreate +
                                   "def limited(t):\n"
                                   "    if t >= 0.002: raise ValueError('no more')\n" +
                                   kStep + "limited(now['t'])\n    return 1.0, 2.0\n");
  expect_said(said, {"law.py at t = 0.002", "ValueError: no more, in step " + place(6),
                     "in limited " + place(4), "`if t >= 0.002: raise ValueError('no more')`"});
}

// A failure never appears as a number in the results.
TEST_F(PythonLawTest, AFailedRunHasOnlyFiniteRows) {
  const Trajectory t = run_native(
      law(kCreate + kStep + "return (float('nan') if now['sample'] == 8 else 1.0), 0.0\n"));
  EXPECT_EQ(t.status, Status::kControllerFailed);
  expect_said(t.message, {"law.py at t = 0.004", "its command is not finite"});
  for (const auto& column : t.series) {
    for (const double x : column.values) ASSERT_TRUE(std::isfinite(x)) << column.name;
  }
}

// Typical first mistakes with a law in Python: the function, the number of values, the keys.
TEST_F(PythonLawTest, NamesWhatIsMissing) {
  const std::string zeros = kStep + "return 0.0, 0.0\n";
  expect_said(refusal(zeros), {"controller.library", "law.py has no function create(setup)"});
  expect_said(refusal(kCreate), {"law.py has no function step(law, now, state)"});
  expect_said(refusal("def create(setup):\n    return setup['gain']\n" + zeros),
              {"controller.config", "KeyError: 'gain', in create " + place(2),
               "setup has the keys sample_time", "config"});
  expect_said(message(kCreate + kStep + "pass\n"),
              {"step() returns NoneType; return two numbers, ux and uy"});
  expect_said(message(kCreate + kStep + "return 0.0, 0.0, 0.0\n"),
              {"step() returns 3 numbers; return two numbers, ux and uy"});
  expect_said(message(kCreate + kStep + "return now['rotor_x'], 0.0\n"),
              {"KeyError: 'rotor_x', in step " + place(4), "now has the keys t, sample, rotor, "});
  expect_said(message(kCreate + kStep + "state[0] = 1.0\n"), {"IndexError", "in step " + place(4)});
}

TEST_F(PythonLawTest, SaysWhyAFileIsNoLaw) {
  expect_said(refusal(kCreate + "def step(law, now, state)\n"),
              {"controller.library", "SyntaxError: expected ':' " + place(3)});
  expect_said(refusal("import no_such_module\n"),
              {"No module named 'no_such_module'", "in <module> " + place(1),
               "ROTORUB_PYTHON selects another"});
  expect_said(refusal(kCreate + kStep + "return 0.0, 0.0\ncommand = 'torque'\n"),
              {"command is 'torque'", "force", "current"});
  expect_said(refusal(kCreate + kStep + "return 0.0, 0.0\ncommand = 'current'\n"),
              {"law.py: commands currents"});
  expect_said(refusal(kCreate + kStep + "return 0.0, 0.0\ndef state_size(law):\n    return -1\n"),
              {"state_size() returns -1"});
}

// Whatever the law does to its process, the run ends with a message.
TEST_F(PythonLawTest, AProcessThatEndsEndsTheRun) {
  expect_said(message("import os\n" + kCreate + kStep + "os._exit(7)\n"),
              {"its Python process ended with exit code 7"});
  expect_said(message("import os\n" + kCreate + kStep + "os.kill(os.getpid(), 9)\n"),
              {"its Python process was ended by a signal: Killed"});
  expect_said(message("import sys\n" + kCreate + kStep + "sys.exit(0)\n"),
              {"SystemExit: 0, in step " + place(5)});
}

TEST_F(PythonLawTest, SaysHowToGetPython) {
  setenv("ROTORUB_PYTHON", "/nowhere/python3", 1);
  expect_said(refusal(kCreate), {"controller.library", "needs Python 3", "/nowhere/python3",
                                 "install python3, or set ROTORUB_PYTHON"});
  unsetenv("ROTORUB_PYTHON");
}

}  // namespace
}  // namespace rotorub
