#include "compare/report/page_frame.h"

#include <boost/algorithm/string/replace.hpp>
#include <deque>
#include <kainjow/mustache.hpp>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "compare/base/version.h"
#include "compare/report/assets.h"
#include "compare/report/plot_points.h"
#include "compare/result/result.h"

namespace rotorub {
namespace {

namespace mustache = kainjow::mustache;
using nlohmann::json;

bool shows(const json& value) {
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_string()) return !value.get_ref<const std::string&>().empty();
  return !value.empty();  // null, [] and {} are empty
}

// Looks up the names that the library requests in the values. Without this the library would ignore
// unknown names.
class StrictContext : public mustache::basic_context<std::string> {
 public:
  StrictContext(const json& values, const Partials& partials)
      : partials_(partials), levels_{&values} {}

  void push(const mustache::data*) override { levels_.push_back(asked_); }
  void pop() override { levels_.pop_back(); }

  const mustache::data* get(const std::string& name) const override {
    asked_ = &look_up(name);
    return &given_.emplace_back(data_of(*asked_));
  }

  const mustache::data* get_partial(const std::string& name) const override {
    const auto found = partials_.find(name);
    if (found == partials_.end()) throw std::logic_error("template: no partial {{" + name + "}}");
    return &given_.emplace_back(std::string(found->second));
  }

 private:
  const json& look_up(const std::string& name) const {
    if (name == ".") return *levels_.back();
    const json::json_pointer path("/" + boost::replace_all_copy(name, ".", "/"));
    for (auto level = levels_.rbegin(); level != levels_.rend(); ++level) {
      if ((*level)->contains(path)) return (*level)->at(path);
    }
    throw std::logic_error("template: no value for {{" + name + "}}");
  }

  // A list, an object or `true` becomes the function that fills a section; the library refuses it
  // in the place of text.
  mustache::data data_of(const json& value) const {
    if (value.is_number()) return value.dump();
    if (!shows(value)) return false;
    if (value.is_string()) return value.get_ref<const std::string&>();
    return mustache::lambda2(
        [this, &value](const std::string& text, const mustache::renderer& render) {
          std::string out;
          const auto fill = [&](const json& element) {
            levels_.push_back(&element);
            out += render(text, false);
            levels_.pop_back();
          };
          if (value.is_array()) {
            for (const json& element : value) fill(element);
          } else {
            fill(value);
          }
          return out;
        });
  }

  const Partials& partials_;
  mutable std::vector<const json*> levels_;  // innermost last
  mutable const json* asked_ = nullptr;      // the last value that was requested
  mutable std::deque<mustache::data> given_;
};

}  // namespace

std::string fill_template(std::string_view text, const json& values, const Partials& partials) {
  mustache::mustache page{std::string(text)};
  page.set_custom_escape([](const std::string& plain) {
    // HTML 4 does not define &apos;.
    return boost::replace_all_copy(mustache::html_escape(plain), "&apos;", "&#39;");
  });
  StrictContext context(values, partials);
  std::ostringstream out;
  if (page.is_valid()) page.render(context, out);
  if (!page.is_valid()) throw std::logic_error("template: " + page.error_message());
  return out.str();
}

json page_frame(const PageHead& head, const json& data, Pictures pictures) {
  const bool live = pictures == Pictures::kPlotsAndRig;
  std::string css(report_css());
  if (live) css += player_css();
  // The two sides of the player.
  const json places = {{{"place", 0}, {"which", "first"}}, {{"place", 1}, {"which", "second"}}};
  return {{"places", places},
          {"names", head.names},
          {"topic", head.topic},
          {"heading", head.heading},
          {"version", program_version()},
          {"css", std::move(css)},
          // Overridden for pages with the native module (page.cc).
          {"has_module", false},
          // The page's script unpacks and starts it after the page is drawn.
          {"plotly", base64(packed_plotly_js())},
          // "<" could end the script element with the data.
          {"data", boost::replace_all_copy(data.dump(), "<", "\\u003c")},
          {"scripts", live ? report_js() : still_js()}};
}

json card(std::string_view title, std::string_view tone, std::string_view headline,
          std::string_view text) {
  return {{"title", title}, {"tone", tone}, {"headline", headline}, {"text", text}};
}

std::string fill_page(std::string_view html, const json& values) {
  return fill_template(html, values,
                       {{"head", head_html()},
                        {"foot", foot_html()},
                        {"plots", plots_html()},
                        {"player", player_html()},
                        {"what_if", what_if_html()},
                        {"transport", transport_html()},
                        {"glossary", glossary_html()}});
}

std::string laid_out_page(const PageHead& head, const result::Section& found, const json& parts,
                          json data, const std::string& footer) {
  data["page"] = parts;
  json values = page_frame(head, data);
  values["text"] = text_of(found);
  values["footer"] = footer;
  return fill_page(page_html(), values);
}

}  // namespace rotorub
