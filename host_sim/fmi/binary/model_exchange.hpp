/// What FMI 2.0 and 3.0 have alike for model exchange, but for the names of their types.
#pragma once

/// A line for each function.
/// @param each      a macro: (name, parameters)
/// @param fmi       fmi2 | fmi3, what the names begin with
/// @param Instance  the type of `instance`; Boolean, Real likewise
// NOLINTBEGIN(bugprone-macro-parentheses): a type is no expression.
// clang-format off
#define SONOGLIDE_FMI_MODEL_EXCHANGE(each, fmi, Instance, Boolean, Real)                          \
  each(fmi##EnterContinuousTimeMode, (Instance instance))                                         \
  each(fmi##CompletedIntegratorStep, (Instance instance, Boolean /*no_state_prior*/,              \
                                      Boolean* /*enter_event_mode*/, Boolean* /*terminate*/))     \
  each(fmi##SetTime, (Instance instance, Real /*time*/))                                          \
  each(fmi##SetContinuousStates, (Instance instance, const Real /*states*/[], std::size_t /*n*/)) \
  each(fmi##GetContinuousStates, (Instance instance, Real /*states*/[], std::size_t /*n*/))       \
  each(fmi##GetEventIndicators, (Instance instance, Real /*indicators*/[], std::size_t /*n*/))    \
  each(fmi##GetNominalsOfContinuousStates,                                                        \
       (Instance instance, Real /*nominals*/[], std::size_t /*n*/))
// clang-format on
// NOLINTEND(bugprone-macro-parentheses)
