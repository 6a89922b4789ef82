// What the kernels of many lanes do run by run, for the least processor.
#include "native_model/stepping/lane_steps.h"

namespace rotorub {

#define ROTORUB_SMALL_RUN_BY_RUN(L, W) ROTORUB_RUN_BY_RUN(template, Sized<Lanes<W>, L>)
#define ROTORUB_ALL_RUN_BY_RUN(W)        \
  ROTORUB_RUN_BY_RUN(template, Lanes<W>) \
  ROTORUB_SMALL_LAYOUTS(ROTORUB_SMALL_RUN_BY_RUN, W)

ROTORUB_ALL_RUN_BY_RUN(2)
ROTORUB_ALL_RUN_BY_RUN(4)
ROTORUB_ALL_RUN_BY_RUN(8)

}  // namespace rotorub
