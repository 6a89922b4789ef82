#include "compare/report/beside.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "compare/base/plot_points.h"
#include "compare/check/output.h"
#include "compare/sweep/folder.h"
#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

using nlohmann::json;
using std::filesystem::path;

// A missing member, or one of another type, is an error of the file.
void add_bench(const json& all, Beside& beside) {
  const json& machine = all.at("machine");
  const std::string where = fmt::format("{}, {}", machine.at("processor").get<std::string>(),
                                        machine.at("instructions").get<std::string>());
  for (const json& scene : all.at("scenes")) {
    scene.at("scene").get_ref<const std::string&>();
    scene.at("reference").at("source").get_ref<const std::string&>();
    for (const char* list : {"series", "points", "engines"})
      scene.at(list).get_ref<const json::array_t&>();
    beside.benches.push_back(scene);
    beside.benches.back()["machine"] = where;
  }
}

void add_cases(const json& all, Beside& beside) {
  const json parts = page_json(check::result_of(check::cases_of(all)));
  beside.cases.insert(beside.cases.end(), parts.begin(), parts.end());
}

// The lists must have equal lengths, because the script indexes them together.
void check_columns(const json& plots) {
  const std::size_t points = plots.at("status").size();
  const bool is_grid = plots.at("kind").get_ref<const std::string&>() == "grid";
  std::size_t cells = 1;
  for (const json& key : plots.at("keys")) cells *= is_grid ? key.at("values").size() : 1;
  if (is_grid && cells != points)
    throw std::out_of_range(fmt::format("a grid of {} cells has {} points", cells, points));
  for (const char* lists : {"values", "columns", "linear"}) {
    for (const json& list : plots.value(lists, json::array())) {
      if (list.size() != points)
        throw std::out_of_range(fmt::format("a list of {} has not {} values", lists, points));
    }
  }
  if ((!is_grid && plots.at("keys").size() != plots.at("values").size()) ||
      plots.at("keys").empty() || plots.at("figures").size() != plots.at("columns").size() ||
      plots.at("figures").empty()) {
    throw std::out_of_range("keys and figures have not a list each");
  }
  plots.at("statuses").get_ref<const json::array_t&>();
}

void add_map(const json& all, Beside& beside) {
  check_columns(all.at("plots"));
  all.at("name").get_ref<const std::string&>();
  all.at("answer").get_ref<const json::array_t&>();
  beside.sweeps.push_back(all);
}

struct Kind {
  const char* file;
  const char* command;
  void (*add)(const json&, Beside&);
};
constexpr Kind kResults[] = {{kBenchFile, "bench", add_bench},
                             {kCheckFile, "check", add_cases},
                             {sweep::kDataFile, "sweep", add_map}};

bool add_folder(const path& folder, Beside& beside) {
  bool any = false;
  for (const Kind& kind : kResults) {
    const path file = folder / kind.file;
    if (!std::filesystem::is_regular_file(file)) continue;
    any = true;
    try {
      kind.add(json::parse(scene::file_text(file.string())), beside);
    } catch (const std::exception& error) {
      throw std::runtime_error(fmt::format("{}: {}; expected what `rotorub {} -o DIR` writes",
                                           file.string(), error.what(), kind.command));
    }
  }
  return any;
}

}  // namespace

Beside read_beside(const std::vector<std::string>& folders) {
  Beside beside;
  for (const std::string& name : folders) {
    std::vector<path> places{name};
    if (std::filesystem::is_directory(name)) {
      for (const auto& entry : std::filesystem::directory_iterator(name)) {
        if (entry.is_directory()) places.push_back(entry.path());
      }
    }
    std::sort(places.begin() + 1, places.end());
    bool any = false;
    for (const path& place : places) any = add_folder(place, beside) || any;
    if (!any) {
      throw std::runtime_error(
          fmt::format("{}: no {}, {} or {} here or one folder below; give folders that bench, "
                      "check or sweep wrote with -o",
                      name, kBenchFile, kCheckFile, sweep::kDataFile));
    }
  }
  return beside;
}

}  // namespace rotorub
