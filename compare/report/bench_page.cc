#include "compare/report/bench_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <string>

#include "compare/bench/output.h"
#include "compare/report/page_frame.h"
#include "compare/result/result.h"

namespace rotorub {

std::string bench_page(const bench::Machine& machine, const std::vector<bench::SceneBench>& benches,
                       const std::vector<bench::RestitutionRow>& restitution) {
  const result::Section found = bench::result_of(machine, benches, restitution);
  const nlohmann::json all = json_of(found);
  std::vector<std::string> names, texts;
  for (const bench::SceneBench& bench : benches) {
    names.push_back(bench.scene.name);
    texts.push_back(bench.scene.text);
  }
  return laid_out_page(
      {fmt::format("{}", fmt::join(names, ", ")), "speed against error",
       "Which solver is the fastest for a given error?"},
      found, "bench",
      {{"benches", all.at("scenes")}, {"machine", all.at("machine")}, {"texts", texts}},
      "Peers get the contact of a disc in a ring (its normal from the present positions) from us; "
      "the solver is theirs. Native times include the bookkeeping of energy and contact; those of "
      "MuJoCo and of the peers do not.");
}

}  // namespace rotorub
