// The table of rotorub tune, of a made-up result.
#include "compare/tune/table.h"

#include <gtest/gtest.h>

#include <sstream>

namespace rotorub::tune {
namespace {

// A figure's line has its own causes, whichever figures each of them can tell.
TEST(TuneTable, EachCauseStandsAtItsFigure) {
  TuneResult r;
  r.tolerance = 0.01;
  JudgedSetting s;
  s.setting.contact = scene::ContactModel::kRigid;
  s.setting.step = 1e-5;
  s.us_per_step = 1.0;
  for (const char* key : {"mean_force", "whirl_frequency", "gap_rate_rms"}) {
    s.figures.push_back(judged(figure(key), 100.0, 100.1, r.tolerance));
  }
  s.trust = trust(s.figures);
  r.settings = {s};
  r.choice = choose(r.settings);
  r.errors.contact.figures = {{&figure("gap_rate_rms"), 0.02}};
  FigureLimit modes;
  modes.figure = &figure("gap_rate_rms");
  modes.values = {1.0, 1.0};
  modes.error = -0.0238;
  r.model_error.modes = {8, 11};
  r.model_error.figures = {modes};
  std::istringstream table(tune_table(r, Palette(false)));
  std::string text;
  bool seen = false;
  while (std::getline(table, text)) {
    if (text.starts_with("  mean normal force")) {
      EXPECT_EQ(text.find("-2.38 %"), std::string::npos) << text;
    }
    if (text.starts_with("  rms gap rate") && !seen) {
      seen = true;
      EXPECT_NE(text.find("-2.38 %"), std::string::npos) << text;
      EXPECT_NE(text.find("+2.00 %"), std::string::npos) << text;
    }
  }
  EXPECT_TRUE(seen);
}

}  // namespace
}  // namespace rotorub::tune
