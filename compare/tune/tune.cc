#include "compare/tune/tune.h"

#include <algorithm>
#include <cmath>

#include "native_model/system/model.h"

namespace rotorub::tune {

TuneResult tune_scene(const bench::SceneReader& reader, const TuneParameters& parameters) {
  TuneResult result;
  result.scene = reader({});
  result.tolerance = parameters.tolerance;
  result.modes = make_model(result.scene).layout.modes;
  const auto stopped = [&] {
    result.interrupted = parameters.interrupt && parameters.interrupt->load();
    return result.interrupted;
  };
  const auto say = [&](double share, const std::string& what) {
    if (parameters.progress) parameters.progress(share, what);
  };

  // 1. Every variant, the coarsest step first.
  References references(result.scene, parameters.twins, parameters.interrupt);
  const Runner run = mujoco_runner(reader, parameters.interrupt);
  SearchParameters how;
  how.steps = parameters.steps;
  how.variants = variants(result.scene.mujoco);
  // How far down the ladder it has to go is not known: each rung is taken for half of the rest.
  how.before = [&](const Setting& setting) {
    const auto rung = std::find(how.steps.begin(), how.steps.end(), setting.step);
    say(0.8 * (1.0 - std::pow(0.5, static_cast<double>(rung - how.steps.begin()))), text(setting));
  };
  how.interrupt = parameters.interrupt;
  result.settings =
      search(how, run, judge_by(references, parameters.tolerance), parameters.tolerance);
  if (stopped()) return result;

  // 2. Clean times of those near the choice.
  say(0.8, "times");
  time_again(result.settings, run, parameters.timing, parameters.interrupt);
  if (stopped()) return result;
  result.choice = choose(result.settings);

  // 3. Whose fault the rest is.
  say(0.9, "errors by their causes");
  if (result.choice.trusted) {
    split_errors(result.settings[*result.choice.trusted].setting, run, references, result.errors);
  } else {
    result.errors.contact.reason = result.errors.step.reason = "no setting can be trusted";
  }
  ModelErrorParameters ladder;
  ladder.tolerance = parameters.tolerance;
  ladder.step = result.choice.trusted ? result.settings[*result.choice.trusted].setting.step
                                      : result.scene.run.step;
  ladder.interrupt = parameters.interrupt;
  if (result.scene.rotor.geometry)
    ladder.spread = single_run_intervals(references.at(ladder.step, ladder.step).samples);
  if (stopped()) return result;
  result.model_error = model_error(result.scene, ladder);
  stopped();
  return result;
}

}  // namespace rotorub::tune
