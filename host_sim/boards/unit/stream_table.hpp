/// A stream of a unit as a table: a row for each sample.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/link/stream_messages.hpp"
#include "host_sim/boards/unit/unit_scales.hpp"

namespace sonoglide::unit {

/// The stream that a line of words asks for: names of channels, then `every N` or nothing, which is every
/// step; or `off`.
/// @return nothing where a word is none of these
std::optional<link::Stream> stream_of(const std::vector<std::string>& words);

/// The names of the channels, a comma and a blank between them.
std::string channel_names();

/// The heading of its column, with the unit; `state,limit,fault,settling` of the codes.
std::string column_of(link::Channel channel, const UnitScales& scales);

/// In SI units; the codes as they are.
double value_of(link::Channel channel, std::uint32_t value, const UnitScales& scales);

/// The largest value that is usual; 0 of the codes.
double full_scale_of(link::Channel channel, const UnitScales& scales);

/// State, limit, fault and settling.
std::array<std::string, 4> names_of_codes(std::uint32_t codes);
/// The same, a comma between them.
std::string text_of_codes(std::uint32_t codes);

/// Counts the samples that are left out.
class StreamTable {
 public:
  /// @param scales  of the unit; outlives this
  explicit StreamTable(const UnitScales& scales) : scales_(scales) {}

  /// Begins anew.
  /// @return names of the columns
  std::string begin(const link::Stream& stream);

  std::string row(const link::Streamed& sample);

  std::size_t lost() const { return lost_; }

 private:
  const UnitScales& scales_;
  std::uint16_t next_ = 0;
  std::size_t lost_ = 0;
};

}  // namespace sonoglide::unit
