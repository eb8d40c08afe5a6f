#include "host_sim/studies/sweep/row.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>

#include "host_sim/long_work/record_text.hpp"

namespace sonoglide::sweep {
namespace {

constexpr std::array<double PointResult::*, 6> figure_members = {
    &PointResult::friction_ratio_whole_run,
    &PointResult::friction_ratio_window,
    &PointResult::dissipation_ratio_window,
    &PointResult::settling_time_s,
    &PointResult::steady_error,
    &PointResult::ripple};

}  // namespace

std::string record_text(const Record& record) {
  std::string text = fmt::format("{} ", record.point);
  for (const auto figure : figure_members) {
    text += long_work::bits_text(record.row.*figure) + ' ';
  }
  return text + fmt::format("{} {} {}", static_cast<unsigned>(record.row.limit),
                            static_cast<unsigned>(record.row.fault), record.row.status);
}

std::optional<Record> parse_record(std::string_view text) {
  constexpr auto last_fault = static_cast<std::uint64_t>(control::Fault::velocity_stuck);
  long_work::RecordNumbers numbers(text);
  Record record{static_cast<std::size_t>(numbers.whole()), {}};
  for (const auto figure : figure_members) {
    record.row.*figure = numbers.real();
  }
  const std::uint64_t limit = numbers.whole();
  const std::uint64_t fault = numbers.whole();
  if (!numbers.good() || limit >= control::limit_count || fault > last_fault) {
    return std::nullopt;
  }
  record.row.limit = static_cast<control::Limit>(limit);
  record.row.fault = static_cast<control::Fault>(fault);
  record.row.status = std::string(numbers.rest());
  return record;
}

}  // namespace sonoglide::sweep
