#include "host_sim/studies/identify/impedance/column_name.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <regex>
#include <utility>

#include "host_sim/studies/identify/plain_text.hpp"
#include "host_sim/studies/identify/unit.hpp"

namespace sonoglide::identify::impedance {
namespace {

constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

/// What a word says beside its role and subject: that it turns the sign, or that the name is of another
/// quantity, a ratio or an element of an equivalent circuit.
enum class Kind { plain, minus, ratio, element };

struct Meaning {
  Role role = Role::none;
  Subject subject = Subject::unknown;
  Kind kind = Kind::plain;
};

struct Words {
  Meaning meaning;
  std::string_view words;  ///< in small letters, between blanks
};

constexpr Words vocabulary[] = {
    {{Role::frequency}, " f freq frequency frequencies frequenz frequence frecuencia frequenza "},
    {{Role::none, Subject::impedance}, " z zin z11 imp impedance impedanz impedancia impedenza "},
    {{Role::none, Subject::admittance}, " y yin y11 adm admittance admittanz "},
    {{Role::magnitude}, " | abs mag magnitude modulus module mod betrag amplitude "},
    {{Role::phase}, " phase theta th phi phz arg argument angle ang fase winkel phasenwinkel "},
    {{Role::real}, " ' re real realteil "},
    {{Role::imaginary}, " '' im imag img imaginary "},
    {{Role::real, Subject::impedance}, " r rs resistance zr "},
    {{Role::imaginary, Subject::impedance}, " x xs reactance zi "},
    {{Role::real, Subject::admittance}, " g gp conductance "},
    {{Role::imaginary, Subject::admittance}, " b bp susceptance "},
    {{}, " trace data meas measured value values the of in for part component series "},
    {{Role::none, Subject::unknown, Kind::minus}, " neg negative minus "},
    {{Role::none, Subject::unknown, Kind::ratio},
     " gain transmission reflection gamma loss swr vswr attenuation "},
    {{Role::none, Subject::unknown, Kind::element}, " cp cs lp ls rp q d "}};

std::optional<Meaning> find_word(std::string_view word) {
  const auto* const found =
      std::find_if(std::begin(vocabulary), std::end(vocabulary),
                   [&](const Words& each) { return is_among(word, each.words); });
  return found == std::end(vocabulary) ? std::nullopt : std::optional(found->meaning);
}

/// Of a word in small letters, and of a part with its z or y in one word, as `absz` and `zphase`.
std::optional<Meaning> meaning_of(const std::string& word) {
  if (word.size() > 1 && word[0] == 's' && std::isdigit(static_cast<unsigned char>(word[1])) != 0) {
    return Meaning{Role::none, Subject::unknown, Kind::ratio};
  }
  auto found = find_word(word);
  for (const bool before : {true, false}) {
    const char letter = word.size() < 3 ? '\0' : before ? word.front() : word.back();
    if (found || (letter != 'z' && letter != 'y')) {
      continue;
    }
    const auto part = find_word(before ? word.substr(1) : word.substr(0, word.size() - 1));
    if (part && part->subject == Subject::unknown && part->role > Role::frequency) {
      found = {part->role, letter == 'z' ? Subject::impedance : Subject::admittance};
    }
  }
  return found;
}

/// Goes through a name from its beginning to its end and takes every part of it, or says which it
/// does not understand.
class Reader {
 public:
  explicit Reader(std::string text) : text_(std::move(text)) {
    while (at_ < text_.size()) {
      take_next();
    }
    if (is_other_) {
      const bool is_ratio = result_.is_ratio;
      result_ = {};
      result_.is_ratio = is_ratio;
      return;
    }
    conclude();
  }

  ColumnName result() const { return result_; }

 private:
  void take_next() {
    const char each = text_[at_];
    if (std::string_view("([{</,").find(each) != std::string_view::npos) {
      take_enclosed(each != '/' && each != ',');
    } else if (each == '-') {
      take_minus();
    } else if (std::string_view(" _.:;)]}>").find(each) != std::string_view::npos) {
      ++at_;
    } else {
      take_word();
    }
  }

  /// Letters and digits, a bar or quotes; behind a word may stand the rest of a unit.
  void take_word() {
    const std::size_t begin = at_;
    if (std::isalpha(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '%') {
      at_ = std::min(text_.find_first_not_of(std::string(letters) + "0123456789", at_ + 1),
                     text_.size());
    } else if (text_[at_] == '|' || text_[at_] == '\'') {
      at_ += text_.compare(at_, 2, "''") == 0 ? 2 : 1;
    } else {
      at_ = std::min(text_.find(' ', at_), text_.size());
    }
    const std::string word = text_.substr(begin, at_ - begin);
    if (!take(word) && !take_prefix(word) && !take_parts(word)) {
      refuse(word);
    }
  }

  bool take(const std::string& word) {
    const std::string small = lower_case(word);
    const auto unit = unit_of_word(word);
    const auto meaning = meaning_of(small);
    // THz is no theta of Z; a capital F behind a name is no frequency, but a farad.
    const bool is_unit =
        unit && (!meaning || (unit->dimension != Dimension::other && word.size() > 1) ||
                 (unit->dimension == Dimension::other && has_word_ && small != word));
    if (is_unit) {
      add(*unit, word);
    } else if (meaning) {
      add(*meaning, word);
    } else if (small == "p" && !has_word_) {
      is_letter_p_ = true;
    }
    return is_unit || meaning || (small == "p" && !has_word_);
  }

  /// `k Ohm`, `kilo-ohm`.
  bool take_prefix(const std::string& word) {
    const bool parted =
        at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '-' || text_[at_] == '_');
    if (!scale_of_prefix(word) || !parted) {
      return false;
    }
    const std::size_t end = std::min(text_.find_first_not_of(letters, at_ + 1), text_.size());
    const auto unit = unit_of_word(word + text_.substr(at_ + 1, end - at_ - 1));
    if (!unit || unit->dimension == Dimension::other) {
      return false;
    }
    add(*unit, word);
    at_ = end;
    return true;
  }

  /// Words that are told apart by a capital: PhaseDeg, ZmagKOhm.
  bool take_parts(const std::string& word) {
    for (std::size_t i = 1; i < word.size(); ++i) {
      const bool capital = std::isupper(static_cast<unsigned char>(word[i])) != 0 &&
                           std::islower(static_cast<unsigned char>(word[i - 1])) != 0;
      const Reader before(*this);
      if (capital && take(word.substr(0, i)) &&
          (take(word.substr(i)) || take_parts(word.substr(i))) &&
          result_.not_understood == before.result_.not_understood) {
        return true;
      }
      *this = before;
    }
    return false;
  }

  /// A unit and nothing else, or words: in brackets, or behind a slash or a comma as in `Z / kOhm`.
  void take_enclosed(bool in_brackets) {
    const std::size_t end =
        std::min(text_.find_first_of(in_brackets ? ")]}>" : "([{<", at_), text_.size());
    std::string inside(trimmed(std::string_view(text_).substr(at_ + 1, end - at_ - 1)));
    const bool minus = in_brackets && inside.size() > 1 && inside.front() == '-';
    inside.erase(0, minus ? 1 : 0);
    const auto unit = unit_of_text(inside);
    const bool is_word = lower_case(inside) == inside && meaning_of(inside);
    const bool has_words = inside.find_first_of("/*^") == std::string::npos &&
                           inside.find_first_of("0123456789") != 0 &&
                           (in_brackets || !inside.empty());
    if (unit && (unit->dimension != Dimension::other || !is_word)) {
      negative_ = negative_ != minus;
      add(*unit, inside);
    } else if (has_words || minus) {
      ++at_;
      return;
    } else {
      refuse(inside.empty() ? text_.substr(at_, 1) : inside);
    }
    at_ = std::min(end + (in_brackets ? 1 : 0), text_.size());
  }

  /// At the beginning, also behind a bracket, it turns the sign; between words it joins them.
  void take_minus() {
    const bool leads = text_.find_first_not_of(" (") == at_;
    const char before = at_ > 0 ? text_[at_ - 1] : ' ';
    const char behind = at_ + 1 < text_.size() ? text_[at_ + 1] : ' ';
    if (leads) {
      negative_ = !negative_;
    } else if ((before == ' ' || before == '(') != (behind == ' ')) {
      refuse(text_.substr(at_));
    }
    ++at_;
  }

  void add(const Meaning& said, const std::string& word) {
    negative_ = negative_ != (said.kind == Kind::minus);
    result_.is_ratio = result_.is_ratio || said.kind == Kind::ratio;
    is_other_ = is_other_ || said.kind == Kind::ratio || said.kind == Kind::element;
    const bool says = said.role != Role::none || said.subject != Subject::unknown;
    has_word_ = has_word_ || (says && word[0] != '|' && word[0] != '\'');
    merge(result_.role, said.role, Role::none, word);
    merge(result_.subject, said.subject, Subject::unknown, word);
  }

  void add(const Unit& unit, const std::string& word) {
    if (unit.dimension == Dimension::level) {
      result_.decibel = true;
      return;
    }
    if (unit_ && (unit_->dimension != unit.dimension || unit_->scale != unit.scale)) {
      refuse(word);
      has_two_units_ = true;
    }
    unit_ = unit;
    unit_text_ = word;
  }

  /// Two that say something have to say the same.
  template <typename Said>
  void merge(Said& known, Said said, Said nothing, const std::string& word) {
    if (said != nothing) {
      if (known != nothing && known != said) {
        refuse(word);
      }
      known = said;
    }
  }

  void refuse(const std::string& part) {
    if (result_.not_understood.empty()) {
      result_.not_understood = part;
    }
  }

  /// The role that a unit gives, and whether the unit is one of what is named.
  void conclude() {
    const bool named = result_.role != Role::none || result_.subject != Subject::unknown;
    const bool only_bars = !has_word_ && text_.find('|') != std::string::npos;
    const bool is_other = unit_ && unit_->dimension == Dimension::other;
    const bool level_of_unknown = (is_other || (result_.decibel && !unit_)) &&
                                  result_.role == Role::magnitude &&
                                  result_.subject == Subject::unknown;
    if ((!named && !unit_) || (is_other && (!named || only_bars)) || level_of_unknown ||
        (only_bars && !result_.not_understood.empty())) {
      result_ = {};
      return;
    }
    const bool is_angle = unit_ && unit_->dimension == Dimension::angle;
    if (is_letter_p_ && (named || !is_angle)) {
      refuse("p");
    }
    if (unit_) {
      add_role_of_unit(named);
    }
    if (result_.role == Role::none && result_.subject != Subject::unknown) {
      result_.role = Role::magnitude;
    }
    if (result_.decibel &&
        (result_.role != Role::magnitude || result_.subject == Subject::unknown)) {
      refuse("dB");
    }
    if (negative_ && result_.role != Role::phase && result_.role != Role::imaginary) {
      refuse("-");
    }
    result_.scale = (unit_ ? unit_->scale : 1.0) * (negative_ ? -1.0 : 1.0);
    result_.has_unit = unit_.has_value();
    if (!result_.not_understood.empty()) {
      // A name of which nothing is a sweep's but a unit is of something else, if not of an angle.
      if (!named && !is_letter_p_ && (!is_angle || has_two_units_)) {
        result_.not_understood.clear();
      }
      result_.role = Role::none;
    }
  }

  void add_role_of_unit(bool named) {
    const Dimension dimension = unit_->dimension;
    const Subject subject = dimension == Dimension::impedance    ? Subject::impedance
                            : dimension == Dimension::admittance ? Subject::admittance
                                                                 : Subject::unknown;
    const Role role = dimension == Dimension::frequency ? Role::frequency
                      : dimension == Dimension::angle   ? Role::phase
                                                        : Role::magnitude;
    result_.is_bare_unit = !named;
    merge(result_.role, named ? Role::none : role, Role::none, unit_text_);
    const bool is_part = result_.role != Role::frequency && result_.role != Role::phase;
    if (is_part ? subject == Subject::unknown : result_.role != role) {
      refuse(unit_text_);
    }
    merge(result_.subject, subject, Subject::unknown, unit_text_);
  }

  std::string text_;
  std::size_t at_ = 0;
  ColumnName result_;
  std::optional<Unit> unit_;
  std::string unit_text_;
  bool negative_ = false;
  bool is_other_ = false;
  bool is_letter_p_ = false;
  bool has_two_units_ = false;
  bool has_word_ = false;  ///< of the vocabulary that says something
};

}  // namespace

double ColumnName::value(double cell) const {
  constexpr double decibels_a_decade = 20.0;
  return scale * (decibel ? std::pow(10.0, cell / decibels_a_decade) : cell);
}

ColumnName read_name(std::string_view name) {
  constexpr std::size_t longest = 200;
  if (name.size() > longest) {
    ColumnName unknown;
    unknown.not_understood = shortened(name);
    return unknown;
  }
  // As a Bode 100, ZPlot and HFSS have it: Trace 1:, Z'(a), Z''(b), Z(1,1); then S_11.
  static const std::regex additions(R"(Trace [0-9]:|\(1,1\)|('+)\([ab]\))");
  static const std::regex scattering("(^|[^A-Za-z0-9])[Ss]_+(?=[0-9])");
  const std::string plain = std::regex_replace(plain_text(name), additions, "$1");
  return Reader(std::regex_replace(plain, scattering, "$01S")).result();
}

}  // namespace sonoglide::identify::impedance
