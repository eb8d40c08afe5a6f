/// A request that a unit has to carry out.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>

#include "host_sim/boards/unit/unit_link.hpp"
#include "host_sim/boards/unit/unit_scales.hpp"
#include "host_sim/boards/unit/unit_words.hpp"
#include "host_sim/process/pipe.hpp"

namespace sonoglide::unit {

/// The unit answers, but refuses what it is asked, or has stopped by a fault.
class UnitRefusal : public process::ProcessError {
 public:
  explicit UnitRefusal(const std::string& words, std::optional<link::Reason> reason = std::nullopt)
      : ProcessError(words), reason_(reason) {}

  bool has_reason(link::Reason reason) const { return reason_ == reason; }

 private:
  std::optional<link::Reason> reason_;
};

/// @param parameter  of the value that was asked for
/// @throws UnitRefusal  the unit refuses
template <class Answer>
Answer taken(const UnitLink::Result<Answer>& result, const UnitScales& scales,
             std::size_t parameter = 0) {
  if (const auto* refusal = std::get_if<link::Refusal>(&result)) {
    throw UnitRefusal(words_of(*refusal, parameter, scales),
                      static_cast<link::Reason>(refusal->reason));
  }
  return std::get<Answer>(result);
}

/// @param work  of the unit, before it answers
/// @throws process::ProcessError  the unit does not answer
/// @throws UnitRefusal            it refuses
template <class Answer, class Request>
Answer require(UnitLink& unit, const UnitScales& scales, const Request& request,
               std::size_t parameter = 0, std::chrono::milliseconds work = {}) {
  return taken<Answer>(unit.ask<Answer>(request, work), scales, parameter);
}

/// As require(); absent where the unit keeps no such thing, or there has been none.
template <class Answer, class Request>
std::optional<Answer> ask_if_kept(UnitLink& unit, const UnitScales& scales,
                                  const Request& request) try {
  return require<Answer>(unit, scales, request);
} catch (const UnitRefusal& refusal) {
  if (refusal.has_reason(link::Reason::unknown_request) ||
      refusal.has_reason(link::Reason::no_such_fault)) {
    return std::nullopt;
  }
  throw;
}

}  // namespace sonoglide::unit
