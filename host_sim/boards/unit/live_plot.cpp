#include "host_sim/boards/unit/live_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "host_sim/boards/unit/stream_table.hpp"

namespace sonoglide::unit {
namespace {

constexpr std::size_t width = 60;

}  // namespace

LivePlot::LivePlot(link::Channel channel, const UnitScales& scales)
    : channel_(static_cast<std::size_t>(channel)),
      scales_(scales),
      low_(channel == link::Channel::sliding_velocity ? -full_scale_of(channel, scales) : 0.0),
      high_(full_scale_of(channel, scales)) {}

link::Stream LivePlot::stream() const {
  constexpr double interval_s = 0.1;
  return {static_cast<std::uint8_t>(1U << channel_),
          static_cast<std::uint16_t>(
              std::clamp(std::round(interval_s / scales_.step_s()), 1.0, double{UINT16_MAX}))};
}

std::string LivePlot::heading() const {
  return fmt::format("{:>10} {:>25} |{:<{}}{:>{}}|", "period",
                     column_of(static_cast<link::Channel>(channel_), scales_),
                     fmt::format("{:.4g}", low_), width / 2, fmt::format("{:.4g}", high_),
                     width / 2);
}

std::string LivePlot::row(const link::Streamed& sample) const {
  const double value =
      value_of(static_cast<link::Channel>(channel_), sample.values.at(channel_), scales_);
  const double place = (value - low_) / (high_ - low_);
  const char* const mark = place < 0.0 ? "<" : place > 1.0 ? ">" : "*";
  const auto column =
      static_cast<std::size_t>(std::lround(std::clamp(place, 0.0, 1.0) * (width - 1)));
  return fmt::format("{:>10} {:>25.6g} |{:>{}}{:{}}|", sample.period, value, mark, column + 1, "",
                     width - 1 - column);
}

std::optional<LivePlot> plot_of(const link::Stream& stream, const UnitScales& scales) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(link::Channel::codes); ++i) {
    if (stream.channels == 1U << i) {
      return LivePlot(static_cast<link::Channel>(i), scales);
    }
  }
  return std::nullopt;
}

}  // namespace sonoglide::unit
