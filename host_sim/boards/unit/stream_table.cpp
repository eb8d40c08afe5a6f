#include "host_sim/boards/unit/stream_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "firmware/app/unit_names.hpp"
#include "firmware/control/interface/names.hpp"
#include "firmware/encoding/decimal.hpp"

namespace sonoglide::unit {
namespace {

constexpr std::array<const char*, link::channel_count> channel_words = {
    "friction_force", "sliding_velocity", "amplitude", "commanded_ratio", "target", "state"};

/// Full scale of `commanded_ratio`.
constexpr double full_ratio = 2.0;

std::string text_of(std::size_t channel, std::uint32_t value, const UnitScales& scales) {
  const auto shown = static_cast<link::Channel>(channel);
  return shown == link::Channel::codes ? text_of_codes(value)
                                       : fmt::format("{}", value_of(shown, value, scales));
}

}  // namespace

std::string column_of(link::Channel channel, const UnitScales& scales) {
  switch (channel) {
    case link::Channel::friction_force:
      return scales.column_of(link::Quantity::friction_force);
    case link::Channel::sliding_velocity:
      return scales.column_of(link::Quantity::sliding_velocity);
    case link::Channel::amplitude:
      return scales.column_of(link::Quantity::amplitude);
    case link::Channel::target:
      return scales.column_of(link::Quantity::target);
    case link::Channel::commanded_ratio:
      return "commanded_ratio";
    case link::Channel::codes:
      break;
  }
  return "state,limit,fault,settling";
}

double value_of(link::Channel channel, std::uint32_t value, const UnitScales& scales) {
  switch (channel) {
    case link::Channel::friction_force:
      return scales.value_of(link::Quantity::friction_force, value);
    case link::Channel::sliding_velocity:
      return scales.value_of(link::Quantity::sliding_velocity, value);
    case link::Channel::amplitude:
      return scales.value_of(link::Quantity::amplitude, value);
    case link::Channel::target:
      return scales.target_of(value);
    case link::Channel::commanded_ratio:
      return static_cast<std::int32_t>(value) * 0x1p-31 * full_ratio;
    case link::Channel::codes:
      break;
  }
  return value;
}

double full_scale_of(link::Channel channel, const UnitScales& scales) {
  switch (channel) {
    case link::Channel::friction_force:
      return scales[link::Quantity::friction_force].value;
    case link::Channel::sliding_velocity:
      return scales[link::Quantity::sliding_velocity].value;
    case link::Channel::amplitude:
      return scales[link::Quantity::amplitude].value;
    case link::Channel::target:
      return scales[link::Quantity::target].value;
    case link::Channel::commanded_ratio:
      return 1.0;
    case link::Channel::codes:
      break;
  }
  return 0.0;
}

std::optional<link::Stream> stream_of(const std::vector<std::string>& words) {
  link::Stream stream{0, 1};
  if (words.size() == 1 && words[0] == "off") {
    return stream;
  }
  std::size_t names_given = words.size();
  if (words.size() > 2 && words[words.size() - 2] == "every") {
    names_given -= 2;
    const std::string& number = words.back();
    const auto [end, error] =
        std::from_chars(number.data(), number.data() + number.size(), stream.every);
    if (error != std::errc() || end != number.data() + number.size() || stream.every == 0) {
      return std::nullopt;
    }
  }
  for (std::size_t i = 0; i < names_given; ++i) {
    const auto* const name = std::find(channel_words.begin(), channel_words.end(), words[i]);
    if (name == channel_words.end()) {
      return std::nullopt;
    }
    stream.channels |= static_cast<std::uint8_t>(1U << (name - channel_words.begin()));
  }
  return stream.channels == 0 ? std::nullopt : std::optional(stream);
}

std::string channel_names() {
  return fmt::format("{}", fmt::join(channel_words, ", "));
}

std::array<std::string, 4> names_of_codes(std::uint32_t codes) {
  return {control::name(static_cast<control::State>(codes & 0xFF)),
          control::name(static_cast<control::Limit>(codes >> 8 & 0xFF)),
          app::fault_name(static_cast<std::uint8_t>(codes >> 16)),
          control::name(static_cast<control::Settling>(codes >> 24))};
}

std::string text_of_codes(std::uint32_t codes) {
  return fmt::format("{}", fmt::join(names_of_codes(codes), ","));
}

std::string StreamTable::begin(const link::Stream& stream) {
  next_ = 0;
  lost_ = 0;
  std::string columns = "number,period";
  for (std::size_t i = 0; i < link::channel_count; ++i) {
    if ((stream.channels >> i & 1U) != 0) {
      columns += "," + column_of(static_cast<link::Channel>(i), scales_);
    }
  }
  return columns;
}

std::string StreamTable::row(const link::Streamed& sample) {
  lost_ += static_cast<std::uint16_t>(sample.number - next_);
  next_ = static_cast<std::uint16_t>(sample.number + 1);
  std::string row = fmt::format("{},{}", sample.number, sample.period);
  for (std::size_t i = 0; i < link::channel_count; ++i) {
    if (sample.has(i)) {
      row += "," + text_of(i, sample.values.at(i), scales_);
    }
  }
  return row;
}

}  // namespace sonoglide::unit
