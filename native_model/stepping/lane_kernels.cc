// What the kernels of many lanes do run by run, for the least processor.
#include "native_model/stepping/lane_steps.h"

namespace rotorub {

ROTORUB_RUN_BY_RUN(template, 2);
ROTORUB_RUN_BY_RUN(template, 4);
ROTORUB_RUN_BY_RUN(template, 8);

}  // namespace rotorub
