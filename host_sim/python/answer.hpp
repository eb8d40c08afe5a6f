/// What a controller answers, with the words of its state.
#pragma once

#include <pybind11/pybind11.h>

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/control/interface/names.hpp"
#include "hal/board.hpp"

namespace sonoglide::python {

inline void add_answer(pybind11::dict& fields, const hal::Drive& answer) {
  fields["amplitude_code"] = answer.amplitude;
  fields["commanded_ratio_code"] = answer.commanded_ratio;
  fields["state"] = control::name(static_cast<control::State>(answer.state));
  fields["limit"] = control::name(static_cast<control::Limit>(answer.limit));
  fields["fault"] = control::name(static_cast<control::Fault>(answer.fault));
  fields["settling"] = control::name(static_cast<control::Settling>(answer.settling));
}

/// The words of the numbers 0 to `last`.
template <class Word>
pybind11::tuple words_to(Word last) {
  const auto count = static_cast<std::size_t>(last) + 1;
  pybind11::tuple words(count);
  for (std::size_t i = 0; i < count; ++i) {
    words[i] = control::name(static_cast<Word>(i));
  }
  return words;
}

}  // namespace sonoglide::python
