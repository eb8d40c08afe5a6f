/// A request that a unit has to carry out.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <variant>

#include "host_sim/process/pipe.hpp"
#include "host_sim/unit/unit_link.hpp"
#include "host_sim/unit/unit_scales.hpp"
#include "host_sim/unit/unit_words.hpp"

namespace sonoglide::unit {

/// The unit answers, but refuses what it is asked, or has stopped by a fault.
class UnitRefusal : public process::ProcessError {
 public:
  explicit UnitRefusal(const std::string& words, bool out_of_range = false)
      : ProcessError(words), out_of_range_(out_of_range) {}

  /// Of a value that the unit does not have: what() has its range.
  bool out_of_range() const { return out_of_range_; }

 private:
  bool out_of_range_;
};

/// @param parameter  of the value that is asked for
/// @param work       of the unit, before it answers
/// @throws process::ProcessError  the unit does not answer
/// @throws UnitRefusal            it refuses
template <class Answer, class Request>
Answer require(UnitLink& unit, const UnitScales& scales, const Request& request,
               std::size_t parameter = 0, std::chrono::milliseconds work = {}) {
  const auto result = unit.ask<Answer>(request, work);
  if (const auto* refusal = std::get_if<link::Refusal>(&result)) {
    throw UnitRefusal("the unit refuses: " + words_of(*refusal, parameter, scales),
                      static_cast<link::Reason>(refusal->reason) == link::Reason::out_of_range);
  }
  return std::get<Answer>(result);
}

}  // namespace sonoglide::unit
