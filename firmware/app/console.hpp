/// A console for a terminal: one command a line, answers in words.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/app/mismatch.hpp"
#include "firmware/app/typed_ahead.hpp"
#include "firmware/app/unit.hpp"
#include "firmware/app/unit_names.hpp"
#include "firmware/encoding/decimal.hpp"

namespace sonoglide::app {

/// | command        | does                                                       |
/// |----------------|------------------------------------------------------------|
/// | status         | state, target, drive, limit, fault                         |
/// | target RATIO   | until reset                                                |
/// | stop           | drive to zero, at once; what was typed before it and waits is forgotten |
/// | restart        | from a stop or a fault                                     |
/// | confirm        | the parameters, where they were lost or of another design  |
/// | faults         | the latest first                                           |
/// | params         | each with what is allowed, and as compiled in              |
/// | set NAME VALUE | saved; needs a stop first                                  |
///
/// It greets after a reset, so that no reset goes unseen. Answers are made in pieces, a word and a
/// number at most, so that the work of a carrier period is bounded. Lines that come meanwhile wait,
/// as far as TypedAhead holds them. A line that ends with "stop" takes the drive to zero in the
/// period after its last character, whatever is being answered or saved. A fault cancels what was
/// typed before it and waits, and a line that is being typed. Every character is a sign of life.
///
/// @tparam ByteLink  see hal/board.hpp.
template <class UnitT, class ByteLink>
class Console {
 public:
  static constexpr std::size_t most_line_characters = 32;

  Console(UnitT& unit, ByteLink& bytes) : unit_(unit), bytes_(bytes) {}

  /// Once in each carrier period: receives one character. Besides it takes or sends one character,
  /// makes one piece of an answer, carries out one command, or takes one step of a save.
  void serve() {
    unit_.count_silence();
    heed_faults();
    receive();
    if (*text_ != '\0') {
      text_ += send(*text_) ? 1 : 0;
    } else if (digits_sent_ < digits_count_) {
      digits_sent_ += send(digits_[digits_sent_]) ? 1U : 0U;
    } else if (saving_) {
      finish_save(unit_.proceed());
    } else if (reply_ != Reply::none) {
      say_next();
    } else if (stopped_) {
      stopped_ = false;
      begin(Reply::status);
    } else if (line_ended_) {
      carry_out();
      begin_line();
    } else if (!typed_.empty()) {
      take(typed_.take());
    }
  }

 private:
  using Word = encoding::Characters;
  static constexpr std::size_t most_words = 3;

  enum class Reply : std::uint8_t {
    none,
    status,
    faults,
    parameters,
    range,
    saved,
    not_saved,
    confirmed,
    confirmed_until_reset,
    drive_not_stopped,
    not_confirmed,
    unknown_parameter,
    unknown_command,
    line_lost,
  };

  bool send(char character) { return bytes_.send(static_cast<std::uint8_t>(character)); }

  void heed_faults() {
    const std::uint32_t faults = unit_.supervisor().faults().count();
    if (faults != faults_ && (size_ > 0 || line_ended_ || typed_.waits())) {
      typed_.spoil();
      begin_line();
    }
    faults_ = faults;
  }

  // ---- The line that is typed; its words are found as they come ----

  void receive() {
    std::uint8_t byte = 0;
    if (!bytes_.receive(byte)) {
      return;
    }
    unit_.hear_host();
    const auto character = static_cast<char>(byte);
    if (stop_word_.take(character)) {
      unit_.stop();
      stopped_ = true;
      typed_.clear();
      begin_line();
    } else {
      typed_.put(character);
    }
  }

  void take(char character) {
    if (character == '\r' || character == '\n') {
      line_ended_ = true;
    } else if (size_ == most_line_characters || character == TypedAhead::spoilt) {
      line_lost_ = true;
    } else {
      append(character);
    }
  }

  void append(char character) {
    line_[size_] = character;
    const bool begins = character != ' ' && !in_word_;
    in_word_ = character != ' ';
    if (begins) {
      word_count_ += word_count_ <= most_words ? 1U : 0U;
      words_[word_count_ - 1] = {&line_[size_], 0};
    }
    words_[word_count_ > 0 ? word_count_ - 1 : 0].size += in_word_ ? 1U : 0U;
    ++size_;
  }

  void begin_line() {
    size_ = 0;
    word_count_ = 0;
    in_word_ = false;
    line_ended_ = false;
    line_lost_ = false;
  }

  // ---- Commands ----

  void carry_out() {
    if (line_lost_) {
      begin(Reply::line_lost);
    } else if (word_count_ == 1) {
      begin(carry_out(words_[0]));
    } else if (word_count_ == 2 && words_[0].are("target")) {
      begin(set_target(words_[1]));
    } else if (word_count_ == 3 && words_[0].are("set")) {
      begin(set(words_[1], words_[2]));
    } else if (word_count_ > 0) {
      begin(Reply::unknown_command);
    }
  }

  Reply carry_out(const Word& command) {
    if (command.are("faults")) {
      return Reply::faults;
    }
    if (command.are("params")) {
      return Reply::parameters;
    }
    if (command.are("confirm")) {
      return confirm();
    }
    if (command.are("restart")) {
      return unit_.restart() == Answer::taken ? Reply::status : Reply::not_confirmed;
    }
    return command.are("status") ? Reply::status : Reply::unknown_command;
  }

  Reply confirm() {
    confirming_ = unit_.confirm() == Answer::taken;
    saving_ = confirming_;
    return confirming_ ? Reply::none : Reply::drive_not_stopped;
  }

  Reply set_target(const Word& text) {
    parameter_ = static_cast<std::size_t>(Parameter::target);
    std::uint32_t ratio = 0;
    return read(text, ratio) && unit_.set_target(ratio) == Answer::taken ? Reply::status
                                                                         : Reply::range;
  }

  Reply set(const Word& name, const Word& text) {
    parameter_ = 0;
    while (parameter_ < parameter_count && !name.are(info().name)) {
      ++parameter_;
    }
    if (parameter_ == parameter_count) {
      return Reply::unknown_parameter;
    }
    std::uint32_t value = 0;
    if (!read(text, value)) {
      return Reply::range;
    }
    switch (unit_.write(parameter_, value)) {
      case Answer::taken:
        saving_ = true;
        confirming_ = false;
        return Reply::none;
      case Answer::drive_not_stopped:
      case Answer::parameters_not_confirmed:
        return Reply::drive_not_stopped;
      case Answer::unknown_parameter:
      case Answer::out_of_range:
        break;
    }
    return Reply::range;
  }

  void finish_save(store::Saving saving) {
    if (saving == store::Saving::busy) {
      return;
    }
    saving_ = false;
    if (saving == store::Saving::saved) {
      begin(confirming_ ? Reply::confirmed : Reply::saved);
    } else {
      begin(confirming_ ? Reply::confirmed_until_reset : Reply::not_saved);
    }
  }

  /// The text as a value of the parameter that is being set.
  bool read(const Word& text, std::uint32_t& value) const {
    return encoding::read_decimal(text.begin, text.size, info().decimal_places, value);
  }

  const ParameterInfo& info() const { return unit_.info(parameter_); }

  // ---- Answers ----

  void begin(Reply reply) {
    reply_ = reply;
    piece_ = 0;
    listed_ = 0;
    drive_ = unit_.supervisor().drive();
    period_ = unit_.supervisor().periods();
  }

  void say(const char* text) { text_ = text; }

  [[gnu::noinline]] void say(const char* text, std::uint32_t number, int places = 0) {
    text_ = text;
    digits_count_ = encoding::write_decimal(number, places, digits_.data());
    digits_sent_ = 0;
  }

  void say_last(const char* text) {
    text_ = text;
    reply_ = Reply::none;
  }

  /// The next piece of the answer.
  void say_next() {
    switch (reply_) {
      case Reply::status:
        say_status(piece_++);
        break;
      case Reply::faults:
        say_faults(piece_++);
        break;
      case Reply::parameters:
        say_parameters(piece_++);
        break;
      case Reply::range:
        say_range(piece_++);
        break;
      case Reply::saved:
        say_value(piece_++, ", saved\r\n");
        break;
      case Reply::not_saved:
        say_value(piece_++, " stands; not saved\r\n");
        break;
      case Reply::confirmed:
        say_last("parameters confirmed, saved\r\n");
        break;
      case Reply::confirmed_until_reset:
        say_last("parameters confirmed until reset; not saved\r\n");
        break;
      case Reply::drive_not_stopped:
        say_last("stop the drive first\r\n");
        break;
      case Reply::not_confirmed:
        say_last("see params, then confirm them or set one\r\n");
        break;
      case Reply::unknown_parameter:
        say_last("unknown; params lists what there is\r\n");
        break;
      case Reply::unknown_command:
        say_last(
            "unknown; there are: status, target RATIO, stop, restart, confirm, faults, params, set "
            "NAME VALUE\r\n");
        break;
      case Reply::line_lost:
        say_last("not done: the line is too long, it came too fast, or a fault came first\r\n");
        break;
      case Reply::none:
        break;
    }
  }

  void say_status(int piece) {
    switch (piece) {
      case 0:
        return say("state ");
      case 1:
        return say(control::name(static_cast<control::State>(drive_.state)));
      case 2:
        return say(", target ", unit_.target(), 6);
      case 3:
        return say(", drive ", millionths(drive_.amplitude), 6);
      case 4:
        return say(", limit ");
      case 5:
        return say(control::name(static_cast<control::Limit>(drive_.limit)));
      case 6:
        return say(judged() ? ", " : "");
      case 7:
        return say(judged() ? control::name(static_cast<control::Settling>(drive_.settling)) : "");
      case 8:
        return say_mismatch();
      case 9:
        return say(", fault ");
      case 10:
        return say(fault_name(drive_.fault));
      case 11:
        return say(", parameters ");
      case 12:
        return say(name(unit_.origin()));
      case 13:
        return say(", period ", period_);
      default:
        return say_last("\r\n");
    }
  }

  /// Whether the controller judges how the ratio stands to its target.
  bool judged() const {
    return drive_.settling != static_cast<std::uint8_t>(control::Settling::pending);
  }

  /// Where it is known.
  void say_mismatch() {
    const std::uint32_t mismatch = mismatch_thousandths(drive_, unit_.target());
    return mismatch > 0 ? say(", nominal/true friction ", mismatch, 3) : say("");
  }

  /// @param amplitude  code, 0 … 2^31 − 1.
  static std::uint32_t millionths(std::int32_t amplitude) {
    const auto scaled = static_cast<std::uint64_t>(amplitude) * one_in_millionths;
    return static_cast<std::uint32_t>((scaled + (1U << 30)) >> 31);
  }

  void say_faults(int piece) {
    const auto& faults = unit_.supervisor().faults();
    if (listed_ >= faults.kept()) {
      return piece == 0 ? say("faults since reset: ", faults.count()) : say_last("\r\n");
    }
    const FaultEntry& entry = faults.entry(listed_);
    switch (piece) {
      case 0:
        return say("period ", entry.period);
      case 1:
        return say(": ");
      case 2:
        return say(fault_name(entry.fault));
      default:
        return say_next_line();
    }
  }

  void say_parameters(int piece) {
    parameter_ = listed_;
    switch (piece) {
      case 0:
      case 1:
        return say_value(piece, "");
      case 2:
        return say(", compiled in ", info().preset, info().decimal_places);
      case 3:
        return say("; allowed is ", info().lowest, info().decimal_places);
      case 4:
        return say(" to ", info().highest, info().decimal_places);
      case 5:
        return say(info().unit);
      default:
        return listed_ + 1 < parameter_count ? say_next_line() : say_last("\r\n");
    }
  }

  void say_range(int piece) {
    switch (piece) {
      case 0:
        return say(info().name);
      case 1:
        return say(": allowed is ", info().lowest, info().decimal_places);
      case 2:
        return say(" to ", info().highest, info().decimal_places);
      default:
        return say_last("\r\n");
    }
  }

  void say_value(int piece, const char* end) {
    switch (piece) {
      case 0:
        return say(info().name);
      case 1:
        return say(" ", unit_.value(parameter_), info().decimal_places);
      default:
        return say_last(end);
    }
  }

  void say_next_line() {
    say("\r\n");
    ++listed_;
    piece_ = 0;
  }

  UnitT& unit_;
  ByteLink& bytes_;

  StopWord stop_word_;
  TypedAhead typed_;
  bool stopped_ = false;      ///< on request, and that is not yet answered
  std::uint32_t faults_ = 0;  ///< since reset, in the last period
  std::array<char, most_line_characters> line_{};
  std::size_t size_ = 0;
  std::array<Word, most_words + 1> words_{};  ///< one more than a command has
  std::size_t word_count_ = 0;
  bool in_word_ = false;
  bool line_ended_ = false;
  bool line_lost_ = false;
  bool saving_ = false;
  bool confirming_ = false;  ///< what is saved was confirmed, not set

  Reply reply_ = Reply::none;
  int piece_ = 0;
  hal::Drive drive_{};  ///< of the period that the answer tells of
  std::uint32_t period_ = 0;
  std::size_t listed_ = 0;                  ///< line of a list
  std::size_t parameter_ = 0;               ///< that is spoken of
  const char* text_ = "\r\nsonoglide\r\n";  ///< still to be sent, and after it the digits
  std::array<char, encoding::most_decimal_characters> digits_{};
  std::size_t digits_count_ = 0;
  std::size_t digits_sent_ = 0;
};

}  // namespace sonoglide::app
