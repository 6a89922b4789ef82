#include "compare/check/engines.h"

namespace rotorub::check {
namespace {

using scene::RuleEngine;

CheckEngine native(scene::Integrator integrator, RuleEngine word) {
  std::shared_ptr<const Engine> engine = native_engine(integrator);
  return {engine->name(), rotorub::to_string(integrator),          word,
          true,           integrator == scene::Integrator::kEvent, engine};
}

CheckEngine mujoco(scene::ContactModel contact, RuleEngine word) {
  std::shared_ptr<const Engine> engine = mujoco_engine(contact);
  const char* column =
      contact == scene::ContactModel::kConeCoulomb ? "cone-c" : scene::to_string(contact);
  return {engine->name(), column, word, false, false, engine};
}

}  // namespace

const std::vector<CheckEngine>& check_engines() {
  static const std::vector<CheckEngine> all{
      native(scene::Integrator::kEvent, RuleEngine::kNativeEvent),
      native(scene::Integrator::kMidpoint, RuleEngine::kNativeMidpoint),
      native(scene::Integrator::kVerlet, RuleEngine::kNativeVerlet),
      mujoco(scene::ContactModel::kRigid, RuleEngine::kMujocoRigid),
      mujoco(scene::ContactModel::kCoulomb, RuleEngine::kMujocoCoulomb),
      mujoco(scene::ContactModel::kCone, RuleEngine::kMujocoCone),
      mujoco(scene::ContactModel::kConeCoulomb, RuleEngine::kMujocoConeCoulomb)};
  return all;
}

std::vector<scene::Rule> rules_for(const CheckEngine& engine,
                                   const std::vector<scene::Rule>& rules) {
  const auto of = [&](RuleEngine family) {
    std::vector<scene::Rule> own;
    for (const scene::Rule& rule : rules) {
      if (rule.engine == engine.word || rule.engine == family) own.push_back(rule);
    }
    return own;
  };
  const std::vector<scene::Rule> own =
      of(engine.native ? RuleEngine::kNative : RuleEngine::kMujoco);
  return engine.native || !own.empty() ? own : of(RuleEngine::kNative);
}

}  // namespace rotorub::check
