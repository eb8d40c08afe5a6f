/// A strip chart in the terminal, drawn as the samples of a stream come.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "firmware/link/stream_messages.hpp"
#include "host_sim/boards/unit/unit_scales.hpp"

namespace sonoglide::unit {

/// Time goes downwards: each sample is a row with its period, its value and a mark at its place between 0, of a
/// velocity the full scale backwards, and the full scale. What lies beyond is at the edge, `<` or `>`.
class LivePlot {
 public:
  /// @param channel  that the stream has, with a full scale
  /// @param scales   of the unit; outlives this
  LivePlot(link::Channel channel, const UnitScales& scales);

  /// Ten samples a second, as far as the line permits.
  link::Stream stream() const;

  std::string heading() const;
  std::string row(const link::Streamed& sample) const;

 private:
  std::size_t channel_;
  const UnitScales& scales_;
  double low_;
  double high_;
};

/// @return nothing unless the stream has exactly one channel, and that has a number
std::optional<LivePlot> plot_of(const link::Stream& stream, const UnitScales& scales);

}  // namespace sonoglide::unit
