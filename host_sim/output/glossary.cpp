#include "host_sim/output/html.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "host_sim/process/regular_expression.hpp"

namespace sonoglide::output {
namespace {

struct Entry {
  std::vector<std::string> names;  ///< any of them is looked for
  std::string meaning;
  bool is_symbol;
};

std::string joined(const std::vector<std::string>& parts, const char* separator) {
  return std::accumulate(parts.begin(), parts.end(), std::string(),
                         [&](const std::string& all, const std::string& part) {
                           return all.empty() ? part : all + separator + part;
                         });
}

std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (std::size_t at = 0; (at = text.find(separator, from)) != std::string::npos;
       from = at + separator.size()) {
    parts.push_back(text.substr(from, at - from));
  }
  parts.push_back(text.substr(from));
  return parts;
}

/// Markdown without emphasis, code marks and links.
std::string plain(const std::string& markdown) {
  static const process::RegularExpression link(R"(\[([^\]]*)\]\([^)]*\))");
  static const process::RegularExpression marks("[*`]");
  static const process::RegularExpression line_end("\\s*\n\\s*");
  return line_end.replace(marks.replace(link.replace(markdown, "$1"), ""), " ");
}

std::string sentence(std::string text) {
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text.back() == '.' ? text : text + '.';
}

/// A row "| `Vt` | sliding velocity |", or a paragraph "**Term, other name** and so on: meaning".
std::vector<Entry> entries_of(std::string_view document) {
  std::vector<Entry> entries;
  static const process::RegularExpression row(R"(\| (`[^|]*`) \| ([^|]*) \|)");
  static const process::RegularExpression term(R"(\*\*([^*]*)\*\*([^:]*): ([^]*))");
  for (const std::string& paragraph : split(std::string(document), "\n\n")) {
    if (const process::Match found = term.match(paragraph); !found.empty()) {
      entries.push_back({split(found[1], ", "), sentence(plain(found[3])), false});
      continue;
    }
    for (const std::string& line : split(paragraph, "\n")) {
      if (const process::Match found = row.match(line); !found.empty()) {
        entries.push_back({split(plain(found[1]), ", "), sentence(plain(found[2])), true});
      }
    }
  }
  return entries;
}

/// Limits and faults, which are the tables of two columns there. One that is also a word of every
/// day, such as `current`, is left out: a page has it in other meanings.
std::vector<Entry> limits_and_faults() {
  std::vector<Entry> entries = entries_of(control_md());
  entries.erase(std::remove_if(entries.begin(), entries.end(),
                               [](const Entry& entry) {
                                 const std::string& name = entry.names.front();
                                 return name.find('_') == std::string::npos && name != "mismatch";
                               }),
                entries.end());
  return entries;
}

std::vector<Entry> read_glossary() {
  std::vector<Entry> entries = entries_of(glossary_md());
  for (Entry& entry : limits_and_faults()) {
    entries.push_back(std::move(entry));
  }
  return entries;
}

const std::vector<Entry>& glossary() {
  static const std::vector<Entry> entries = read_glossary();
  return entries;
}

/// What a reader sees of it, one text a line.
std::string text_of(const Table& table) {
  std::string text = table.title + '\n' + joined(table.header, "\n") + '\n';
  for (const std::vector<std::string>& row : table.rows) {
    text += joined(row, "\n") + '\n';
  }
  return text;
}

std::string text_of(const Chart& chart) {
  std::string text =
      joined({chart.title, chart.note, chart.x_axis.label, chart.y_axis.label}, "\n");
  for (const Axis* axis : {&chart.x_axis, &chart.y_axis}) {
    for (const Tick& tick : axis->ticks) {
      text += '\n' + tick.name;
    }
  }
  for (const Curve& curve : chart.curves) {
    text += '\n' + curve.label;
  }
  for (const Tiles& tiles : chart.tiles) {
    text += '\n' + tiles.label;
  }
  for (const Mark& mark : chart.marks) {
    text += '\n' + mark.text;
  }
  return text + '\n';
}

std::string text_of(const Page& page) {
  std::string text = page.title + '\n' + page.lead + '\n' + joined(page.warnings, "\n") + '\n' +
                     joined(page.notes, "\n") + '\n';
  for (const Table& table : page.tables) {
    text += text_of(table);
  }
  for (const Section& section : page.sections) {
    text += section.title + '\n' + section.text + '\n';
    for (const Chart& chart : section.charts) {
      text += text_of(chart);
    }
    for (const Table& table : section.tables) {
      text += text_of(table);
    }
  }
  return text;
}

/// ASCII letters and digits, `_`, and what begins or goes on a letter of another alphabet: not a
/// dash, nor a raised 2.
bool is_letter(std::string_view text, std::size_t at) {
  if (at >= text.size()) {
    return false;
  }
  const auto byte = static_cast<unsigned char>(text[at]);
  if (byte < 0x80) {
    return std::isalnum(byte) != 0 || byte == '_';
  }
  std::size_t lead = at;
  while (lead > 0 && (static_cast<unsigned char>(text[lead]) & 0xc0U) == 0x80) {
    --lead;
  }
  const auto first = static_cast<unsigned char>(text[lead]);
  return first >= 0xc3 && first <= 0xcf;
}

/// Where a whole word is from `from` on; npos: nowhere. A term may be in the plural; x' is not x.
std::size_t find_word(const std::string& text, const std::string& word, std::size_t from,
                      bool is_term) {
  for (std::size_t at = from; (at = text.find(word, at)) != std::string::npos; ++at) {
    const std::size_t end = at + word.size();
    const char next = end < text.size() ? text[end] : '\0';
    const bool goes_on = is_term ? is_letter(text, next == 's' ? end + 1 : end)
                                 : is_letter(text, end) || next == '\'';
    if (!goes_on && (at == 0 || !is_letter(text, at - 1))) {
      return at;
    }
  }
  return std::string::npos;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

struct Name {
  std::string text;
  std::size_t entry;
};

/// Longest first.
std::vector<Name> names(bool of_symbols) {
  std::vector<Name> all;
  for (std::size_t i = 0; i < glossary().size(); ++i) {
    if (glossary()[i].is_symbol == of_symbols) {
      for (const std::string& name : glossary()[i].names) {
        all.push_back({of_symbols ? name : lower(name), i});
      }
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Name& one, const Name& other) {
    return one.text.size() > other.text.size();
  });
  return all;
}

void mark_terms(std::string text, std::vector<bool>& is_used) {
  text = lower(text);
  for (const Name& name : names(false)) {
    std::size_t at = 0;
    while ((at = find_word(text, name.text, at, true)) != std::string::npos) {
      is_used[name.entry] = true;
      text.replace(at, name.text.size(), name.text.size(), ' ');
    }
  }
}

void mark_symbols(const std::string& text, std::vector<bool>& is_used) {
  static const process::RegularExpression brackets(R"(\[[^\]\n]*\])");
  static const process::RegularExpression units(R"([0-9]+ ?[A-Za-z][^\s,;:)]*)");
  const std::string with_units = brackets.replace(text, " ");
  const std::string without = units.replace(with_units, " ");
  for (const Name& name : names(true)) {
    const std::string& where = name.text.size() == 1 ? without : with_units;
    if (find_word(where, name.text, 0, false) != std::string::npos) {
      is_used[name.entry] = true;
    }
  }
}

std::string meanings(const std::vector<bool>& of) {
  std::string text;
  for (std::size_t i = 0; i < of.size(); ++i) {
    text += of[i] ? glossary()[i].meaning + '\n' : "";
  }
  return text;
}

}  // namespace

Table words_of(const Page& page) {
  const std::string text = text_of(page);
  std::vector<bool> is_used(glossary().size());
  mark_terms(text, is_used);
  mark_symbols(text, is_used);
  std::vector<bool> before;
  while (before != is_used) {  // meanings have symbols too
    before = is_used;
    mark_symbols(meanings(is_used), is_used);
  }
  Table table{"Words and symbols", {"Word", "Meaning"}, {}, true};
  for (std::size_t i = 0; i < glossary().size(); ++i) {
    if (is_used[i]) {
      table.rows.push_back({joined(glossary()[i].names, ", "), glossary()[i].meaning});
    }
  }
  return table;
}

}  // namespace sonoglide::output
