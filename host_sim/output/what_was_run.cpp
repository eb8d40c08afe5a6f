#include <fmt/format.h>

#include <cstddef>

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

}  // namespace sonoglide::output
