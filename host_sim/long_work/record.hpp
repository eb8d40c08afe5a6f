/// A finished point as one line of text: numbers with every bit, and a checksum.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "host_sim/process/pipe.hpp"

namespace sonoglide::long_work {

/// `CHECKSUM TEXT`, without the end of the line: the checksum of TEXT in 16 hexadecimal digits.
/// @param text  one line
std::string sealed(std::string_view text);

/// The TEXT of such a line; absent if the checksum is not that of TEXT.
std::optional<std::string_view> unsealed(std::string_view line);

/// The next line of a file, without its end.
/// @return false where there is no whole one, or one that is longer than any of this program's
bool next_line(std::ifstream& file, std::string& line);

/// Writes all of it, signals or no.
/// @param path  of the file
/// @throws process::FileError
void write_all(const process::Descriptor& file, const std::filesystem::path& path,
               std::string_view text);

/// A number with a blank behind it: every bit in hexadecimal digits; a whole one in decimal digits.
std::string number_text(double value);
std::string number_text(std::uint64_t value);

/// Takes the numbers of a text one after the other, a blank behind each.
class RecordNumbers {
 public:
  explicit RecordNumbers(std::string_view text) : rest_(text) {}

  std::uint64_t whole();
  double real();

  /// Whether all were there so far.
  bool good() const { return good_; }
  std::string_view rest() const { return rest_; }

 private:
  std::uint64_t next(int base);

  std::string_view rest_;
  bool good_ = true;
};

/// What a record says, to those who do not know what it is of.
struct RecordFacts {
  std::uint64_t point;
  bool failed;  ///< the point could not be computed
};

struct FinishedPoint {
  std::uint64_t point;
  std::string record;  ///< one line
};

/// Takes the record of a point; false if it is none.
using TakeRecord = std::function<bool(std::uint64_t point, const std::string& record)>;

/// A point of a study with its row: a struct with
///   kept         a tuple of the members that a record holds, numbers or enumerations
///   status       `ok`, or why the point could not be computed: the end of the record
///   ok()         whether it could
///   plausible()  whether the values of the enumerations exist
template <class Row>
struct Record {
  std::size_t point = 0;
  Row row;
};

template <class Row>
std::string record_text(const Record<Row>& record) {
  std::string text = number_text(std::uint64_t{record.point});
  const auto add = [&](const auto& value) {
    if constexpr (std::is_floating_point_v<std::decay_t<decltype(value)>>) {
      text += number_text(value);
    } else {
      text += number_text(static_cast<std::uint64_t>(value));
    }
  };
  std::apply([&](const auto... member) { (add(record.row.*member), ...); }, Row::kept);
  return text + record.row.status;
}

/// Absent if the text is not that of a record.
template <class Row>
std::optional<Record<Row>> parse_record(std::string_view text) {
  RecordNumbers numbers(text);
  Record<Row> record;
  record.point = static_cast<std::size_t>(numbers.whole());
  bool fits = true;
  const auto take = [&](auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_floating_point_v<Value>) {
      value = numbers.real();
    } else {
      const std::uint64_t number = numbers.whole();
      value = static_cast<Value>(number);
      fits = fits && static_cast<std::uint64_t>(value) == number;
    }
  };
  std::apply([&](const auto... member) { (take(record.row.*member), ...); }, Row::kept);
  record.row.status = std::string(numbers.rest());
  return numbers.good() && fits && !record.row.status.empty() && record.row.plausible()
             ? std::optional(std::move(record))
             : std::nullopt;
}

template <class Row>
std::optional<RecordFacts> record_facts(std::string_view text) {
  const auto record = parse_record<Row>(text);
  return record ? std::optional<RecordFacts>({record->point, !record->row.ok()}) : std::nullopt;
}

template <class Row>
std::vector<FinishedPoint> finished_points(const std::vector<Record<Row>>& records) {
  std::vector<FinishedPoint> points;
  points.reserve(records.size());
  for (const Record<Row>& record : records) {
    points.push_back({record.point, record_text(record)});
  }
  return points;
}

/// Hands on the point and the row of each record.
template <class Row>
TakeRecord rows_to(std::function<void(std::size_t point, Row row)> take) {
  return [take = std::move(take)](std::uint64_t point, const std::string& text) {
    std::optional<Record<Row>> record = parse_record<Row>(text);
    if (!record || record->point != point) {
      return false;
    }
    take(record->point, std::move(record->row));
    return true;
  };
}

}  // namespace sonoglide::long_work
