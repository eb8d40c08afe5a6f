#include "host_sim/unit/unit_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <vector>

#include "firmware/app/parameter_labels.hpp"
#include "firmware/encoding/decimal.hpp"

namespace sonoglide::unit {

using app::parameter_labels;

std::string decimal(std::uint32_t value, int places) {
  std::array<char, encoding::most_decimal_characters> text{};
  return {text.data(), encoding::write_decimal(value, places, text.data())};
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
    case link::Reason::no_such_record:
    case link::Reason::unknown_request:
    case link::Reason::wrong_length:
    case link::Reason::no_such_fault:
    case link::Reason::out_of_turn:
      break;
  }
  return fmt::format("refused by the unit, reason {}", refusal.reason);
}

}  // namespace sonoglide::unit
