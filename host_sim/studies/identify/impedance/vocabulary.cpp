#include "host_sim/studies/identify/impedance/vocabulary.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>
#include <utility>
#include <vector>

#include "host_sim/studies/identify/cell.hpp"
#include "host_sim/studies/identify/plain_text.hpp"

namespace sonoglide::identify::impedance {
namespace {

struct Words {
  Meaning meaning;
  std::string_view words;  ///< in small letters, between blanks
};

constexpr Words vocabulary[] = {
    {{Role::frequency, Subject::unknown},
     " f freq frequency frequencies frequenz frequence frecuencia frequenza "},
    {{Role::none, Subject::impedance}, " z zin z11 imp impedance impedanz impedancia impedenza "},
    {{Role::none, Subject::admittance}, " y yin y11 adm admittance admittanz "},
    {{Role::magnitude, Subject::unknown},
     " abs mag magnitude modulus module mod betrag amplitude "},
    {{Role::phase, Subject::unknown},
     " phase theta th phi phz arg argument angle ang fase winkel phasenwinkel "},
    {{Role::real, Subject::unknown}, " re real realteil "},
    {{Role::imaginary, Subject::unknown}, " im imag img imaginary "},
    {{Role::real, Subject::impedance}, " r rs resistance zr "},
    {{Role::imaginary, Subject::impedance}, " x xs reactance zi "},
    {{Role::real, Subject::admittance}, " g gp conductance "},
    {{Role::imaginary, Subject::admittance}, " b bp susceptance "}};

/// Words of other scripts, and what they are in the vocabulary.
/// Words of other scripts, and names as programs write them, behind what they are in the vocabulary.
constexpr std::array<std::string_view, 4> translations[] = {
    {" frequency ", "频率", "頻率", "周波数"},
    {" impedance ", "阻抗"},
    {" admittance ", "导纳", "導納"},
    {" phase ", "相位角", "相角", "位相"},
    {" phase ", "相位"},
    {" resistance ", "电阻", "電阻"},
    {" reactance ", "电抗", "電抗"},
    {" conductance ", "电导", "電導"},
    {" susceptance ", "电纳", "電納"},
    {" magnitude ", "幅值", "模值", "模"},
    {" Ohm ", "欧姆", "歐姆"},
    {" Hz ", "赫兹"},
    {"Z", "Z(1,1)"},
    {"Y", "Y(1,1)"},
    {"", "Trace 1:", "Trace 2:"},  // of a Bode 100
    {"Z'", "Z'(a)"},               // of ZPlot
    {"Z''", "Z''(b)"},
    {" deg ", "度"},
    {"e", "é"}};

constexpr std::string_view fillers =
    " trace data meas measured value values the of in for part component series ";
constexpr std::string_view elements = " cp cs lp ls rp q d ";

/// A word of a name, or S11 and s_21.
const char* const ratios =
    "(^|[^a-z0-9])(s_*[0-9]|"
    "(gain|transmission|reflection|gamma|loss|v?swr|attenuation)([^a-z0-9]|$))";

const Meaning* find_word(std::string_view word) {
  const auto* const found =
      std::find_if(std::begin(vocabulary), std::end(vocabulary),
                   [&](const Words& each) { return is_among(word, each.words); });
  return found == std::end(vocabulary) ? nullptr : &found->meaning;
}

}  // namespace

std::optional<Meaning> meaning_of(std::string_view any_case) {
  const std::string word = lower_case(any_case);
  if (const Meaning* found = find_word(word)) {
    return *found;
  }
  for (const auto& [letter, subject] :
       {std::pair('z', Subject::impedance), std::pair('y', Subject::admittance)}) {
    for (const bool before : {true, false}) {
      if (word.size() < 3 || (before ? word.front() : word.back()) != letter) {
        continue;
      }
      const Meaning* part = find_word(before ? word.substr(1) : word.substr(0, word.size() - 1));
      if (part != nullptr && part->subject == Subject::unknown && part->role != Role::frequency) {
        return Meaning{part->role, subject};
      }
    }
  }
  return std::nullopt;
}

bool is_filler(std::string_view word) {
  return is_among(word, fillers);
}

bool is_equivalent_element(std::string_view word) {
  return is_among(word, elements);
}

bool is_of_ratio(std::string_view name) {
  static const std::regex form(ratios, std::regex::icase);
  constexpr std::size_t most_searched = 200;  // An expression takes stack for each letter.
  return std::regex_search(plain_text(translated(name.substr(0, most_searched))), form);
}

bool is_of_other_quantity(std::string_view name) {
  std::string words = lower_case(plain_text(translated(name)));
  std::replace_if(
      words.begin(), words.end(), [](unsigned char each) { return std::isalnum(each) == 0; }, ' ');
  const std::vector<Cell> cells = cells_of(words, ' ');
  return is_of_ratio(name) || std::any_of(cells.begin(), cells.end(), [](const Cell& each) {
           return is_equivalent_element(each.text);
         });
}

std::string translated(std::string_view text) {
  std::string english(text);
  for (const auto& each : translations) {
    for (std::size_t i = 1; i < each.size() && !each[i].empty(); ++i) {
      for (std::size_t at = english.find(each[i]); at != std::string::npos;
           at = english.find(each[i], at + each[0].size())) {
        english.replace(at, each[i].size(), each[0]);
      }
    }
  }
  return english;
}

}  // namespace sonoglide::identify::impedance
