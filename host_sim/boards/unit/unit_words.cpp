#include "host_sim/boards/unit/unit_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <vector>

#include "firmware/app/parameter_labels.hpp"
#include "firmware/app/unit_names.hpp"
#include "firmware/encoding/decimal.hpp"
#include "hal/kept_exception.hpp"
#include "hal/reset_cause.hpp"
#include "host_sim/output/number.hpp"
#include "host_sim/process/printable.hpp"

namespace sonoglide::unit {

using app::parameter_labels;

namespace {

/// To six digits.
std::string text_of(double value, link::ScaleUnit unit) {
  return unit == link::ScaleUnit::none
             ? "none"
             : output::plain_zero(fmt::format("{:.6g}", value)) + unit_name(unit).behind_number;
}

}  // namespace

const char* cause_name(std::uint8_t cause) {
  switch (static_cast<hal::ResetCause>(cause)) {
    case hal::ResetCause::power_on:
      return "power-on";
    case hal::ResetCause::reset:
      return "a reset";
    case hal::ResetCause::watchdog:
      return "a reset by the watchdog";
    case hal::ResetCause::exception:
      return "an exception";
    case hal::ResetCause::crystal:
      return "a failure of the crystal";
  }
  return "a cause that is not known";
}

std::string decimal(std::uint32_t value, int places) {
  std::array<char, encoding::most_decimal_characters> text{};
  return {text.data(), encoding::write_decimal(value, places, text.data())};
}

bool is_number(const std::string& text) {
  const std::size_t sign = text.rfind('-', 0) == 0 ? 1 : 0;
  const auto points = std::count(text.begin(), text.end(), '.');
  const auto digits =
      std::count_if(text.begin(), text.end(), [](char each) { return '0' <= each && each <= '9'; });
  return digits > 0 && points <= 1 &&
         sign + static_cast<std::size_t>(digits + points) == text.size();
}

double number_of(const std::string& text) {
  double number = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

std::size_t parameter_named(const std::string& name) {
  std::size_t i = 0;
  while (i < app::parameter_count && name != parameter_labels[i].name) {
    ++i;
  }
  return i;
}

std::string board_of(const link::Identity& told) {
  return {told.board.begin(), std::find(told.board.begin(), told.board.end(), '\0')};
}

std::string words_of(const link::Refusal& refusal, std::size_t parameter,
                     const UnitScales& scales) {
  switch (static_cast<link::Reason>(refusal.reason)) {
    case link::Reason::out_of_range:
      return fmt::format("{}: allowed is {} to {}{}", parameter_labels[parameter].name,
                         scales.text_of_parameter(parameter, refusal.lowest),
                         scales.text_of_parameter(parameter, refusal.highest),
                         scales.unit_of_parameter(parameter));
    case link::Reason::unknown_parameter: {
      std::vector<std::string> names;
      names.reserve(std::size(parameter_labels));
      for (const app::ParameterLabel& label : parameter_labels) {
        names.emplace_back(label.name);
      }
      return fmt::format("unknown parameter; there are: {}", fmt::join(names, ", "));
    }
    case link::Reason::drive_not_stopped:
      return "stop the drive first";
    case link::Reason::not_saved:
      return "not saved: the flash of the unit took nothing; the old value stands";
    case link::Reason::parameters_not_confirmed:
      return "see params, then confirm them or set one";
    case link::Reason::overtaken_by_fault:
      return "not done: a fault came first";
    case link::Reason::self_test_failed:
      return "the image in the unit's flash is damaged: load it again";
    case link::Reason::tripped:
      return "the board's hardware holds the drive off, status has its fault: remove the cause";
    case link::Reason::no_such_record:
    case link::Reason::unknown_request:
    case link::Reason::wrong_length:
    case link::Reason::no_such_fault:
    case link::Reason::out_of_turn:
      break;
  }
  return fmt::format("refused by the unit, reason {}", refusal.reason);
}

ReadValue read_value(const std::string& text, std::size_t parameter, const UnitScales& scales) {
  if (!is_number(text)) {
    return {0, fmt::format("\"{}\" is no number", text)};
  }
  if (scales.is_force(parameter)) {
    const double force_N = number_of(text);
    return {scales.count_of_parameter(parameter, force_N), ""};
  }
  const int places = parameter_labels[parameter].decimal_places;
  const bool negative = text.front() == '-';
  const std::string digits = text.substr(negative ? 1 : 0);
  const std::size_t point = digits.find('.');
  const std::string fraction = point == std::string::npos ? "" : digits.substr(point);
  if (fraction.find_last_not_of('0') + 1 > static_cast<std::size_t>(places) + 1) {
    return {0, places == 0 ? fmt::format("\"{}\" is no whole number", text)
                           : fmt::format("\"{}\" has more than {} decimal places", text, places)};
  }
  std::uint32_t count = UINT32_MAX;
  encoding::read_decimal(digits.data(), digits.size(), places, count);
  return {negative && count > 0 ? UINT32_MAX : count, ""};
}

std::string range_of(const link::ParameterValue& value, const UnitScales& scales) {
  return fmt::format("{} to {}{}", scales.text_of_parameter(value.parameter, value.lowest),
                     scales.text_of_parameter(value.parameter, value.highest),
                     scales.unit_of_parameter(value.parameter));
}

std::string text_of(const link::ParameterValue& value, const UnitScales& scales) {
  const char* const unit = scales.unit_of_parameter(value.parameter);
  return fmt::format(
      "{} {}{}, compiled in {}{}; allowed is {}", parameter_labels[value.parameter].name,
      scales.text_of_parameter(value.parameter, value.value), unit,
      scales.text_of_parameter(value.parameter, value.preset), unit, range_of(value, scales));
}

std::string text_of(const link::Telemetry& told, const UnitScales& scales) {
  constexpr auto amplitude = link::Quantity::amplitude;
  std::string text =
      fmt::format("state {}, target {}{}, drive {}, limit {}",
                  control::name(static_cast<control::State>(told.state)),
                  scales.text_of_parameter(target_parameter, told.target),
                  scales.unit_of_parameter(target_parameter),
                  text_of(scales.value_of(amplitude, static_cast<std::uint32_t>(told.amplitude)),
                          scales[amplitude].unit),
                  control::name(static_cast<control::Limit>(told.limit)));
  if (const auto settling = static_cast<control::Settling>(told.settling);
      settling != control::Settling::pending) {
    text += fmt::format(", {}", control::name(settling));
  }
  if (told.mismatch > 0) {
    text += ", nominal/true friction " + decimal(told.mismatch, 3);
  }
  text += fmt::format(", fault {}, parameters {}, period {}", app::fault_name(told.fault),
                      app::name(static_cast<store::Origin>(told.parameters)), told.period);
  if (told.lost_frames > 0) {
    text += fmt::format(", frames lost {}", told.lost_frames);
  }
  return text;
}

std::string text_of(const UnitScales& scales) {
  const auto text = [&](link::Quantity quantity) {
    return text_of(scales[quantity].value, scales[quantity].unit);
  };
  return fmt::format("full scale of force {}, velocity {}, drive {}, bias {}; a step every {}",
                     text(link::Quantity::friction_force), text(link::Quantity::sliding_velocity),
                     text(link::Quantity::amplitude), text(link::Quantity::bias),
                     output::quantity(scales.step_s(), "s"));
}

std::string text_of(const link::Identity& told) {
  const std::string board = board_of(told);
  return fmt::format("{}firmware {}.{}.{}, design {:#010x}, serial number {}",
                     board.empty() ? "" : process::printable(board) + ", ", told.major_number,
                     told.minor_number, told.patch_number, told.design,
                     told.serial_number == 0 ? "none" : std::to_string(told.serial_number));
}

std::string text_of(const link::History& told) {
  return fmt::format(
      "boot {}, after {}; in operation {} h {} min {} s; boots after the watchdog {}, after an "
      "exception {}{}{}",
      told.boots, cause_name(told.cause), told.seconds / 3600, told.seconds / 60 % 60,
      told.seconds % 60, told.watchdog_resets, told.exceptions,
      told.began_anew == 0 ? "" : "; began anew: the history before it could not be read",
      told.saved != 0 ? "" : "; not saved: the flash of the unit took nothing");
}

std::string text_of(const link::KeptException& told, const std::string& before) {
  const hal::KeptException exception = hal::exception_of(told.words);
  std::string text;
  hal::KeptException::visit_words(exception, [&](std::string name, std::uint32_t word) {
    if (text.empty()) {
      text = fmt::format("{} {} before {}: ", name, word, before);
      return;
    }
    std::replace(name.begin(), name.end(), '_', ' ');
    text += fmt::format("{}{} {:#010x}", text.back() == ' ' ? "" : ", ", name, word);
  });
  return text;
}

}  // namespace sonoglide::unit
