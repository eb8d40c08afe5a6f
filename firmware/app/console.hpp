/// A console for a terminal: one command a line, answers in words.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/app/unit.hpp"
#include "firmware/app/unit_names.hpp"
#include "firmware/encoding/decimal.hpp"
#include "firmware/encoding/text_line.hpp"

namespace sonoglide::app {

/// | command        | does                                                       |
/// |----------------|------------------------------------------------------------|
/// | status         | state, target, drive, limit, fault                         |
/// | target RATIO   | until reset                                                |
/// | stop           | drive to zero                                              |
/// | restart        | from a stop or a fault                                     |
/// | faults         | the latest first                                           |
/// | params         | each with what is allowed, and as compiled in              |
/// | set NAME VALUE | saved; needs a stop first                                  |
///
/// @tparam ByteLink  see hal/board.hpp.
template <class UnitT, class ByteLink>
class Console {
 public:
  static constexpr std::size_t most_line_characters = 48;
  static constexpr std::size_t most_answer_characters = 160;

  Console(UnitT& unit, ByteLink& bytes) : unit_(unit), bytes_(bytes) {}

  /// One character sent or received, one line of an answer made, or one step of a save.
  void serve() {
    if (sent_ < answer_.size()) {
      sent_ += bytes_.send(static_cast<std::uint8_t>(answer_[sent_])) ? 1U : 0U;
    } else if (saving_) {
      finish_set(unit_.proceed());
    } else if (listing_ != Listing::none) {
      list();
    } else {
      receive();
    }
  }

 private:
  using Word = encoding::Characters;
  static constexpr std::size_t most_words = 3;
  enum class Listing : std::uint8_t { none, faults, parameters };

  void receive() {
    std::uint8_t byte = 0;
    if (!bytes_.receive(byte)) {
      return;
    }
    const auto character = static_cast<char>(byte);
    if (character != '\r' && character != '\n') {
      too_long_ = too_long_ || line_.size() == most_line_characters;
      line_.add(character < ' ' || character > '~' ? '?' : character);
      return;
    }
    if (too_long_) {
      begin_answer();
      answer_.add("too long; a line has at most ");
      answer_.add_number(most_line_characters);
      answer_.add(" characters");
      end_answer();
    } else {
      carry_out();
    }
    line_.clear();
    too_long_ = false;
  }

  void carry_out() {
    Word words[most_words + 1];
    const std::size_t count = split(words);
    if (count == 0) {
      return;
    }
    if (count == 1 && words[0].are("faults")) {
      begin_listing(Listing::faults);
    } else if (count == 1 && words[0].are("params")) {
      begin_listing(Listing::parameters);
    } else {
      begin_answer();
      answer(words, count);
      end_answer();
    }
  }

  /// Words of the line, most_words + 1 at most.
  std::size_t split(Word* words) const {
    std::size_t count = 0;
    bool in_word = false;
    for (std::size_t i = 0; i < line_.size() && count <= most_words; ++i) {
      const bool blank = line_[i] == ' ';
      if (!blank && !in_word) {
        words[count++] = {line_.data() + i, 0};
      }
      in_word = !blank;
      words[count > 0 ? count - 1 : 0].size += in_word ? 1U : 0U;
    }
    return count;
  }

  void answer(const Word* words, std::size_t count) {
    if (count == 1 && words[0].are("status")) {
      status();
    } else if (count == 2 && words[0].are("target")) {
      set_target(words[1]);
    } else if (count == 1 && words[0].are("stop")) {
      unit_.supervisor().stop();
      status();
    } else if (count == 1 && words[0].are("restart")) {
      unit_.supervisor().restart();
      status();
    } else if (count == 3 && words[0].are("set")) {
      set(words[1], words[2]);
    } else {
      answer_.add(
          "unknown; there are: status, target RATIO, stop, restart, faults, params, set NAME "
          "VALUE");
    }
  }

  void status() {
    const auto& supervisor = unit_.supervisor();
    const hal::Drive& drive = supervisor.drive();
    answer_.add("state ");
    answer_.add(control::name(static_cast<control::State>(drive.state)));
    answer_.add(", target ");
    answer_.add_number(unit_.target(), 6);
    answer_.add(", drive ");
    answer_.add_number(millionths(drive.amplitude), 6);
    answer_.add(", limit ");
    answer_.add(control::name(static_cast<control::Limit>(drive.limit)));
    answer_.add(", fault ");
    answer_.add(fault_name(drive.fault));
    answer_.add(", parameters ");
    answer_.add(name(unit_.origin()));
    answer_.add(", period ");
    answer_.add_number(supervisor.periods());
  }

  /// @param amplitude  code, 0 … 2^31 − 1.
  static std::uint32_t millionths(std::int32_t amplitude) {
    const auto scaled = static_cast<std::uint64_t>(amplitude) * one_in_millionths;
    return static_cast<std::uint32_t>((scaled + (1U << 30)) >> 31);
  }

  void set_target(const Word& text) {
    const ParameterInfo& info = unit_.info(Parameter::target);
    std::uint32_t ratio = 0;
    if (encoding::read_decimal(text.begin, text.size, info.decimal_places, ratio) &&
        unit_.set_target(ratio) == Answer::taken) {
      status();
    } else {
      refuse_value(info);
    }
  }

  void set(const Word& name, const Word& text) {
    const std::size_t parameter = find(name);
    if (parameter == parameter_count) {
      answer_.add(name);
      answer_.add(": unknown; params lists what there is");
      return;
    }
    const ParameterInfo& info = unit_.info(parameter);
    std::uint32_t value = 0;
    if (!encoding::read_decimal(text.begin, text.size, info.decimal_places, value)) {
      refuse_value(info);
      return;
    }
    switch (unit_.write(parameter, value)) {
      case Answer::taken:
        setting_ = parameter;
        saving_ = true;
        break;
      case Answer::out_of_range:
      case Answer::unknown_parameter:
        refuse_value(info);
        break;
      case Answer::drive_not_stopped:
        answer_.add(info.name);
        answer_.add(": stop the drive first");
        break;
    }
  }

  std::size_t find(const Word& name) const {
    std::size_t parameter = 0;
    while (parameter < parameter_count && !name.are(unit_.info(parameter).name)) {
      ++parameter;
    }
    return parameter;
  }

  void finish_set(store::Saving saving) {
    if (saving == store::Saving::busy) {
      return;
    }
    saving_ = false;
    begin_answer();
    name_value(setting_);
    answer_.add(saving == store::Saving::saved ? ", saved" : " stands; not saved");
    end_answer();
  }

  void name_value(std::size_t parameter) {
    const ParameterInfo& info = unit_.info(parameter);
    answer_.add(info.name);
    answer_.add(' ');
    answer_.add_number(unit_.value(parameter), info.decimal_places);
  }

  void refuse_value(const ParameterInfo& info) {
    answer_.add(info.name);
    answer_.add(": ");
    name_range(info);
  }

  void name_range(const ParameterInfo& info) {
    answer_.add("allowed is ");
    answer_.add_number(info.lowest, info.decimal_places);
    answer_.add(" to ");
    answer_.add_number(info.highest, info.decimal_places);
  }

  void begin_listing(Listing listing) {
    listing_ = listing;
    listed_ = 0;
  }

  /// The next line of a listing.
  void list() {
    const auto& faults = unit_.supervisor().faults();
    const bool of_faults = listing_ == Listing::faults;
    if (listed_ == (of_faults ? faults.kept() : parameter_count)) {
      listing_ = Listing::none;
    }
    begin_answer();
    if (listing_ == Listing::none) {
      answer_.add(of_faults ? "faults since reset: " : "parameters: ");
      answer_.add_number(of_faults ? faults.count() : parameter_count);
    } else if (of_faults) {
      const FaultEntry& entry = faults.entry(listed_);
      answer_.add("period ");
      answer_.add_number(entry.period);
      answer_.add(": ");
      answer_.add(fault_name(entry.fault));
    } else {
      const ParameterInfo& info = unit_.info(listed_);
      name_value(listed_);
      answer_.add(", compiled in ");
      answer_.add_number(info.preset, info.decimal_places);
      answer_.add("; ");
      name_range(info);
    }
    end_answer();
    ++listed_;
  }

  void begin_answer() {
    answer_.clear();
    sent_ = 0;
  }
  void end_answer() {
    if (answer_.size() > 0) {
      answer_.add("\r\n");
    }
  }

  UnitT& unit_;
  ByteLink& bytes_;
  encoding::TextLine<most_line_characters> line_;
  encoding::TextLine<most_answer_characters> answer_;
  std::size_t sent_ = 0;
  std::size_t listed_ = 0;
  std::size_t setting_ = 0;
  Listing listing_ = Listing::none;
  bool too_long_ = false;
  bool saving_ = false;
};

}  // namespace sonoglide::app
