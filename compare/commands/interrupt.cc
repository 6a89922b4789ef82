#include "compare/commands/interrupt.h"

#include <unistd.h>

#include <csignal>

namespace rotorub {
namespace {

std::atomic<bool> flag{false};
std::atomic<int> caught{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "set in a signal handler");

// s that a program asked to end by whoever does not look at it (SIGTERM, SIGHUP) has for it.
constexpr unsigned kGrace = 20;

extern "C" void on_alarm(int) { _exit(128 + caught.load()); }

extern "C" void on_interrupt(int signal) {
  caught.store(signal);
  flag.store(true);
  if (signal == SIGINT) return;
  std::signal(SIGALRM, on_alarm);
  alarm(kGrace);
}

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = on_interrupt;
  sigemptyset(&action.sa_mask);
  // Not restarted: a blocking call ends. Once only: the second signal has its default effect.
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);  // nohup stays
  }
}

const std::atomic<bool>& interrupted() { return flag; }

int interrupting_signal() { return caught.load(); }

}  // namespace rotorub
