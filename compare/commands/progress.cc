#include "compare/commands/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace rotorub {
namespace {

using namespace std::chrono_literals;
constexpr auto kPatience = 2s;  // shorter work shows nothing
constexpr auto kRefresh = 100ms;
constexpr int kWidth = 28;

}  // namespace

ProgressBar::ProgressBar(bool quiet)
    : enabled_(!quiet && isatty(STDERR_FILENO) == 1), start_(Clock::now()), last_(start_) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::show(double share, const std::string& what) {
  if (!enabled_) return;
  const auto now = Clock::now();
  if (now - start_ < kPatience || now - last_ < kRefresh) return;
  last_ = now;
  share = std::clamp(share, 0.0, 1.0);
  const auto full = static_cast<std::size_t>(share * kWidth);
  const double passed = std::chrono::duration<double>(now - start_).count();
  fmt::print(stderr, "\r\033[K[{}{}] {:3.0f} %  {:.0f} s  {}", std::string(full, '='),
             std::string(kWidth - full, ' '), 100.0 * share, passed, what);
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressBar::clear() {
  if (!drawn_) return;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace rotorub
