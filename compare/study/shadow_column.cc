#include "compare/study/shadow_column.h"

#include "native_model/scene/diagnostic.h"

namespace rotorub {
ShadowColumn shadow_column(Runner& runner, const Side& native,
                           std::shared_ptr<const CommandRecord> commands,
                           const CompareOptions& options) {
  ShadowColumn column;
  column.driven = commands != nullptr;
  RunRequest request;
  request.commands = std::move(commands);
  // Impacts that take time are verlet's alone.
  for (const auto integrator : {scene::Integrator::kMidpoint, scene::Integrator::kVerlet}) {
    try {
      column.side = runner.shown({"shadow", native_engine(integrator), kNativeWork}, request);
      break;
    } catch (const scene::SceneError& error) {
      column.absent = error.what();
    }
  }
  if (!column.side) return column;
  if (column.side->trajectory.status != Status::kOk) {
    column.absent = std::string("it ended early (") + to_string(column.side->trajectory.status) +
                    "): " + column.side->trajectory.message;
    column.side.reset();
    return column;
  }
  for (const Figure& f : figures()) {
    column.figures.push_back(
        judged(f, f.value(native.metrics), f.value(column.side->metrics), options.tolerance));
  }
  return column;
}

}  // namespace rotorub
