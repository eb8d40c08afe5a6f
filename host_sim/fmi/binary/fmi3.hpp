/// Functional Mock-up Interface 3.0: all functions of its header.
///
/// Source: Modelica Association, Functional Mock-up Interface Specification 3.0, sections 2.2, 3.2, 4.2 and 5.2.
/// Declared here after the text of the specification; types and names are the specification's.
#pragma once

#include <cstddef>
#include <cstdint>

#include "host_sim/fmi/binary/interface.hpp"

using fmi3Instance = void*;
using fmi3InstanceEnvironment = void*;
using fmi3FMUState = void*;
using fmi3ValueReference = std::uint32_t;
using fmi3Float32 = float;
using fmi3Float64 = double;
using fmi3Int8 = std::int8_t;
using fmi3UInt8 = std::uint8_t;
using fmi3Int16 = std::int16_t;
using fmi3UInt16 = std::uint16_t;
using fmi3Int32 = std::int32_t;
using fmi3UInt32 = std::uint32_t;
using fmi3Int64 = std::int64_t;
using fmi3UInt64 = std::uint64_t;
using fmi3Boolean = bool;
using fmi3String = const char*;
using fmi3Byte = std::uint8_t;
using fmi3Binary = const fmi3Byte*;
using fmi3Clock = bool;

// NOLINTBEGIN(readability-identifier-naming): the names are those of the specification.
enum fmi3Status { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal };
enum fmi3DependencyKind {
  fmi3Independent,
  fmi3Constant,
  fmi3Fixed,
  fmi3Tunable,
  fmi3Discrete,
  fmi3Dependent
};
enum fmi3IntervalQualifier { fmi3IntervalNotYetKnown, fmi3IntervalUnchanged, fmi3IntervalChanged };

using fmi3LogMessageCallback = void (*)(fmi3InstanceEnvironment environment, fmi3Status status,
                                        fmi3String category, fmi3String message);
using fmi3IntermediateUpdateCallback = void (*)(fmi3InstanceEnvironment environment,
                                                fmi3Float64 time, fmi3Boolean set_requested,
                                                fmi3Boolean get_allowed, fmi3Boolean step_finished,
                                                fmi3Boolean can_return_early,
                                                fmi3Boolean* early_return_requested,
                                                fmi3Float64* early_return_time);
using fmi3ClockUpdateCallback = void (*)(fmi3InstanceEnvironment environment);
using fmi3LockPreemptionCallback = void (*)();
using fmi3UnlockPreemptionCallback = void (*)();

// Whoever asks, and what with.
SONOGLIDE_FMI const char* fmi3GetVersion();
SONOGLIDE_FMI fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean logging_on,
                                             std::size_t count, const fmi3String categories[]);

// Creation and destruction.
SONOGLIDE_FMI fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token,
                                                        fmi3String resource_path,
                                                        fmi3Boolean visible, fmi3Boolean logging_on,
                                                        fmi3InstanceEnvironment environment,
                                                        fmi3LogMessageCallback log);
SONOGLIDE_FMI fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String resource_path, fmi3Boolean visible,
    fmi3Boolean logging_on, fmi3Boolean event_mode_used, fmi3Boolean early_return_allowed,
    const fmi3ValueReference intermediate_variables[], std::size_t count,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
    fmi3IntermediateUpdateCallback update);
SONOGLIDE_FMI fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String name, fmi3String token, fmi3String resource_path, fmi3Boolean visible,
    fmi3Boolean logging_on, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
    fmi3ClockUpdateCallback clock_update, fmi3LockPreemptionCallback lock,
    fmi3UnlockPreemptionCallback unlock);
SONOGLIDE_FMI void fmi3FreeInstance(fmi3Instance instance);

// The way from one mode to the next.
SONOGLIDE_FMI fmi3Status fmi3EnterInitializationMode(fmi3Instance instance,
                                                     fmi3Boolean tolerance_defined,
                                                     fmi3Float64 tolerance, fmi3Float64 start_time,
                                                     fmi3Boolean stop_time_defined,
                                                     fmi3Float64 stop_time);
SONOGLIDE_FMI fmi3Status fmi3ExitInitializationMode(fmi3Instance instance);
SONOGLIDE_FMI fmi3Status fmi3Terminate(fmi3Instance instance);
SONOGLIDE_FMI fmi3Status fmi3Reset(fmi3Instance instance);

// Values. n of them are wanted, and as many numbers handed over, for no variable is an array.
#define SONOGLIDE_FMI3_VALUES(Type)                                                            \
  SONOGLIDE_FMI fmi3Status fmi3Get##Type(fmi3Instance instance,                                \
                                         const fmi3ValueReference references[], std::size_t n, \
                                         fmi3##Type values[], std::size_t value_count);        \
  SONOGLIDE_FMI fmi3Status fmi3Set##Type(fmi3Instance instance,                                \
                                         const fmi3ValueReference references[], std::size_t n, \
                                         const fmi3##Type values[], std::size_t value_count);
SONOGLIDE_FMI3_VALUES(Float32)
SONOGLIDE_FMI3_VALUES(Float64)
SONOGLIDE_FMI3_VALUES(Int32)
#undef SONOGLIDE_FMI3_VALUES
SONOGLIDE_FMI fmi3Status fmi3GetString(fmi3Instance instance, const fmi3ValueReference references[],
                                       std::size_t n, fmi3String values[], std::size_t value_count);

// What depends on what.
SONOGLIDE_FMI fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance,
                                                             fmi3ValueReference reference,
                                                             std::size_t* count);
SONOGLIDE_FMI fmi3Status fmi3GetVariableDependencies(fmi3Instance instance,
                                                     fmi3ValueReference dependent,
                                                     std::size_t dependent_elements[],
                                                     fmi3ValueReference independents[],
                                                     std::size_t independent_elements[],
                                                     fmi3DependencyKind kinds[], std::size_t count);

// State.
SONOGLIDE_FMI fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* state);
SONOGLIDE_FMI fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state);
SONOGLIDE_FMI fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState* state);
SONOGLIDE_FMI fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state,
                                                    std::size_t* size);
SONOGLIDE_FMI fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state,
                                               fmi3Byte bytes[], std::size_t size);
SONOGLIDE_FMI fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[],
                                                 std::size_t size, fmi3FMUState* state);

// Co-simulation.
SONOGLIDE_FMI fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 point, fmi3Float64 size,
                                    fmi3Boolean no_state_prior, fmi3Boolean* event_needed,
                                    fmi3Boolean* terminate, fmi3Boolean* early_return,
                                    fmi3Float64* last_time);

// What there is none of; where the number of elements is 0, nothing is asked for.
// clang-format off
#define SONOGLIDE_FMI3_NO_NUMBERS(each, Type)                                                     \
  each(fmi3Get##Type, #Type,                                                                      \
       (fmi3Instance instance, const fmi3ValueReference /*references*/[], std::size_t n,          \
        fmi3##Type /*values*/[], std::size_t /*value_count*/))                                    \
  each(fmi3Set##Type, #Type,                                                                      \
       (fmi3Instance instance, const fmi3ValueReference /*references*/[], std::size_t n,          \
        const fmi3##Type /*values*/[], std::size_t /*value_count*/))
#define SONOGLIDE_FMI3_NO_VALUES(each)                                                            \
  SONOGLIDE_FMI3_NO_NUMBERS(each, Int8)                                                           \
  SONOGLIDE_FMI3_NO_NUMBERS(each, UInt8)                                                          \
  SONOGLIDE_FMI3_NO_NUMBERS(each, Int16)                                                          \
  SONOGLIDE_FMI3_NO_NUMBERS(each, UInt16)                                                         \
  SONOGLIDE_FMI3_NO_NUMBERS(each, UInt32)                                                         \
  SONOGLIDE_FMI3_NO_NUMBERS(each, Int64)                                                          \
  SONOGLIDE_FMI3_NO_NUMBERS(each, UInt64)                                                         \
  SONOGLIDE_FMI3_NO_NUMBERS(each, Boolean)                                                        \
  each(fmi3SetString, "String that can be set",                                                   \
       (fmi3Instance instance, const fmi3ValueReference /*references*/[], std::size_t n,          \
        const fmi3String /*values*/[], std::size_t /*value_count*/))                              \
  each(fmi3GetBinary, "Binary",                                                                   \
       (fmi3Instance instance, const fmi3ValueReference /*references*/[], std::size_t n,          \
        std::size_t /*sizes*/[], fmi3Binary /*values*/[], std::size_t /*value_count*/))           \
  each(fmi3SetBinary, "Binary",                                                                   \
       (fmi3Instance instance, const fmi3ValueReference /*references*/[], std::size_t n,          \
        const std::size_t /*sizes*/[], const fmi3Binary /*values*/[],                             \
        std::size_t /*value_count*/))                                                             \
  each(fmi3GetClock, "Clock",                                                                     \
       (fmi3Instance instance, const fmi3ValueReference /*references*/[], std::size_t n,          \
        fmi3Clock /*values*/[]))                                                                  \
  each(fmi3SetClock, "Clock",                                                                     \
       (fmi3Instance instance, const fmi3ValueReference /*references*/[], std::size_t n,          \
        const fmi3Clock /*values*/[]))
#define SONOGLIDE_FMI3_NO_SENSITIVITY(each, name, what)                                           \
  each(name, what,                                                                                \
       (fmi3Instance instance, const fmi3ValueReference /*unknowns*/[],                           \
        std::size_t /*unknown_count*/, const fmi3ValueReference /*knowns*/[],                     \
        std::size_t /*known_count*/, const fmi3Float64 /*seed*/[], std::size_t /*seed_count*/,    \
        fmi3Float64 /*sensitivity*/[], std::size_t /*sensitivity_count*/))
#define SONOGLIDE_FMI3_REFUSED(each)                                                              \
  SONOGLIDE_FMI_MODEL_EXCHANGE(each, fmi3, fmi3Instance, fmi3Boolean, fmi3Float64)                \
  each(fmi3GetContinuousStateDerivatives, "model exchange",                                       \
       (fmi3Instance instance, fmi3Float64 /*derivatives*/[], std::size_t /*n*/))                 \
  each(fmi3GetNumberOfEventIndicators, "model exchange",                                          \
       (fmi3Instance instance, std::size_t* /*n*/))                                               \
  each(fmi3GetNumberOfContinuousStates, "model exchange",                                         \
       (fmi3Instance instance, std::size_t* /*n*/))                                               \
  SONOGLIDE_FMI3_NO_SENSITIVITY(each, fmi3GetDirectionalDerivative, "directional derivatives")    \
  SONOGLIDE_FMI3_NO_SENSITIVITY(each, fmi3GetAdjointDerivative, "adjoint derivatives")            \
  each(fmi3GetOutputDerivatives, "derivatives of outputs",                                        \
       (fmi3Instance instance, const fmi3ValueReference /*references*/[], std::size_t /*n*/,      \
        const fmi3Int32 /*orders*/[], fmi3Float64 /*values*/[], std::size_t /*value_count*/))     \
  each(fmi3GetIntervalDecimal, "clocks",                                                          \
       (fmi3Instance instance, const fmi3ValueReference /*references*/[], std::size_t /*n*/,      \
        fmi3Float64 /*intervals*/[], fmi3IntervalQualifier /*qualifiers*/[]))                     \
  each(fmi3GetIntervalFraction, "clocks",                                                         \
       (fmi3Instance instance, const fmi3ValueReference /*references*/[], std::size_t /*n*/,      \
        fmi3UInt64 /*counters*/[], fmi3UInt64 /*resolutions*/[],                                  \
        fmi3IntervalQualifier /*qualifiers*/[]))                                                  \
  each(fmi3GetShiftDecimal, "clocks",                                                             \
       (fmi3Instance instance, const fmi3ValueReference /*references*/[], std::size_t /*n*/,      \
        fmi3Float64 /*shifts*/[]))                                                                \
  each(fmi3GetShiftFraction, "clocks",                                                            \
       (fmi3Instance instance, const fmi3ValueReference /*references*/[], std::size_t /*n*/,      \
        fmi3UInt64 /*counters*/[], fmi3UInt64 /*resolutions*/[]))                                 \
  each(fmi3SetIntervalDecimal, "clocks",                                                          \
       (fmi3Instance instance, const fmi3ValueReference /*references*/[], std::size_t /*n*/,      \
        const fmi3Float64 /*intervals*/[]))                                                       \
  each(fmi3SetIntervalFraction, "clocks",                                                         \
       (fmi3Instance instance, const fmi3ValueReference /*references*/[], std::size_t /*n*/,      \
        const fmi3UInt64 /*counters*/[], const fmi3UInt64 /*resolutions*/[]))                     \
  each(fmi3SetShiftDecimal, "clocks",                                                             \
       (fmi3Instance instance, const fmi3ValueReference /*references*/[], std::size_t /*n*/,      \
        const fmi3Float64 /*shifts*/[]))                                                          \
  each(fmi3SetShiftFraction, "clocks",                                                            \
       (fmi3Instance instance, const fmi3ValueReference /*references*/[], std::size_t /*n*/,      \
        const fmi3UInt64 /*counters*/[], const fmi3UInt64 /*resolutions*/[]))                     \
  each(fmi3ActivateModelPartition, "clocks",                                                      \
       (fmi3Instance instance, fmi3ValueReference /*clock*/, fmi3Float64 /*time*/))               \
  each(fmi3EnterConfigurationMode, "structural parameters", (fmi3Instance instance))              \
  each(fmi3ExitConfigurationMode, "structural parameters", (fmi3Instance instance))               \
  each(fmi3EnterEventMode, "event mode", (fmi3Instance instance))                                 \
  each(fmi3EnterStepMode, "event mode", (fmi3Instance instance))                                  \
  each(fmi3EvaluateDiscreteStates, "event mode", (fmi3Instance instance))                         \
  each(fmi3UpdateDiscreteStates, "event mode",                                                    \
       (fmi3Instance instance, fmi3Boolean* /*needs_update*/, fmi3Boolean* /*terminate*/,         \
        fmi3Boolean* /*nominals_changed*/, fmi3Boolean* /*values_changed*/,                       \
        fmi3Boolean* /*next_event_time_defined*/, fmi3Float64* /*next_event_time*/))
// clang-format on
#define SONOGLIDE_DECLARED(name, what, parameters) SONOGLIDE_FMI fmi3Status name parameters;
SONOGLIDE_FMI3_NO_VALUES(SONOGLIDE_DECLARED)
SONOGLIDE_FMI3_REFUSED(SONOGLIDE_DECLARED)
#undef SONOGLIDE_DECLARED
// NOLINTEND(readability-identifier-naming)
