#include "plugin/model/differentiating.h"

namespace rotorub::plugin {
namespace {

thread_local constinit bool running = false;

}  // namespace

Differentiating::Differentiating() { running = true; }
Differentiating::~Differentiating() { running = false; }

bool Differentiating::in_this_thread() { return running; }

}  // namespace rotorub::plugin
