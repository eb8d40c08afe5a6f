#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string_view>

#include "host_sim/output/chart.hpp"
#include "host_sim/output/html.hpp"
#include "host_sim/output/page.hpp"
#include "host_sim/output/program.hpp"

namespace sonoglide::output {
namespace {

using nlohmann::ordered_json;

std::string text_of(const ordered_json& value) {
  return value.is_null() ? std::string("-")
                         : value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

void append_fact(std::string& html, std::string_view name, const std::string& value) {
  html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, value);
}

void append_changes(std::string& html, const ordered_json& changed) {
  Table table{"Changed by --set", {"Key", "In the file", "In this run"}, {}};
  for (const auto& [key, values] : changed.items()) {
    table.rows.push_back({key, text_of(values.at("file")), text_of(values.at("value"))});
  }
  append_table(html, table);
}

/// A line breaks between words, not at the dashes of an option.
std::string unbroken_words(const std::string& text) {
  std::string html;
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
    end = text.find(' ', begin);
    html += fmt::format("{}<span>{}</span>", html.empty() ? "" : " ",
                        escaped(text.substr(begin, end == std::string::npos ? end : end - begin)));
  }
  return html;
}

/// A row for each key; those that were changed are marked by a word and a colour.
void append_scene(std::string& html, const ordered_json& scene, const ordered_json& changed) {
  std::string rows;
  std::size_t count = 0;
  for (const auto& [table, keys] : scene.items()) {
    for (const auto& [name, value] : keys.items()) {
      const std::string key = fmt::format("{}.{}", table, name);
      const auto found = changed.find(key);
      const bool is_changed = found != changed.end();
      rows += fmt::format(
          "<tr{}><td>{}</td><td>{}</td><td>{}</td></tr>\n", is_changed ? " class=\"changed\"" : "",
          escaped(key), escaped(text_of(value)),
          is_changed ? "changed; in the file: " + escaped(text_of(found->at("file"))) : "");
      ++count;
    }
  }
  html += fmt::format(
      "<details><summary>The scene, {} values with the defaults</summary>\n"
      "<div class=\"scroll\"><table>\n<tbody>\n{}</tbody></table></div>\n</details>\n",
      count, rows);
}

}  // namespace

void append_what_was_run(std::string& html, const Page& page) {
  const ordered_json asked = program_json();
  html += "<div class=\"run\">\n<dl>\n";
  if (asked.at("command_line").is_string()) {
    append_fact(html, "Command",
                fmt::format("<code>{}</code>", unbroken_words(program().command_line)));
  }
  append_fact(html, "Version", fmt::format("sonoglide {}", asked.at("version").get<std::string>()));
  if (page.seed) {
    append_fact(html, "Seed", fmt::format("{}", *page.seed));
  }
  html += "</dl>\n";
  if (!program().changed.empty()) {
    append_changes(html, program().changed);
  }
  if (!page.scene.empty()) {
    append_scene(html, page.scene, program().changed);
  }
  html += "</div>\n";
}

namespace {

constexpr std::string_view kContentSecurityPolicy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:; "
    "base-uri 'none'; form-action 'none'";

void check(const Chart& chart) {
  const auto finite = [](const std::vector<double>& x) {
    return std::all_of(x.begin(), x.end(), [](double each) { return std::isfinite(each); });
  };
  const bool ordered = std::is_sorted(chart.x.begin(), chart.x.end());
  if (!ordered || !finite(chart.x)) {
    throw std::invalid_argument("chart '" + chart.title + "': x decreases or is not finite");
  }
  for (const Curve& curve : chart.curves) {
    const std::vector<double>& x = curve.x.empty() ? chart.x : curve.x;
    if (curve.y.size() != x.size() || !finite(x)) {
      throw std::invalid_argument(fmt::format("chart '{}', curve '{}': {} values for {} abscissae",
                                              chart.title, curve.label, curve.y.size(), x.size()));
    }
  }
}

/// @param heading  of one sentence; of more with an s
void append_box(std::string& html, const std::string& kind, const std::string& heading,
                const std::vector<std::string>& sentences) {
  if (sentences.empty()) {
    return;
  }
  html += fmt::format("<aside class=\"{}\">\n<h2>{}{}</h2>\n<ul>\n", kind, heading,
                      sentences.size() == 1 ? "" : "s");
  for (const std::string& sentence : sentences) {
    html += fmt::format("<li>{}</li>\n", escaped(sentence));
  }
  html += "</ul>\n</aside>\n";
}

void append_chart(std::string& html, const Chart& chart) {
  html += fmt::format("<figure class=\"panel\">\n<figcaption><h3>{}</h3>\n", escaped(chart.title));
  append_paragraph(html, "note", chart.note);
  html += "</figcaption>\n";
  if (has_something_to_draw(chart)) {
    html += fmt::format("<script type=\"application/json\">{}</script>\n", chart_json(chart));
  } else {
    html += "<p class=\"empty\">No values to draw.</p>\n";
  }
  html += "</figure>\n";
}

void append_sections(std::string& html, const std::vector<Section>& sections) {
  for (const Section& section : sections) {
    html += fmt::format("<section class=\"charts\">\n<h2>{}</h2>\n", escaped(section.title));
    append_paragraph(html, "text", section.text);
    for (const Chart& chart : section.charts) {
      append_chart(html, chart);
    }
    for (const Table& table : section.tables) {
      append_table(html, table);
    }
    html += "</section>\n";
  }
}

void append_hint(std::string& html) {
  html +=
      "<p class=\"hint\" id=\"chart-keys\">Mouse: drag across a chart to zoom, shift-drag to pan, "
      "double-click to reset, hover to read values. Touch: two fingers zoom, a tap reads, one finger "
      "scrolls the page. Keyboard: Tab to a chart, then \u2190 \u2192 read values, on a map \u2191 \u2193 too, + \u2212 zoom, "
      "Shift with an arrow pans, 0 or Escape resets.</p>\n"
      "<noscript><p class=\"empty\">The charts need JavaScript.</p></noscript>\n";
}

void append_head(std::string& html, const Page& page) {
  html += fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n<title>{}</title>\n",
      kContentSecurityPolicy, escaped(page.title));
  html += fmt::format("<style>\n{}</style>\n</head>\n", page_css());
}

void append_scripts(std::string& html) {
  html += "<script>\n";
  for (const std::string_view script :
       {numbers_js(), look_js(), chart_js(), reading_js(), panel_js(), wide_js(), page_js()}) {
    html += script;
  }
  html += "</script>\n";
}

bool has_charts(const Page& page) {
  return std::any_of(page.sections.begin(), page.sections.end(),
                     [](const Section& section) { return !section.charts.empty(); });
}

}  // namespace

std::string to_html(const Page& page) {
  for (const Table& table : page.tables) {
    check(table);
  }
  for (const Section& section : page.sections) {
    for (const Chart& chart : section.charts) {
      check(chart);
    }
  }
  std::string html;
  append_head(html, page);
  html += fmt::format("<body>\n<main>\n<header>\n<h1>{}</h1>\n", escaped(page.title));
  append_paragraph(html, "lead", page.lead);
  append_what_was_run(html, page);
  html += "</header>\n";
  append_box(html, "warnings", "Warning", page.warnings);
  append_box(html, "notes", "Note", page.notes);
  for (const Table& table : page.tables) {
    append_table(html, table);
  }
  if (has_charts(page)) {
    append_hint(html);
  }
  append_sections(html, page.sections);
  if (const Table words = words_of(page); !words.rows.empty()) {
    append_table(html, words);
  }
  html += "</main>\n";
  append_scripts(html);
  html += "</body>\n</html>\n";
  return html;
}

}  // namespace sonoglide::output
