#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "host_sim/output/page.hpp"
#include "host_sim/output/program.hpp"
#include "host_sim/process/regular_expression.hpp"
#include "tests/common/constants/pi.hpp"

namespace sonoglide::output::page_html_test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Chart chart_of(std::vector<double> x, std::vector<double> y) {
  return {"Title", "", {"Time [s]"}, {"Force [N]"}, std::move(x), {{"series", std::move(y)}}};
}

Page page_of(const Chart& chart) {
  Page page;
  page.title = "Page";
  page.sections = {{"Section", "", {chart}}};
  return page;
}

/// Everything between each pair of marks.
std::vector<std::string> between(const std::string& text, const std::string& open,
                                 const std::string& close) {
  std::vector<std::string> found;
  std::size_t at = text.find(open);
  while (at != std::string::npos) {
    const std::size_t from = at + open.size();
    const std::size_t to = text.find(close, from);
    found.push_back(text.substr(from, to - from));
    at = text.find(open, to);
  }
  return found;
}

std::vector<std::string> chart_texts(const std::string& html) {
  return between(html, "<script type=\"application/json\">", "</script>");
}

nlohmann::json only_chart(const Page& page) {
  const std::vector<std::string> charts = chart_texts(to_html(page));
  EXPECT_EQ(charts.size(), 1U);
  return nlohmann::json::parse(charts.at(0));
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

TEST(PageHtml, EscapesTextWhereverItStands) {
  const std::string nasty = "<b>\"a\" & 'b'</b></script><!--";
  const std::string safe =
      "&lt;b&gt;&quot;a&quot; &amp; &#39;b&#39;&lt;/b&gt;&lt;/script&gt;&lt;!--";
  Chart drawn = chart_of({0.0, 1.0}, {1.0, 2.0});
  drawn.title = drawn.note = drawn.x_axis.label = drawn.y_axis.label = drawn.group = nasty;
  drawn.curves[0].label = nasty;
  Page page = page_of(drawn);
  page.title = page.lead = nasty;
  page.warnings = {nasty};
  page.tables = {{nasty, {nasty}, {{nasty}}}};
  page.sections[0].title = page.sections[0].text = nasty;
  const std::string html = to_html(page);
  EXPECT_EQ(html.find(nasty), std::string::npos);
  EXPECT_EQ(count(html, safe), 11U);  // title twice, and nine texts once
  EXPECT_EQ(count(html, "<script"), 2U);
  EXPECT_EQ(count(html, "</script>"), 2U);
  const nlohmann::json chart = nlohmann::json::parse(chart_texts(html).at(0));
  EXPECT_EQ(chart.at("x").at("label"), nasty);
  EXPECT_EQ(chart.at("group"), nasty);
  EXPECT_EQ(chart.at("series").at(0).at("label"), nasty);
}

TEST(PageHtml, BrokenUtf8DoesNotBreakTheData) {
  Chart drawn = chart_of({0.0, 1.0}, {1.0, 2.0});
  drawn.curves[0].label = "caf\xe9";
  EXPECT_EQ(only_chart(page_of(drawn)).at("series").at(0).at("label"), "caf\uFFFD");
}

TEST(PageHtml, WritesNanAndInfinityAsNull) {
  const nlohmann::json chart =
      only_chart(page_of(chart_of({0.0, 1.0, 2.0, 3.0}, {1.5, kNaN, kInfinity, -kInfinity})));
  EXPECT_EQ(chart.at("series").at(0).at("y"), nlohmann::json::parse("[1.5,null,null,null]"));
}

TEST(PageHtml, KeepsSevenDigitsOfOrdinates) {
  using tests::pi;
  const std::vector<double> y = {pi, -pi * 1e-7, pi * 1e300, 5e-324};
  const nlohmann::json written =
      only_chart(page_of(chart_of({0.0, 1.0, 2.0, 3.0}, y))).at("series").at(0).at("y");
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(written.at(i).get<double>() / y[i], 1.0, 5e-7);
  }
  EXPECT_EQ(written.at(3).get<double>(), 5e-324);
}

TEST(PageHtml, ResolvesAShortWindowFarFromZero) {
  std::vector<double> x(1000);
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = 200.0 + 1e-9 * static_cast<double>(i);
  }
  const nlohmann::json written =
      only_chart(page_of(chart_of(x, std::vector<double>(x.size(), 1.0)))).at("abscissae");
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(written.at(i).get<double>(), x[i], 1e-7 * 1e-6);
  }
}

TEST(PageHtml, PassesOnHowToDraw) {
  Chart drawn = chart_of({1.0, 10.0}, {1.0, 2.0});
  drawn.x_axis.logarithmic = true;
  drawn.curves[0].line = Line::stepped;
  drawn.curves.push_back({"loop", {kNaN, 1.0}, Line::bridged});
  drawn.y_axis.logarithmic = true;
  drawn.group = "zoom";
  const nlohmann::json chart = only_chart(page_of(drawn));
  EXPECT_EQ(chart.at("x").at("logarithmic"), true);
  EXPECT_EQ(chart.at("y").at("logarithmic"), true);
  EXPECT_EQ(chart.at("group"), "zoom");
  EXPECT_EQ(chart.at("series").at(0).at("line"), "stepped");
  EXPECT_EQ(chart.at("series").at(0).at("pen"), nullptr);
  EXPECT_EQ(chart.at("series").at(1).at("line"), "bridged");
}

TEST(PageHtml, EmptyPanelSaysSoInsteadOfAChart) {
  Chart negative = chart_of({0.0, 1.0}, {-1.0, 0.0});
  negative.y_axis.logarithmic = true;
  Chart without_series = chart_of({0.0}, {0.0});
  without_series.curves.clear();
  for (const Chart& empty :
       {chart_of({}, {}), chart_of({0.0, 1.0}, {kNaN, kInfinity}), without_series, negative}) {
    const std::string html = to_html(page_of(empty));
    EXPECT_TRUE(chart_texts(html).empty());
    EXPECT_NE(html.find("No values to draw."), std::string::npos);
  }
}

TEST(PageHtml, PassesOnEveryKindOfPart) {
  Chart drawn = chart_of({}, {});
  drawn.x_axis.ticks = {{1.0, "one"}};
  drawn.y_axis.span = {0.0, kNaN};
  drawn.y_axis.has_zero = drawn.y_axis.whole_numbers = drawn.equal_scales = true;
  drawn.curves = {
      {"measured", {1.0, 2.0}, Line::dots, {2.0, 1.0}, {"#d62728", 1.5, 2, 7}, {0.1, kNaN}},
      {"bars", {3.0}, Line::bar, {0.0}}};
  drawn.tiles = {{{{{0.0, 1.0}, {kNaN, 2.0}, kNaN}}, "#f6dcdc", "too much", true}};
  drawn.marks = {{"here", 1.5, 2.5}};
  const nlohmann::json chart = only_chart(page_of(drawn));
  EXPECT_EQ(chart.at("x").at("ticks"), nlohmann::json::parse(R"([{"at":1.0,"text":"one"}])"));
  EXPECT_EQ(chart.at("y").at("ends"), nlohmann::json::parse("[0,null]"));
  EXPECT_TRUE(chart.at("y").at("hasZero") && chart.at("y").at("whole") && chart.at("equalScales"));
  EXPECT_EQ(chart.at("series").at(0), nlohmann::json::parse(R"({
    "label": "measured", "verbatim": false, "line": "dots", "y": [1, 2], "x": [2, 1],
    "halfWidth": [0.1, null],
    "pen": {"colour": "#d62728", "width": 1.5, "dash": 2, "symbol": 7, "size": 1, "every": 1}})"));
  EXPECT_EQ(chart.at("series").at(1).at("line"), "bar");
  EXPECT_EQ(chart.at("tiles"), nlohmann::json::parse(R"([{
    "label": "too much", "colour": "#f6dcdc", "behind": true, "all": [[0, 1, null, 2, null]]}])"));
  EXPECT_EQ(chart.at("marks"), nlohmann::json::parse(R"([{"text": "here", "x": 1.5, "y": 2.5}])"));
}

TEST(PageHtml, TilesAreSomethingToDrawUnlessTheyAreTheGround) {
  Chart drawn = chart_of({}, {});
  drawn.tiles = {{{{{0.0, 1.0}, {0.0, 1.0}, 1.0}}}};
  EXPECT_EQ(chart_texts(to_html(page_of(drawn))).size(), 1U);
  drawn.tiles.front().behind = true;
  EXPECT_EQ(chart_texts(to_html(page_of(drawn))).size(), 0U);
}

TEST(PageHtml, RefusesInconsistentData) {
  EXPECT_THROW(to_html(page_of(chart_of({0.0, 1.0}, {1.0}))), std::invalid_argument);
  EXPECT_THROW(to_html(page_of(chart_of({1.0, 0.0}, {1.0, 1.0}))), std::invalid_argument);
  EXPECT_THROW(to_html(page_of(chart_of({0.0, kNaN}, {1.0, 1.0}))), std::invalid_argument);
  Page page;
  page.tables = {{"", {"one", "two"}, {{"1"}}}};
  EXPECT_THROW(to_html(page), std::invalid_argument);
}

TEST(PageHtml, LoadsNothingFromOutside) {
  const std::string html = to_html(page_of(chart_of({0.0, 1.0}, {1.0, 2.0})));
  EXPECT_NE(html.find("<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
                      "script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:;"),
            std::string::npos);
  const process::RegularExpression link("(src|href|action)\\s*=\\s*[\"']?(https?:)?//");
  EXPECT_TRUE(link.search(html).empty());
  const process::RegularExpression url("url\\(\\s*[\"']?(?!data:)[a-z/]");
  EXPECT_TRUE(url.search(html).empty());
  for (const char* loader : {"@import", "sourceMappingURL", "<iframe", "<object", "<script src"}) {
    EXPECT_EQ(html.find(loader), std::string::npos) << loader;
  }
}

TEST(PageHtml, FoldsALongTable) {
  Page page;
  page.tables = {{"Short", {}, {{"1"}}}, {"Long", {}, {}}};
  EXPECT_EQ(count(to_html(page), "<details>"), 0U);
  page.tables[1].rows.assign(30, {"1"});
  const std::string html = to_html(page);
  EXPECT_EQ(count(html, "<details>"), 1U);
  EXPECT_EQ(count(html, "<summary><h2>Long</h2> 30 rows</summary>"), 1U);
}

TEST(PageHtml, SetsColumnsOfNumbersFlushRight) {
  Page page;
  page.tables = {{"",
                  {"name", "settling", "share"},
                  {{"first", "83.3 µs", "1.5%"}, {"2nd", "−1.2e-3", ""}, {"third", "never", "2"}}},
                 {"", {}, {{"1"}, {"a sentence that has to be broken"}}}};
  const std::string html = to_html(page);
  EXPECT_NE(html.find("<tr><th>name</th><th class=\"number\">settling</th>"
                      "<th class=\"number\">share</th></tr>"),
            std::string::npos);
  EXPECT_NE(html.find("<tr><td>third</td><td class=\"number\">never</td>"
                      "<td class=\"number\">2</td></tr>"),
            std::string::npos);
  EXPECT_NE(html.find("<tr><td>1</td></tr>"), std::string::npos);
}

TEST(PageHtml, PutsWarningsBeforeEverythingButTheTitle) {
  Page page = page_of(chart_of({0.0, 1.0}, {1.0, 2.0}));
  page.tables = {{"Table", {"a"}, {{"1"}}}};
  EXPECT_EQ(to_html(page).find("<aside"), std::string::npos);
  page.warnings = {"Mind the gap"};
  const std::string html = to_html(page);
  EXPECT_LT(html.find("</h1>"), html.find("Mind the gap"));
  EXPECT_LT(html.find("Mind the gap"), html.find("<table>"));
}

TEST(PageHtml, NotesAreABoxOfTheirOwnBelowTheWarnings) {
  Page page;
  page.warnings = {"Mind the gap"};
  page.notes = {"One", "Two"};
  const std::string html = to_html(page);
  const std::size_t warnings = html.find("<aside class=\"warnings\">\n<h2>Warning</h2>");
  const std::size_t notes =
      html.find("<aside class=\"notes\">\n<h2>Notes</h2>\n<ul>\n<li>One</li>");
  ASSERT_NE(notes, std::string::npos);
  EXPECT_LT(warnings, notes);
  EXPECT_EQ(count(to_html(Page()), "<aside"), 0U);
}

TEST(PageHtml, MarksTheValuesOfTheSceneThatWereChanged) {
  program().command_line = "sonoglide run a.toml --set 'plant.mass_kg=3'";
  program().changed = {{"plant.mass_kg", {{"file", 2}, {"value", 3}}}};
  Page page;
  page.scene = {{"plant", {{"mass_kg", 3}, {"name", "<b>"}}}};
  page.seed = 7;
  const std::string html = to_html(page);
  program() = {};
  for (const char* part :
       {"<dd><code><span>sonoglide</span> <span>run</span> <span>a.toml</span> <span>--set</span> "
        "<span>&#39;plant.mass_kg=3&#39;</span></code></dd>",
        "<dt>Version</dt><dd>sonoglide ", "<dt>Seed</dt><dd>7</dd>", "The scene, 2 values",
        "<tr class=\"changed\"><td>plant.mass_kg</td><td>3</td><td>changed; in the file: 2</td>",
        "<tr><td>plant.name</td><td>&quot;&lt;b&gt;&quot;</td><td></td>"}) {
    EXPECT_EQ(count(html, part), 1U) << part;
  }
  EXPECT_EQ(count(to_html(Page()), "<dt>Command</dt>"), 0U);
}

}  // namespace
}  // namespace sonoglide::output::page_html_test
