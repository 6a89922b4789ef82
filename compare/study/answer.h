// The answer to what the user asked: one row a contact model, the same on the terminal, in the JSON
// and on the page.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// Whether a contact model has shown forces that can be judged. The exit code and `Trust` do not
// ask.
enum class Showing {
  kForces,
  kNothing,  // nothing touches: there is no contact force
  kFailed    // the native run or the controller failed, which is no fault of the contact model
};
Showing showing(const SceneComparison& comparison, std::size_t side);

struct AnswerRow {
  std::string contact;   // "rigid"
  std::string question;  // what that is, to somebody new: "with the rigid law"
  Trust trust = Trust::kNo;
  std::string trusted;       // the verdict in a word or two, or that there is none
  Tone tone = Tone::kBad;    // of it
  std::string why;           // half a sentence
  std::string plain;         // the same to somebody new, two figures at most; empty: none is off
  double us_per_step = 0.0;  // median; 0: not timed
  bool decides = false;      // the exit code
  std::string evidence;      // a sentence: what agreement says, where the two share more than the
                             // scene; else empty
};

// In the order of the sides.
std::vector<AnswerRow> answer(const SceneComparison& comparison);

// The numbers of the differences as a newcomer reads them: MuJoCo alone, corrected, by the plugin's
// laws, so that nobody takes what the plugin solves for MuJoCo as it comes.
std::vector<std::size_t> reading_order(const SceneComparison& comparison);

// Of these the ones that its sentence has: every contact model but what MuJoCo's default solref
// makes.
std::vector<std::size_t> sentence_rows(const SceneComparison& comparison);

// "MuJoCo alone: no (lasting contact 0 % instead of 99 %); with the corrected cone: averages only
// (...); with the rigid law: yes."
std::string answer_sentence(const SceneComparison& comparison);

// "Exit code: by rigid (--contact), which agrees within 1 %."
std::string whose_verdict(const SceneComparison& comparison);

// Of a machine of the user's own: what the native side is, and what it leaves out of the machine,
// sentences; else none.
std::vector<std::string> own_notes(const SceneComparison& comparison);

// Why MuJoCo's own cone is not among the contact models, a sentence; empty: it is, or has no part
// in a contact that gives.
std::string cone_note(const SceneComparison& comparison);

// The solref of MuJoCo's soft contacts, a sentence; empty where none has one.
std::string solref_note(const SceneComparison& comparison);

// How the two sides are coupled, a sentence; empty in lockstep.
std::string mode_note(const SceneComparison& comparison);

// The judged figure that a fault puts off most.
struct LargestError {
  const Figure* figure = nullptr;  // null: of none can it be determined
  double share = 0.0;              // of the native value, signed (points: as they are)
  int untold = 0;  // judged figures that the runs have, of which it cannot be determined
};

// What a contact model's figures are off by, by whose fault.
struct ThreeErrors {
  LargestError contact;  // what remains as the step goes to 0 (extrapolation.h)
  LargestError step;     // what vanishes with it, MuJoCo's less the native one's
  // Of the modes kept (model_error.h), the same on both sides; none: not asked for.
  std::optional<LargestError> modes;
};

// `side`: of the comparison's, >= 1.
ThreeErrors three_errors(const SceneComparison& comparison, std::size_t side);

}  // namespace rotorub
