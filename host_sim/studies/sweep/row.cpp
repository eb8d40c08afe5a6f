#include "host_sim/studies/sweep/row.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>

#include "host_sim/process/checksum.hpp"

namespace sonoglide::sweep {
namespace {

constexpr std::size_t checksum_digits = 16;
constexpr std::array<double PointResult::*, 6> figure_members = {
    &PointResult::friction_ratio_whole_run,
    &PointResult::friction_ratio_window,
    &PointResult::dissipation_ratio_window,
    &PointResult::settling_time_s,
    &PointResult::steady_error,
    &PointResult::ripple};

std::uint64_t bits_of(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

double from_bits(std::uint64_t bits) {
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// Takes the numbers of a text one after the other.
class Numbers {
 public:
  explicit Numbers(std::string_view text) : rest_(text) {}

  /// Up to the next blank, which goes too.
  std::uint64_t next(int base) {
    std::uint64_t value = 0;
    const auto [end, error] =
        std::from_chars(rest_.data(), rest_.data() + rest_.size(), value, base);
    const auto length = static_cast<std::size_t>(end - rest_.data());
    good_ = good_ && error == std::errc() && length < rest_.size() && rest_[length] == ' ';
    rest_.remove_prefix(good_ ? length + 1 : rest_.size());
    return value;
  }

  bool good() const { return good_; }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  bool good_ = true;
};

}  // namespace

std::string sealed(std::string_view text) {
  return fmt::format("{:016x} {}", process::checksum(text), text);
}

std::optional<std::string_view> unsealed(std::string_view line) {
  if (line.size() <= checksum_digits) {
    return std::nullopt;
  }
  const std::string_view text = line.substr(checksum_digits + 1);
  if (line.substr(0, checksum_digits + 1) != fmt::format("{:016x} ", process::checksum(text))) {
    return std::nullopt;
  }
  return text;
}

std::string record_text(const Record& record) {
  std::string text = fmt::format("{} ", record.point);
  for (const auto figure : figure_members) {
    text += fmt::format("{:x} ", bits_of(record.row.*figure));
  }
  return text + fmt::format("{} {} {}", static_cast<unsigned>(record.row.limit),
                            static_cast<unsigned>(record.row.fault), record.row.status);
}

std::optional<Record> parse_record(std::string_view text) {
  constexpr int decimal = 10;
  constexpr int hexadecimal = 16;
  constexpr auto last_fault = static_cast<std::uint64_t>(control::Fault::measurement_implausible);
  Numbers numbers(text);
  Record record{static_cast<std::size_t>(numbers.next(decimal)), {}};
  for (const auto figure : figure_members) {
    record.row.*figure = from_bits(numbers.next(hexadecimal));
  }
  const std::uint64_t limit = numbers.next(decimal);
  const std::uint64_t fault = numbers.next(decimal);
  if (!numbers.good() || limit >= control::limit_count || fault > last_fault) {
    return std::nullopt;
  }
  record.row.limit = static_cast<control::Limit>(limit);
  record.row.fault = static_cast<control::Fault>(fault);
  record.row.status = std::string(numbers.rest());
  return record;
}

}  // namespace sonoglide::sweep
