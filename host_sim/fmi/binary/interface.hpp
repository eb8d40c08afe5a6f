/// What the headers of FMI 2.0 and 3.0 have alike.
#pragma once

/// A function that an importer finds in the shared library; everything else is hidden.
#if defined(_WIN32)
#define SONOGLIDE_FMI extern "C" __declspec(dllexport)
#else
#define SONOGLIDE_FMI extern "C" __attribute__((visibility("default")))
#endif

/// Functions for what the description of the model says that there is none, a line for each. Importers
/// look for all functions of the headers; each of these logs what is missing and answers error.
/// @param each      a macro: (name, what is missing, parameters)
/// @param fmi       fmi2 | fmi3, what the names begin with
/// @param Instance  the type of `instance`; Boolean, Real likewise
// NOLINTBEGIN(bugprone-macro-parentheses): a type is no expression.
// clang-format off
#define SONOGLIDE_FMI_MODEL_EXCHANGE(each, fmi, Instance, Boolean, Real)                          \
  each(fmi##EnterContinuousTimeMode, "model exchange", (Instance instance))                       \
  each(fmi##CompletedIntegratorStep, "model exchange",                                            \
       (Instance instance, Boolean /*no_state_prior*/, Boolean* /*enter_event_mode*/,             \
        Boolean* /*terminate*/))                                                                  \
  each(fmi##SetTime, "model exchange", (Instance instance, Real /*time*/))                        \
  each(fmi##SetContinuousStates, "model exchange",                                                \
       (Instance instance, const Real /*states*/[], std::size_t /*n*/))                           \
  each(fmi##GetContinuousStates, "model exchange",                                                \
       (Instance instance, Real /*states*/[], std::size_t /*n*/))                                 \
  each(fmi##GetEventIndicators, "model exchange",                                                 \
       (Instance instance, Real /*indicators*/[], std::size_t /*n*/))                             \
  each(fmi##GetNominalsOfContinuousStates, "model exchange",                                      \
       (Instance instance, Real /*nominals*/[], std::size_t /*n*/))
// clang-format on
// NOLINTEND(bugprone-macro-parentheses)
