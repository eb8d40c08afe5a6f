#include "host_sim/output/html.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>

#include "host_sim/process/printable.hpp"

namespace sonoglide::output {

/// Fit for elements and for attributes in either kind of quotes.
std::string escaped(std::string_view text) {
  std::string html;
  html.reserve(text.size());
  for (const char c : process::printable_lines(text)) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

void append_paragraph(std::string& html, std::string_view css_class, const std::string& text) {
  if (!text.empty()) {
    html += fmt::format("<p class=\"{}\">{}</p>\n", css_class, escaped(text));
  }
}

void check(const Table& table) {
  for (const std::vector<std::string>& row : table.rows) {
    if (!table.header.empty() && row.size() != table.header.size()) {
      throw std::invalid_argument(fmt::format("table '{}': a row of {} cells under {} headings",
                                              table.title, row.size(), table.header.size()));
    }
  }
}

namespace {

/// A number, alone or followed by one word, its unit.
bool is_number(const std::string& cell) {
  // A typographic minus is not one that strtod reads.
  constexpr std::string_view kMinus = "\u2212";
  const bool negative = cell.compare(0, kMinus.size(), kMinus) == 0;
  const std::string text = negative ? "-" + cell.substr(kMinus.size()) : cell;
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  const std::string_view rest = end;
  return rest.size() < text.size() && (rest.empty() || rest.front() == '%' || rest.rfind(' ') == 0);
}

bool is_numeric_column(const Table& table, std::size_t column) {
  constexpr std::size_t longest_word = 24;
  std::size_t numbers = 0;
  std::size_t texts = 0;
  for (const std::vector<std::string>& row : table.rows) {
    if (column < row.size() && !row[column].empty()) {
      if (is_number(row[column])) {
        ++numbers;
      } else if (row[column].size() > longest_word) {
        return false;
      } else {
        ++texts;
      }
    }
  }
  return numbers > 0 && numbers >= texts;
}

void append_row(std::string& html, const Table& table, const std::vector<std::string>& cells,
                std::string_view tag) {
  html += "<tr>";
  for (std::size_t column = 0; column < cells.size(); ++column) {
    html += fmt::format("<{}{}>{}</{}>", tag,
                        is_numeric_column(table, column) ? " class=\"number\"" : "",
                        escaped(cells[column]), tag);
  }
  html += "</tr>\n";
}

}  // namespace

void append_table(std::string& html, const Table& table) {
  constexpr std::size_t most_rows_unfolded = 16;
  const bool is_long = table.folded || table.rows.size() > most_rows_unfolded;
  const std::string title =
      table.title.empty() ? std::string() : fmt::format("<h2>{}</h2>", escaped(table.title));
  html += "<section class=\"table\">\n";
  html += is_long
              ? fmt::format("<details><summary>{} {} rows</summary>\n", title, table.rows.size())
              : title + '\n';
  html += "<div class=\"scroll\"><table>\n";
  if (!table.header.empty()) {
    html += "<thead>";
    append_row(html, table, table.header, "th");
    html += "</thead>\n";
  }
  html += "<tbody>\n";
  for (const std::vector<std::string>& row : table.rows) {
    append_row(html, table, row, "td");
  }
  html += fmt::format("</tbody></table></div>\n{}</section>\n", is_long ? "</details>\n" : "");
}

}  // namespace sonoglide::output
