// Several contacts on MuJoCo's modal chain against a second program
// (tests/native_model/event/two_rings).

#include <gtest/gtest.h>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "plugin/generated_rotor.h"
#include "plugin/hooks.h"
#include "tests/plugin/scenes.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/two_rings.h"

namespace rotorub::test {
namespace {

// Largest error of a position at the second program's rows, over the clearance of the first ring;
// of the impulses of a ring, over its normal impulse.
struct Errors {
  double place = 0.0, normal = 0.0, friction = 0.0;
};

// Column of a coordinate of the native layout, as the series has it.
std::vector<std::string> columns_of(const Model& model) {
  std::vector<std::string> names(static_cast<std::size_t>(model.nq()));
  const Layout& l = model.layout;
  for (int k = 0; k < l.modes; ++k) {
    names[static_cast<std::size_t>(l.x() + k)] = "x_" + std::to_string(k + 1);
    names[static_cast<std::size_t>(l.y() + k)] = "y_" + std::to_string(k + 1);
  }
  for (std::size_t k = 0; k < model.auxiliary.size(); ++k) {
    const AuxiliaryBearing& at = model.auxiliary[k];
    const std::string contact = k == 0 ? "" : "contact2_";
    if (!at.moves()) continue;
    names[static_cast<std::size_t>(at.ring)] = contact + "stator_x";
    names[static_cast<std::size_t>(at.ring + 1)] = contact + "stator_y";
  }
  return names;
}

Errors errors(const std::string& name, const std::string& contact, double step) {
  const plugin::Hooks hooks;
  const std::vector<std::string> overrides{"mujoco.contact=\"" + contact + "\"",
                                           "run.step=" + std::to_string(1e6 * step) + "e-6"};
  const scene::Scene scene = scene::read_scene(two_rings_file(name + ".toml"), overrides);
  const nlohmann::json exact = two_rings_answer(name);
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  const plugin::Config config = plugin::make_config(m.get());
  const std::vector<std::string> columns = columns_of(config.model);
  Errors e;
  double impulse[2] = {0.0, 0.0}, friction[2] = {0.0, 0.0};
  const auto sense = [&](std::size_t k, const char* of) {
    return sensor(m.get(), d.get(), mjcf_names::of_bearing(k, of).c_str());
  };
  const auto last = static_cast<std::size_t>(std::llround(scene.run.end / step));
  std::size_t row = 0;
  for (std::size_t at = 0; at <= last; ++at) {
    const auto& rows = exact.at("rows");
    if (row < rows.size() &&
        std::llround(rows[row].at("t").get<double>() / step) == static_cast<long long>(at)) {
      const plugin::Coordinates state(config, d.get());
      for (std::size_t i = 0; i < columns.size(); ++i) {
        const auto& due = rows[row].at("state");
        if (columns[i].empty() || !due.contains(columns[i])) continue;
        const double off = state.q()[i] - due.at(columns[i]).get<double>();
        e.place = std::max(e.place, std::abs(off) / scene.first().contact->clearance);
      }
      ++row;
    }
    mj_step(m.get(), d.get());
    EXPECT_EQ(sensor(m.get(), d.get(), mjcf_names::kActive), 1.0);
    for (std::size_t k = 0; k < 2; ++k) {
      impulse[k] += step * sense(k, mjcf_names::kNormalForce);
      friction[k] += step * sense(k, mjcf_names::kFrictionForce);
    }
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const double normal = exact.at("contacts").at("normal_impulse")[k];
    const double due = exact.at("contacts").at("friction_impulse")[k];
    e.normal = std::max(e.normal, std::abs(impulse[k] - normal) / normal);
    e.friction = std::max(e.friction, std::abs(friction[k] - due) / normal);
  }
  return e;
}

class TwoRingsInMujoco : public MujocoTest, public testing::WithParamInterface<const char*> {};

TEST_P(TwoRingsInMujoco, RigidAgreesToTheOrderOfTheStep) {
  const Errors coarse = errors(GetParam(), "rigid", 2e-5), fine = errors(GetParam(), "rigid", 2e-6);
  std::printf("%s: place %g, %g; normal %g, %g; friction %g, %g\n", GetParam(), coarse.place,
              fine.place, coarse.normal, fine.normal, coarse.friction, fine.friction);
}

TEST_P(TwoRingsInMujoco, CoulombAgreesAsASoftContactDoes) {
  const Errors e = errors(GetParam(), "coulomb", 2e-6);
  std::printf("%s: place %g; normal %g; friction %g\n", GetParam(), e.place, e.normal, e.friction);
}

INSTANTIATE_TEST_SUITE_P(, TwoRingsInMujoco,
                         testing::Values("drop", "rub", "moving", "rolling", "conical",
                                         "cylindrical"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace rotorub::test
