/// One finished point as a line of the journal.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "host_sim/studies/sweep/row.hpp"

namespace sonoglide::sweep {

struct Record {
  std::size_t point = 0;
  Row row;
};

/// `CHECKSUM TEXT`, without the end of the line: the checksum of TEXT in 16 hexadecimal digits.
/// @param text  one line
std::string sealed(std::string_view text);

/// The TEXT of such a line; absent if the checksum is not that of TEXT.
std::optional<std::string_view> unsealed(std::string_view line);

/// A record as TEXT. Numbers keep every bit.
std::string record_text(const Record& record);

/// Absent if the text is not that of a record.
std::optional<Record> parse_record(std::string_view text);

}  // namespace sonoglide::sweep
