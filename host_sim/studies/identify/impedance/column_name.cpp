#include "host_sim/studies/identify/impedance/column_name.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "host_sim/studies/identify/impedance/vocabulary.hpp"
#include "host_sim/studies/identify/plain_text.hpp"
#include "host_sim/studies/identify/table_search.hpp"
#include "host_sim/studies/identify/unit.hpp"

namespace sonoglide::identify::impedance {
namespace {

constexpr std::string_view alphabet = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

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
    const char each = text_[at_];
    if (std::isalpha(static_cast<unsigned char>(each)) != 0 || each == '%') {
      take_word();
    } else if (std::string_view("([{</,").find(each) != std::string_view::npos) {
      take_enclosed(each != '/' && each != ',');
    } else if (each == '|') {
      bars_ = true;
      set_role(Role::magnitude, "|");
      ++at_;
    } else if (each == '\'') {
      const bool twice = text_.compare(at_, 2, "''") == 0;
      set_role(twice ? Role::imaginary : Role::real, twice ? "''" : "'");
      at_ += twice ? 2 : 1;
    } else if (each == '-') {
      take_minus();
    } else if (std::string_view(" _.:;)]}>").find(each) != std::string_view::npos) {
      ++at_;
    } else {
      const std::size_t end = std::min(text_.find(' ', at_), text_.size());
      refuse(text_.substr(at_, end - at_));
      at_ = end;
    }
  }

  /// Of letters and digits; behind it may stand the rest of a unit.
  void take_word() {
    const std::size_t end = std::min(
        text_.find_first_not_of(std::string(alphabet) + "0123456789", at_ + 1), text_.size());
    const std::string word = text_.substr(at_, end - at_);
    at_ = end;
    if (!take(word) && !take_prefix(word) && !take_parts(word)) {
      refuse(word);
    }
  }

  bool take(const std::string& word) {
    const std::string small = lower_case(word);
    if (small == "neg" || small == "negative" || small == "minus") {
      negative_ = !negative_;
      return true;
    }
    const auto unit = unit_of_word(word);
    const auto meaning = meaning_of(small);
    // THz is no theta of Z; a capital F behind a name is no frequency, but a farad.
    const bool is_unit =
        unit && (!meaning || (unit->dimension != Dimension::other && word.size() > 1) ||
                 (unit->dimension == Dimension::other && words_ > 0 && small != word));
    if (meaning && !is_unit) {
      ++words_;
      take_meaning(*meaning, word);
      return true;
    }
    if (small == "p" && words_ == 0) {
      is_letter_p_ = true;
      return true;
    }
    if (unit) {
      take_unit(*unit, word);
      return true;
    }
    return is_filler(small);
  }

  /// `k Ohm`, `kilo-ohm`.
  bool take_prefix(const std::string& word) {
    if (!scale_of_prefix(word) || at_ >= text_.size() ||
        std::string_view(" -_").find(text_[at_]) == std::string_view::npos) {
      return false;
    }
    const std::size_t end = std::min(text_.find_first_not_of(alphabet, at_ + 1), text_.size());
    const auto unit = unit_of_word(word + text_.substr(at_ + 1, end - at_ - 1));
    if (!unit || unit->dimension == Dimension::other) {
      return false;
    }
    take_unit(*unit, word);
    at_ = end;
    return true;
  }

  /// Words that are told apart by a capital: PhaseDeg, ZmagkOhm.
  bool take_parts(const std::string& word) {
    for (std::size_t i = 1; i < word.size(); ++i) {
      const bool capital = std::isupper(static_cast<unsigned char>(word[i])) != 0 &&
                           std::islower(static_cast<unsigned char>(word[i - 1])) != 0;
      if (!capital) {
        continue;
      }
      const std::string rest = word.substr(i);
      const Reader before(*this);
      const bool refused = !result_.not_understood.empty();
      if (take(word.substr(0, i)) && (take(rest) || take_parts(rest)) &&
          result_.not_understood.empty() != refused) {
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
    const bool is_word = meaning_of(inside) && lower_case(inside) == inside;
    const bool words = inside.find_first_of("/*^") == std::string::npos &&
                       inside.find_first_of("0123456789") != 0 && (in_brackets || !inside.empty());
    if (unit && (unit->dimension != Dimension::other || !is_word)) {
      negative_ = negative_ != minus;
      take_unit(*unit, inside);
    } else if (words || minus) {
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

  void take_meaning(const Meaning& word, const std::string& as_it_stands) {
    if (word.role != Role::none) {
      set_role(word.role, as_it_stands);
    }
    if (word.subject != Subject::unknown) {
      if (result_.subject != Subject::unknown && result_.subject != word.subject) {
        refuse(as_it_stands);
      }
      result_.subject = word.subject;
    }
  }

  void set_role(Role role, const std::string& as_it_stands) {
    result_.may_be_phase = result_.may_be_phase || role == Role::phase;
    if (result_.role != Role::none && result_.role != role) {
      refuse(as_it_stands);
    }
    result_.role = role;
  }

  void take_unit(const Unit& unit, const std::string& as_it_stands) {
    if (unit.dimension == Dimension::level && unit.scale == 1.0) {
      result_.decibel = true;
      return;
    }
    if (unit_ && (unit_->dimension != unit.dimension || unit_->scale != unit.scale)) {
      refuse(as_it_stands);
      has_two_units_ = true;
    }
    unit_ = unit;
    unit_text_ = as_it_stands;
  }

  void refuse(const std::string& part) {
    if (result_.not_understood.empty()) {
      result_.not_understood = part;
    }
  }

  /// The role that a unit gives, and whether the unit is one of what is named.
  void conclude() {
    const bool named = result_.role != Role::none || result_.subject != Subject::unknown;
    const bool only_bars = bars_ && words_ == 0;
    const bool is_other = unit_ && unit_->dimension == Dimension::other;
    const bool level_of_unknown = (is_other || (result_.decibel && !unit_)) &&
                                  result_.role == Role::magnitude &&
                                  result_.subject == Subject::unknown;
    if ((!named && !unit_) || (is_other && (!named || only_bars)) || level_of_unknown ||
        (only_bars && !result_.not_understood.empty())) {
      result_ = {};
      return;
    }
    if (is_letter_p_) {
      const bool is_angle = unit_ && unit_->dimension == Dimension::angle && !named;
      is_angle ? set_role(Role::phase, "p") : refuse("p");
    }
    if (unit_) {
      take_role_of_unit(named);
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
      const bool may_be_phase = unit_ && unit_->dimension == Dimension::angle && !has_two_units_;
      if (!named && !is_letter_p_ && !may_be_phase) {
        result_.not_understood.clear();
      }
      result_.role = Role::none;
    }
  }

  void take_role_of_unit(bool named) {
    const Dimension dimension = unit_->dimension;
    const Subject subject = dimension == Dimension::impedance    ? Subject::impedance
                            : dimension == Dimension::admittance ? Subject::admittance
                                                                 : Subject::unknown;
    result_.is_bare_unit = !named;
    if (!named) {
      set_role(dimension == Dimension::frequency ? Role::frequency
               : dimension == Dimension::angle   ? Role::phase
                                                 : Role::magnitude,
               unit_text_);
    }
    const bool right = result_.role == Role::frequency ? dimension == Dimension::frequency
                       : result_.role == Role::phase   ? dimension == Dimension::angle
                                                       : subject != Subject::unknown;
    if (!right || (subject != Subject::unknown && result_.subject != Subject::unknown &&
                   result_.subject != subject)) {
      refuse(unit_text_);
    } else if (subject != Subject::unknown) {
      result_.subject = subject;
    }
  }

  std::string text_;
  std::size_t at_ = 0;
  ColumnName result_;
  std::optional<Unit> unit_;
  std::string unit_text_;
  bool negative_ = false;
  bool bars_ = false;
  bool is_letter_p_ = false;
  bool has_two_units_ = false;
  int words_ = 0;  ///< of the vocabulary
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
  return is_of_other_quantity(name) ? ColumnName() : Reader(plain_text(translated(name))).result();
}

}  // namespace sonoglide::identify::impedance
