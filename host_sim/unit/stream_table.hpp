/// A stream of a unit as a table: a row for each sample.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/link/stream_messages.hpp"

namespace sonoglide::unit {

/// The stream that a line of words asks for: names of channels, then `every N` or nothing, which is every
/// step; or `off`.
/// @return nothing where a word is none of these
std::optional<link::Stream> stream_of(const std::vector<std::string>& words);

/// The names of the channels, a comma and a blank between them.
std::string channel_names();

/// A number that a code of full scale 2^31 stands for, exactly, in as few digits as it can be read back from.
std::string text_of_code(std::uint32_t code);

/// State, limit, fault and settling, a comma between them.
std::string text_of_codes(std::uint32_t codes);

/// Counts the samples that are left out.
class StreamTable {
 public:
  /// Begins anew.
  /// @return names of the columns
  std::string begin(const link::Stream& stream);

  std::string row(const link::Streamed& sample);

  std::size_t lost() const { return lost_; }

 private:
  std::uint16_t next_ = 0;
  std::size_t lost_ = 0;
};

}  // namespace sonoglide::unit
