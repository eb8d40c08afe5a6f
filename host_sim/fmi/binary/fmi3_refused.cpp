/// The functions of FMI 3.0 for what the description of the model says that there is none. Importers
/// look for all functions of the header. Each logs and answers error.
#include <cstddef>

#include "host_sim/fmi/binary/fmi3_call.hpp"

namespace sonoglide::fmi {
namespace {

constexpr const char* event_mode = "event mode";
constexpr const char* model_exchange = "model exchange";
constexpr const char* structural_parameters = "structural parameters";
constexpr const char* clocks = "clocks";

fmi3Status refused(fmi3Instance instance, const char* what) {
  return attempt(instance, [what](const Instance& /*each*/) { refuse(what); });
}

/// Of a type that no variable has.
fmi3Status none_of(fmi3Instance instance, const char* type, std::size_t n) {
  return n == 0 ? attempt(instance, [](const Instance& /*each*/) {}) : refused(instance, type);
}

fmi3Instance no_instance(fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                         const char* what) {
  tell_refusal(log_of(environment, log), what);
  return nullptr;
}

}  // namespace
}  // namespace sonoglide::fmi

using namespace sonoglide::fmi;

fmi3Instance fmi3InstantiateModelExchange(fmi3String /*name*/, fmi3String /*token*/,
                                          fmi3String /*resource_path*/, fmi3Boolean /*visible*/,
                                          fmi3Boolean /*logging_on*/,
                                          fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback log) {
  return no_instance(environment, log, model_exchange);
}

fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String /*name*/, fmi3String /*token*/, fmi3String /*resource_path*/,
    fmi3Boolean /*visible*/, fmi3Boolean /*logging_on*/, fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log, fmi3ClockUpdateCallback /*clock_update*/,
    fmi3LockPreemptionCallback /*lock*/, fmi3UnlockPreemptionCallback /*unlock*/) {
  return no_instance(environment, log, "scheduled execution");
}

#define SONOGLIDE_FMI3_NONE(Type)                                                                 \
  fmi3Status fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference /*references*/[],      \
                           std::size_t n, fmi3##Type /*values*/[], std::size_t /*count*/) {       \
    return none_of(instance, #Type, n);                                                           \
  }                                                                                               \
  fmi3Status fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference /*references*/[],      \
                           std::size_t n, const fmi3##Type /*values*/[], std::size_t /*count*/) { \
    return none_of(instance, #Type, n);                                                           \
  }
SONOGLIDE_FMI3_NONE(Int8)
SONOGLIDE_FMI3_NONE(UInt8)
SONOGLIDE_FMI3_NONE(Int16)
SONOGLIDE_FMI3_NONE(UInt16)
SONOGLIDE_FMI3_NONE(UInt32)
SONOGLIDE_FMI3_NONE(Int64)
SONOGLIDE_FMI3_NONE(UInt64)
SONOGLIDE_FMI3_NONE(Boolean)
#undef SONOGLIDE_FMI3_NONE

fmi3Status fmi3SetString(fmi3Instance instance, const fmi3ValueReference /*references*/[],
                         std::size_t n, const fmi3String /*values*/[], std::size_t /*count*/) {
  return none_of(instance, "String that can be set", n);
}

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference /*references*/[],
                         std::size_t n, std::size_t /*sizes*/[], fmi3Binary /*values*/[],
                         std::size_t /*value_count*/) {
  return none_of(instance, "Binary", n);
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference /*references*/[],
                         std::size_t n, const std::size_t /*sizes*/[],
                         const fmi3Binary /*values*/[], std::size_t /*value_count*/) {
  return none_of(instance, "Binary", n);
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance,
                                        const fmi3ValueReference /*unknowns*/[],
                                        std::size_t /*unknown_count*/,
                                        const fmi3ValueReference /*knowns*/[],
                                        std::size_t /*known_count*/, const fmi3Float64 /*seed*/[],
                                        std::size_t /*seed_count*/, fmi3Float64 /*sensitivity*/[],
                                        std::size_t /*sensitivity_count*/) {
  return refused(instance, "directional derivatives");
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference /*unknowns*/[],
                                    std::size_t /*unknown_count*/,
                                    const fmi3ValueReference /*knowns*/[],
                                    std::size_t /*known_count*/, const fmi3Float64 /*seed*/[],
                                    std::size_t /*seed_count*/, fmi3Float64 /*sensitivity*/[],
                                    std::size_t /*sensitivity_count*/) {
  return refused(instance, "adjoint derivatives");
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance,
                                    const fmi3ValueReference /*references*/[], std::size_t /*n*/,
                                    const fmi3Int32 /*orders*/[], fmi3Float64 /*values*/[],
                                    std::size_t /*value_count*/) {
  return refused(instance, "derivatives of outputs");
}

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference /*references*/[],
                        std::size_t n, fmi3Clock /*values*/[]) {
  return none_of(instance, "Clock", n);
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference /*references*/[],
                        std::size_t n, const fmi3Clock /*values*/[]) {
  return none_of(instance, "Clock", n);
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference /*references*/[],
                                  std::size_t /*n*/, fmi3Float64 /*intervals*/[],
                                  fmi3IntervalQualifier /*qualifiers*/[]) {
  return refused(instance, clocks);
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance instance, const fmi3ValueReference /*references*/[],
                                   std::size_t /*n*/, fmi3UInt64 /*counters*/[],
                                   fmi3UInt64 /*resolutions*/[],
                                   fmi3IntervalQualifier /*qualifiers*/[]) {
  return refused(instance, clocks);
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance instance, const fmi3ValueReference /*references*/[],
                               std::size_t /*n*/, fmi3Float64 /*shifts*/[]) {
  return refused(instance, clocks);
}

fmi3Status fmi3GetShiftFraction(fmi3Instance instance, const fmi3ValueReference /*references*/[],
                                std::size_t /*n*/, fmi3UInt64 /*counters*/[],
                                fmi3UInt64 /*resolutions*/[]) {
  return refused(instance, clocks);
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference /*references*/[],
                                  std::size_t /*n*/, const fmi3Float64 /*intervals*/[]) {
  return refused(instance, clocks);
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance instance, const fmi3ValueReference /*references*/[],
                                   std::size_t /*n*/, const fmi3UInt64 /*counters*/[],
                                   const fmi3UInt64 /*resolutions*/[]) {
  return refused(instance, clocks);
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance instance, const fmi3ValueReference /*references*/[],
                               std::size_t /*n*/, const fmi3Float64 /*shifts*/[]) {
  return refused(instance, clocks);
}

fmi3Status fmi3SetShiftFraction(fmi3Instance instance, const fmi3ValueReference /*references*/[],
                                std::size_t /*n*/, const fmi3UInt64 /*counters*/[],
                                const fmi3UInt64 /*resolutions*/[]) {
  return refused(instance, clocks);
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference /*clock*/,
                                      fmi3Float64 /*time*/) {
  return refused(instance, clocks);
}

fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance) {
  return refused(instance, structural_parameters);
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance) {
  return refused(instance, structural_parameters);
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
  return refused(instance, event_mode);
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
  return refused(instance, event_mode);
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance) {
  return refused(instance, event_mode);
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean* /*needs_update*/,
                                    fmi3Boolean* /*terminate*/, fmi3Boolean* /*nominals_changed*/,
                                    fmi3Boolean* /*values_changed*/,
                                    fmi3Boolean* /*next_event_time_defined*/,
                                    fmi3Float64* /*next_event_time*/) {
  return refused(instance, event_mode);
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 /*derivatives*/[],
                                             std::size_t /*n*/) {
  return refused(instance, model_exchange);
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, std::size_t* /*n*/) {
  return refused(instance, model_exchange);
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, std::size_t* /*n*/) {
  return refused(instance, model_exchange);
}

#define SONOGLIDE_REFUSED(name, parameters)   \
  fmi3Status name parameters {                \
    return refused(instance, model_exchange); \
  }
SONOGLIDE_FMI_MODEL_EXCHANGE(SONOGLIDE_REFUSED, fmi3, fmi3Instance, fmi3Boolean, fmi3Float64)
#undef SONOGLIDE_REFUSED
