// The answer to the user's question, one row per contact model. It is the same on the terminal, in
// the JSON and on the page.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// The words of the verdict on a contact model. They say that there is no verdict if there is no
// contact, because there is no force to judge, and if the native run or the controller failed,
// because the contact model is not to blame. The exit code and `Trust` do not depend on this.
const VerdictWords& verdict_words(const SceneComparison& comparison, const ComparedModel& model);

struct AnswerRow {
  std::string contact;   // "rigid"
  std::string question;  // a description for newcomers: "with the rigid law"
  VerdictWords verdict{};
  std::string why;    // half a sentence
  std::string plain;  // the same for newcomers, with at most two figures; empty if no figure is off
  double us_per_step = 0.0;  // median; 0: not timed
  bool decides = false;      // determines the exit code
  // a sentence on what agreement proves if native and MuJoCo share more than the scene; otherwise
  // empty
  std::string evidence;
};

AnswerRow answer_row(const SceneComparison& comparison, const ComparedModel& model);

// The models in the order of kContactKinds.
std::vector<const ComparedModel*> reading_order(const SceneComparison& comparison);

// The rows of the sentence that answers the question, in reading order: all except the one with
// MuJoCo's default solref. "MuJoCo alone: no (lasting contact 0 % instead of 99 %); with the
// corrected cone: averages only (...); with the rigid law: yes."
std::vector<AnswerRow> sentence_rows(const SceneComparison& comparison);

// A sentence on which contact model determines the exit code, and its result.
std::string whose_verdict(const SceneComparison& comparison);

// Advice for a comparison in which nothing touches, so that no force was judged; otherwise empty.
std::string no_contact_note(const SceneComparison& comparison);

// For a user's own machine, sentences on what the native side is and what it leaves out of the
// machine; otherwise empty.
std::vector<std::string> own_notes(const SceneComparison& comparison);

// A sentence on why MuJoCo's own cone is not among the contact models. Empty if it is, or if the
// scene's contact is compliant.
std::string cone_note(const SceneComparison& comparison);

// A sentence with the solref of MuJoCo's soft contacts; empty if none uses one.
std::string solref_note(const SceneComparison& comparison);

// A sentence on how the two sides are coupled; empty in lockstep.
std::string mode_note(const SceneComparison& comparison);

// The largest share of one source of error among the judged figures.
struct LargestError {
  const Figure* figure = nullptr;  // null: unknown for every figure
  double share = 0.0;   // relative to the native value, signed (points: the value itself)
  double native = 0.0;  // SI, that value
  int unknown = 0;      // number of judged figures of the runs for which it is unknown
  // The figures outside the tolerance for which it is unknown, those without a split included.
  std::vector<const Figure*> outside;
};
// "+0.52 % mean normal force; not known for hard impacts, which fails"
std::string error_text(const LargestError& error);

// The errors of a contact model's figures by source.
struct ThreeErrors {
  LargestError contact;  // remains as the step goes to 0 (extrapolation.h)
  LargestError step;     // vanishes with the step: MuJoCo's minus the native one
  // From the number of modes (model_error.h), equal on both sides; empty if not requested.
  std::optional<LargestError> modes;
};

ThreeErrors three_errors(const SceneComparison& comparison, const ComparedModel& model);

}  // namespace rotorub
