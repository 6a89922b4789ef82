// Ends the program's work after SIGINT, SIGTERM and SIGHUP.
#include <unistd.h>

#include <atomic>
#include <csignal>

#include "compare/commands/command.h"

namespace rotorub {
namespace {

std::atomic<bool> interrupt_flag{false};
std::atomic<int> caught_signal{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "set in a signal handler");

// s until the program ends after SIGTERM or SIGHUP, whose sender does not watch it.
constexpr unsigned kGrace = 20;

extern "C" void on_alarm(int) { _exit(128 + caught_signal.load()); }

extern "C" void on_interrupt(int signal) {
  caught_signal.store(signal);
  interrupt_flag.store(true);
  if (signal == SIGINT) return;
  std::signal(SIGALRM, on_alarm);
  alarm(kGrace);
}

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = on_interrupt;
  sigemptyset(&action.sa_mask);
  // Without SA_RESTART, so that a blocking call ends. One-shot, so that the second signal has its
  // default effect.
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);  // nohup stays in effect
  }
}

const std::atomic<bool>& interrupted() { return interrupt_flag; }

int interrupting_signal() { return caught_signal.load(); }

}  // namespace rotorub
