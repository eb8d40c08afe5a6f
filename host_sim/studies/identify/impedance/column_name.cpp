#include "host_sim/studies/identify/impedance/sweep_columns.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "host_sim/process/regular_expression.hpp"
#include "host_sim/studies/identify/text_file.hpp"
#include "host_sim/studies/identify/unit.hpp"

namespace sonoglide::identify::impedance {
namespace {

/// What a word says beside its role and subject: that it turns the sign, or that the name is of another
/// quantity, a ratio or an element of an equivalent circuit.
enum class Kind { plain, minus, ratio, element };

struct Meaning {
  Role role;
  Subject subject;
  Kind kind = Kind::plain;
};

constexpr Role no_role = Role::none;
constexpr Subject any = Subject::unknown;

/// Words in small letters, between blanks.
constexpr std::pair<std::string_view, Meaning> vocabulary[] = {
    {" f freq frequency frequencies frequenz frequence frecuencia frequenza ",
     {Role::frequency, any}},
    {" z zin z11 imp impedance impedanz impedancia impedenza ", {no_role, Subject::impedance}},
    {" y yin y11 adm admittance admittanz ", {no_role, Subject::admittance}},
    {" | abs mag magnitude modulus module mod betrag amplitude ", {Role::magnitude, any}},
    {" phase theta th phi phz arg argument angle ang fase winkel phasenwinkel ",
     {Role::phase, any}},
    {" ' re real realteil ", {Role::real, any}},
    {" '' im imag img imaginary ", {Role::imaginary, any}},
    {" r rs resistance zr ", {Role::real, Subject::impedance}},
    {" x xs reactance zi ", {Role::imaginary, Subject::impedance}},
    {" g gp conductance ", {Role::real, Subject::admittance}},
    {" b bp susceptance ", {Role::imaginary, Subject::admittance}},
    {" trace data meas measured value values the of in for part component series ", {no_role, any}},
    {" neg negative minus ", {no_role, any, Kind::minus}},
    {" gain transmission reflection gamma loss swr vswr attenuation ", {no_role, any, Kind::ratio}},
    {" cp cs lp ls rp q d ", {no_role, any, Kind::element}}};

/// A name in its usual spelling, in this order.
std::string rewritten(std::string name) {
  struct Rewriting {
    process::RegularExpression form;
    const char* as = nullptr;
  };
  static const Rewriting rewritings[] = {
      // Of a Bode 100, ZPlot and HFSS: Trace 1:, Z'(a), Z''(b), Z(1,1).
      {process::RegularExpression(R"(Trace [0-9]:|\(1,1\)|('+)\([ab]\))"), "$1"},
      {process::RegularExpression("(^|[^A-Za-z0-9])[Ss]_*(?=[0-9])"), "$1gain "},  // S11
      {process::RegularExpression("([a-z]{2})(?=[A-Z])"), "$1 "},                  // PhaseDeg
      // k Ohm, kilo-ohm; other prefixes only where nothing else is meant.
      {process::RegularExpression(
           "((?:^|[^A-Za-z])(?:[kMun]|[Kk]ilo?|[Mm]ega?|[Mm]illi|[Mm]icro?|[Gg]iga|[Nn]ano)"
           R"(|[(\[{<] *[pmKGT])[-_ ](?=(?:[Oo]hms?|OHMS?|Hz|HZ|[Hh]ertz)"
           "|S|[Ss]iemens|[Mm]hos?)(?![A-Za-z]))"),
       "$1"},
      {process::RegularExpression(R"(^ *[Pp](?=[ _]*[(\[{</,]? *-? *(?:m?rad|[Dd]eg|DEG|RAD)))"),
       "phase"},
      {process::RegularExpression(R"(^([ (]*)-)"), "$1minus "},
      {process::RegularExpression(R"(([(\[{<]) *-(?! *[-)\]}>]))"), " minus $1"}};
  for (const Rewriting& each : rewritings) {
    name = each.form.replace(name, each.as);
  }
  return name;
}

std::optional<Meaning> find_word(std::string_view word) {
  const auto* const found =
      std::find_if(std::begin(vocabulary), std::end(vocabulary),
                   [&](const auto& each) { return is_among(word, each.first); });
  return found == std::end(vocabulary) ? std::nullopt : std::optional(found->second);
}

/// Of a word in small letters, and of a part with its z or y in one word, as `absz` and `zphase`.
std::optional<Meaning> meaning_of(const std::string& word) {
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
    conclude();
  }

  ColumnName result() const { return result_; }

 private:
  void take_next() {
    const auto is = [each = text_[at_]](std::string_view among) {
      return among.find(each) != std::string_view::npos;
    };
    if (is("([{</,")) {
      take_enclosed(is("([{<") ? ")]}>" : "([{<");
    } else if (is("-")) {
      take_dash();
    } else if (is(" _.:;)]}>")) {
      ++at_;
    } else {
      take_word();
    }
  }

  /// Letters and digits, a bar or quotes; else all up to a blank.
  void take_word() {
    static const process::RegularExpression form("[A-Za-z%][A-Za-z0-9]*|''|'|\\||[^ ]+");
    const std::string word = form.search(text_.substr(at_)).at(0);
    at_ += word.size();
    const std::string small = lower_case(word);
    const auto unit = unit_of_word(word);
    const auto meaning = meaning_of(small);
    // THz is no theta of Z; a capital F behind a name is no frequency, but a farad.
    if (unit && (!meaning || (unit->dimension != Dimension::other && word.size() > 1) ||
                 (unit->dimension == Dimension::other && has_word_ && small != word))) {
      add(*unit, word);
    } else if (meaning) {
      add(*meaning, word);
    } else {
      refuse(word);
    }
  }

  /// A unit and nothing else, or words: in brackets, or behind a slash or a comma as in `Z / kOhm`.
  void take_enclosed(std::string_view closing) {
    const std::size_t end = std::min(text_.find_first_of(closing, at_), text_.size());
    const std::string inside(trimmed(std::string_view(text_).substr(at_ + 1, end - at_ - 1)));
    const auto unit = unit_of_text(inside);
    const bool is_word = lower_case(inside) == inside && meaning_of(inside);
    if (unit && (unit->dimension != Dimension::other || !is_word)) {
      add(*unit, inside);
      at_ = end;
    } else if (inside.find_first_of("/*^") != std::string::npos ||
               inside.find_first_of("0123456789") == 0) {
      refuse(inside);
      at_ = end;
    } else {
      ++at_;
    }
  }

  /// One that is no minus joins words.
  void take_dash() {
    const char before = at_ > 0 ? text_[at_ - 1] : ' ';
    const char behind = at_ + 1 < text_.size() ? text_[at_ + 1] : ' ';
    if ((before == ' ' || before == '(') != (behind == ' ')) {
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
    if (is_other_ || (!named && !unit_) || (is_other && (!named || only_bars)) ||
        level_of_unknown || (only_bars && !result_.not_understood.empty())) {
      const bool is_ratio = result_.is_ratio;
      result_ = {};
      result_.is_ratio = is_ratio;
      return;
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
      const bool is_angle = unit_ && unit_->dimension == Dimension::angle;
      if (!named && (!is_angle || has_two_units_)) {
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
  return Reader(rewritten(plain_text(name))).result();
}

}  // namespace sonoglide::identify::impedance
