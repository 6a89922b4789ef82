#include "native_model/event/contact_state.h"

#include <gtest/gtest.h>

namespace rotorub {
namespace {

constexpr double kMu = 0.5, kNoForce = 1e-10;
const Delassus kPlain{1.0, 0.0, 0.0, 2.0};

struct Decision {
  Status status;
  const char* reason;
  ContactState next;
};

Decision select(double normal, double tangential, double slip, double scale = 0.0,
                const Delassus& g = kPlain) {
  ContactMatrix a(2, 2);
  a << g.nn, g.nt, g.tn, g.tt;
  const ContactVector b = Eigen::Vector2d(normal, tangential);
  ContactVector scales(1);
  scales << scale;
  const ContactDecisions all = select_contact_modes(a, b, scales, {&slip, 1}, {&kMu, 1}, kNoForce);
  return {all.status, all.reason, all.next.empty() ? ContactState{} : all.next[0]};
}

TEST(ContactState, PartsWhereNothingPresses) {
  for (const double slip : {0.0, 0.3, -0.3}) {
    const Decision d = select(0.1, 0.0, slip);
    EXPECT_EQ(d.status, Status::kOk);
    EXPECT_EQ(d.next.mode, ContactMode::kFree);
    EXPECT_EQ(d.next.departure, Departure::kParting);
  }
}

TEST(ContactState, SlidesTheWayItSlips) {
  for (const double sign : {1.0, -1.0}) {
    const Decision d = select(-1.0, 100.0, sign * 1e-9);
    EXPECT_EQ(d.next.mode, ContactMode::kSlide);
    EXPECT_EQ(d.next.slip_sign, sign) << "whatever the acceleration";
  }
}

// Without slip: friction of at most mu lambda_N = 0.5 N holds accelerations up to 2 x 0.5 m/s^2.
TEST(ContactState, WithoutSlipTheConeDecides) {
  EXPECT_EQ(select(-1.0, 0.99, 0.0).next.mode, ContactMode::kStick);
  for (const double sign : {1.0, -1.0}) {
    const Decision d = select(-1.0, sign * 1.01, 0.0);
    EXPECT_EQ(d.next.mode, ContactMode::kSlide);
    EXPECT_EQ(d.next.slip_sign, sign);
  }
}

TEST(ContactState, RoundOffOfEitherSignIsContactWithoutForce) {
  for (const double normal : {1e-12, -1e-12}) {
    EXPECT_EQ(select(normal, 0.0, 0.1, 1.0).next.mode, ContactMode::kSlide);
    EXPECT_EQ(select(normal, 0.1, 0.0, 1.0).next.mode, ContactMode::kSlide)
        << "nothing to stick with";
  }
  EXPECT_EQ(select(1e-9, 0.0, 0.1, 1.0).next.mode, ContactMode::kFree)
      << "that is more than round-off";
  EXPECT_EQ(select(0.0, 0.0, 0.1, 0.0).next.mode, ContactMode::kFree) << "nothing acts at all";
}

TEST(ContactState, ReportsJamming) {
  // mu G_NT > G_NN for positive slip.
  const Delassus jams{1.0, 3.0, 3.0, 10.0};
  const Decision pressed = select(-1.0, 0.0, 0.1, 0.0, jams);
  EXPECT_EQ(pressed.status, Status::kNoSolution);
  EXPECT_STRNE(pressed.reason, "");
  EXPECT_EQ(select(1.0, 0.0, 0.1, 0.0, jams).status, Status::kAmbiguous);
  EXPECT_EQ(select(-1.0, 0.0, -0.1, 0.0, jams).status, Status::kOk);
}

TEST(ContactState, ThePhaseEndsAtTheMarginThatIsReached) {
  const MarginScales scales{100.0, 0.1};
  EXPECT_EQ(end_of_phase(ContactMode::kSlide, {0.0, 0.05}, scales), PhaseEnd::kOpens);
  EXPECT_EQ(end_of_phase(ContactMode::kSlide, {10.0, 0.0}, scales), PhaseEnd::kSlipStops);
  EXPECT_EQ(end_of_phase(ContactMode::kStick, {10.0, 0.0}, scales), PhaseEnd::kSlipBegins);
  EXPECT_EQ(end_of_phase(ContactMode::kStick, {0.0, 0.0}, scales), PhaseEnd::kOpens)
      << "with its cone";
}

TEST(ContactState, EveryChangeIsAnEventAndNoOtherIs) {
  const ContactState free{}, plus{ContactMode::kSlide, 1.0}, minus{ContactMode::kSlide, -1.0},
      stick{ContactMode::kStick, 0.0};
  EXPECT_EQ(event_between(free, plus), EventKind::kSlide);
  EXPECT_EQ(event_between(stick, minus), EventKind::kSlide);
  EXPECT_EQ(event_between(plus, stick), EventKind::kStick);
  EXPECT_EQ(event_between(plus, minus), EventKind::kReverse);
  EXPECT_EQ(event_between(minus, free), EventKind::kLiftOff);
  for (const ContactState& s : {free, plus, minus, stick}) EXPECT_FALSE(event_between(s, s));
}

}  // namespace
}  // namespace rotorub
