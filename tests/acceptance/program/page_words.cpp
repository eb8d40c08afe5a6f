#include "tests/acceptance/program/page_words.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <set>

#include "host_sim/process/regular_expression.hpp"

namespace sonoglide::acceptance {
namespace {

using Texts = std::vector<std::string>;

/// Everything between two marks.
Texts between(const std::string& text, const std::string& open, const std::string& close) {
  Texts found;
  for (std::size_t at = 0; (at = text.find(open, at)) != std::string::npos;) {
    at += open.size();
    const std::size_t end = text.find(close, at);
    found.push_back(text.substr(at, end - at));
  }
  return found;
}

Texts labels_of(const nlohmann::json& chart) {
  Texts labels = {chart.at("title"), chart.at("x").at("label"), chart.at("y").at("label")};
  for (const auto& part :
       {chart.at("x").at("ticks"), chart.at("y").at("ticks"), chart.at("marks")}) {
    for (const nlohmann::json& each : part) {
      labels.push_back(each.at("text"));
    }
  }
  for (const auto& part : {chart.at("series"), chart.at("tiles")}) {
    for (const nlohmann::json& each : part) {
      labels.push_back(each.at("label"));
    }
  }
  return labels;
}

Texts labels_of(const std::string& html) {
  Texts labels = between(html, "<th>", "</th>");
  for (const std::string& heading : between(html, "<th class=\"number\">", "</th>")) {
    labels.push_back(heading);
  }
  for (const std::string& chart :
       between(html, "<script type=\"application/json\">", "</script>")) {
    const Texts of_chart = labels_of(nlohmann::json::parse(chart));
    labels.insert(labels.end(), of_chart.begin(), of_chart.end());
  }
  return labels;
}

std::set<std::string> explained_by(const std::string& html) {
  static const process::RegularExpression apostrophe("&#39;");
  std::set<std::string> names;
  const std::size_t table = html.find("<h2>Words and symbols</h2>");
  for (const std::string& row :
       between(html.substr(std::min(table, html.size())), "<tr><td>", "</td>")) {
    for (std::size_t from = 0; from < row.size();) {
      const std::size_t end = std::min(row.find(", ", from), row.size());
      names.insert(apostrophe.replace(row.substr(from, end - from), "'"));
      from = end + 2;
    }
  }
  return names;
}

/// Runs of letters, digits and primes; of other alphabets than ours Greek letters alone.
Texts words_in(const std::string& label) {
  static const process::RegularExpression word(
      "P\\([a-z²]*\\)|(?:[A-Za-z0-9_']|[\xce\xcf][\x80-\xbf])+");
  Texts words;
  for (const process::Match& each : word.search_all(label)) {
    words.push_back(each[0]);
  }
  return words;
}

bool is_symbol(const std::string& word) {
  static const process::RegularExpression form(
      "P\\(.*|[A-Za-z]'?|[A-Z][a-z0-9]|[\xce\xcf][\x80-\xbf][a-z0-9]?");
  static const std::set<std::string> short_words = {"A",  "a",  "An", "As", "At", "By", "In", "It",
                                                    "Of", "On", "Or", "To", "M0", "M3", "M7", "s"};
  return !form.match(word).empty() && short_words.count(word) == 0;
}

}  // namespace

std::vector<std::string> unexplained_symbols(const std::string& html) {
  static const process::RegularExpression no_words(R"(\[[^\]]*\]|[0-9] ?[A-Za-z/]+|\([a-d]\))");
  const std::set<std::string> explained = explained_by(html);
  std::set<std::string> missing;
  for (const std::string& label : labels_of(html)) {
    for (const std::string& word : words_in(no_words.replace(label, " "))) {
      if (is_symbol(word) && explained.count(word) == 0) {
        missing.insert(word);
      }
    }
  }
  return {missing.begin(), missing.end()};
}

}  // namespace sonoglide::acceptance
