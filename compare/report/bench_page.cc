#include "compare/report/bench_page.h"

namespace rotorub {

std::string bench_page(const bench::Machine&, const std::vector<bench::SceneBench>&) { return ""; }

}  // namespace rotorub
