#include "compare/commands/stored_run.h"

#include <stdexcept>

#include "compare/commands/command.h"
#include "native_model/scene/diagnostic.h"

namespace rotorub {

StoredRun stored_run(const std::string& folder) {
  try {
    StoredRun run = read_run(folder);
    check_series(run.trajectory, folder + "/series.csv");
    return run;
  } catch (const scene::SceneError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw UsageError(error.what());
  }
}

}  // namespace rotorub
