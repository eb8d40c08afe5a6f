/// A record of finished work as one line of text: numbers with every bit, and a checksum.
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace sonoglide::long_work {

/// `CHECKSUM TEXT`, without the end of the line: the checksum of TEXT in 16 hexadecimal digits.
/// @param text  one line
std::string sealed(std::string_view text);

/// The TEXT of such a line; absent if the checksum is not that of TEXT.
std::optional<std::string_view> unsealed(std::string_view line);

/// The next line of a file, without its end.
/// @return false where there is no whole one, or one that is longer than any of this program's
bool next_line(std::ifstream& file, std::string& line);

/// Every bit of a number, in hexadecimal digits.
std::string bits_text(double value);

/// Takes the numbers of a text one after the other, a blank behind each.
class RecordNumbers {
 public:
  explicit RecordNumbers(std::string_view text) : rest_(text) {}

  std::uint64_t whole();  ///< decimal
  double real();          ///< bits_text()

  /// Whether all were there so far.
  bool good() const { return good_; }
  std::string_view rest() const { return rest_; }

 private:
  std::uint64_t next(int base);

  std::string_view rest_;
  bool good_ = true;
};

}  // namespace sonoglide::long_work
