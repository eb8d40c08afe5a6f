/// Functional Mock-up Interface 2.0: all functions of its headers.
///
/// Source: Modelica Association, Functional Mock-up Interface Specification 2.0.4, sections 2.1, 3.2
/// and 4.2. Declared here after the text of the specification; types and names are the specification's.
#pragma once

#include <cstddef>

#include "host_sim/fmi/binary/interface.hpp"

using fmi2Component = void*;
using fmi2ComponentEnvironment = void*;
using fmi2FMUstate = void*;
using fmi2ValueReference = unsigned int;
using fmi2Real = double;
using fmi2Integer = int;
using fmi2Boolean = int;
using fmi2Char = char;
using fmi2String = const fmi2Char*;
using fmi2Byte = char;

// NOLINTBEGIN(readability-identifier-naming): the names are those of the specification.
enum fmi2Status { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending };
enum fmi2Type { fmi2ModelExchange, fmi2CoSimulation };
enum fmi2StatusKind { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated };

using fmi2CallbackLogger = void (*)(fmi2ComponentEnvironment environment, fmi2String name,
                                    fmi2Status status, fmi2String category, fmi2String message,
                                    ...);
using fmi2CallbackAllocateMemory = void* (*)(std::size_t count, std::size_t size);
using fmi2CallbackFreeMemory = void (*)(void* memory);
using fmi2StepFinished = void (*)(fmi2ComponentEnvironment environment, fmi2Status status);

struct fmi2CallbackFunctions {
  fmi2CallbackLogger logger;
  fmi2CallbackAllocateMemory allocateMemory;
  fmi2CallbackFreeMemory freeMemory;
  fmi2StepFinished stepFinished;
  fmi2ComponentEnvironment componentEnvironment;
};

struct fmi2EventInfo {
  fmi2Boolean newDiscreteStatesNeeded;
  fmi2Boolean terminateSimulation;
  fmi2Boolean nominalsOfContinuousStatesChanged;
  fmi2Boolean valuesOfContinuousStatesChanged;
  fmi2Boolean nextEventTimeDefined;
  fmi2Real nextEventTime;
};

SONOGLIDE_FMI const char* fmi2GetTypesPlatform();
SONOGLIDE_FMI const char* fmi2GetVersion();
SONOGLIDE_FMI fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean logging_on,
                                             std::size_t count, const fmi2String categories[]);

SONOGLIDE_FMI fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid,
                                            fmi2String resource_location,
                                            const fmi2CallbackFunctions* functions,
                                            fmi2Boolean visible, fmi2Boolean logging_on);
SONOGLIDE_FMI void fmi2FreeInstance(fmi2Component component);

SONOGLIDE_FMI fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean tolerance_defined,
                                             fmi2Real tolerance, fmi2Real start_time,
                                             fmi2Boolean stop_time_defined, fmi2Real stop_time);
SONOGLIDE_FMI fmi2Status fmi2EnterInitializationMode(fmi2Component component);
SONOGLIDE_FMI fmi2Status fmi2ExitInitializationMode(fmi2Component component);
SONOGLIDE_FMI fmi2Status fmi2Terminate(fmi2Component component);
SONOGLIDE_FMI fmi2Status fmi2Reset(fmi2Component component);

SONOGLIDE_FMI fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference references[],
                                     std::size_t n, fmi2Real values[]);
SONOGLIDE_FMI fmi2Status fmi2GetInteger(fmi2Component component,
                                        const fmi2ValueReference references[], std::size_t n,
                                        fmi2Integer values[]);
SONOGLIDE_FMI fmi2Status fmi2GetString(fmi2Component component,
                                       const fmi2ValueReference references[], std::size_t n,
                                       fmi2String values[]);
SONOGLIDE_FMI fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference references[],
                                     std::size_t n, const fmi2Real values[]);
SONOGLIDE_FMI fmi2Status fmi2SetInteger(fmi2Component component,
                                        const fmi2ValueReference references[], std::size_t n,
                                        const fmi2Integer values[]);

SONOGLIDE_FMI fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate* state);
SONOGLIDE_FMI fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state);
SONOGLIDE_FMI fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate* state);
SONOGLIDE_FMI fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate state,
                                                    std::size_t* size);
SONOGLIDE_FMI fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate state,
                                               fmi2Byte bytes[], std::size_t size);
SONOGLIDE_FMI fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte bytes[],
                                                 std::size_t size, fmi2FMUstate* state);

SONOGLIDE_FMI fmi2Status fmi2DoStep(fmi2Component component, fmi2Real point, fmi2Real size,
                                    fmi2Boolean no_state_prior);
SONOGLIDE_FMI fmi2Status fmi2GetRealStatus(fmi2Component component, fmi2StatusKind kind,
                                           fmi2Real* value);
SONOGLIDE_FMI fmi2Status fmi2GetBooleanStatus(fmi2Component component, fmi2StatusKind kind,
                                              fmi2Boolean* value);

// What there is none of; where the number of elements is 0, nothing is asked for.
// clang-format off
#define SONOGLIDE_FMI2_NO_VALUES(each)                                                            \
  each(fmi2GetBoolean, "Boolean",                                                                 \
       (fmi2Component instance, const fmi2ValueReference /*references*/[], std::size_t n,         \
        fmi2Boolean /*values*/[]))                                                                \
  each(fmi2SetBoolean, "Boolean",                                                                 \
       (fmi2Component instance, const fmi2ValueReference /*references*/[], std::size_t n,         \
        const fmi2Boolean /*values*/[]))                                                          \
  each(fmi2SetString, "String that can be set",                                                   \
       (fmi2Component instance, const fmi2ValueReference /*references*/[], std::size_t n,         \
        const fmi2String /*values*/[]))                                                           \
  each(fmi2SetRealInputDerivatives, "derivatives of inputs",                                      \
       (fmi2Component instance, const fmi2ValueReference /*references*/[], std::size_t n,         \
        const fmi2Integer /*orders*/[], const fmi2Real /*values*/[]))                             \
  each(fmi2GetRealOutputDerivatives, "derivatives of outputs",                                    \
       (fmi2Component instance, const fmi2ValueReference /*references*/[], std::size_t n,         \
        const fmi2Integer /*orders*/[], fmi2Real /*values*/[]))
#define SONOGLIDE_FMI2_REFUSED(each)                                                              \
  SONOGLIDE_FMI_MODEL_EXCHANGE(each, fmi2, fmi2Component, fmi2Boolean, fmi2Real)                  \
  each(fmi2EnterEventMode, "model exchange", (fmi2Component instance))                            \
  each(fmi2NewDiscreteStates, "model exchange",                                                   \
       (fmi2Component instance, fmi2EventInfo* /*info*/))                                         \
  each(fmi2GetDerivatives, "model exchange",                                                      \
       (fmi2Component instance, fmi2Real /*derivatives*/[], std::size_t /*n*/))                   \
  each(fmi2GetDirectionalDerivative, "directional derivatives",                                   \
       (fmi2Component instance, const fmi2ValueReference /*unknowns*/[],                          \
        std::size_t /*unknown_count*/, const fmi2ValueReference /*knowns*/[],                     \
        std::size_t /*known_count*/, const fmi2Real /*known_changes*/[],                          \
        fmi2Real /*unknown_changes*/[]))                                                          \
  each(fmi2CancelStep, "steps in the background", (fmi2Component instance))                       \
  each(fmi2GetStatus, "steps in the background",                                                  \
       (fmi2Component instance, fmi2StatusKind /*kind*/, fmi2Status* /*value*/))                  \
  each(fmi2GetIntegerStatus, "such a status",                                                     \
       (fmi2Component instance, fmi2StatusKind /*kind*/, fmi2Integer* /*value*/))                 \
  each(fmi2GetStringStatus, "steps in the background",                                            \
       (fmi2Component instance, fmi2StatusKind /*kind*/, fmi2String* /*value*/))
// clang-format on
#define SONOGLIDE_DECLARED(name, what, parameters) SONOGLIDE_FMI fmi2Status name parameters;
SONOGLIDE_FMI2_NO_VALUES(SONOGLIDE_DECLARED)
SONOGLIDE_FMI2_REFUSED(SONOGLIDE_DECLARED)
#undef SONOGLIDE_DECLARED
// NOLINTEND(readability-identifier-naming)
