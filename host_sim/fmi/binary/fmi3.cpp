#include "host_sim/fmi/binary/fmi3.hpp"

#include <cstring>
#include <memory>
#include <string>
#include <type_traits>

#include "host_sim/fmi/binary/component.hpp"

namespace sonoglide::fmi {
namespace {

fmi3Status status_of(Status status) {
  return static_cast<fmi3Status>(status);
}

template <class Call>
fmi3Status attempt(fmi3Instance instance, const Call& call) {
  if (instance == nullptr) {
    return fmi3Error;
  }
  return status_of(static_cast<Component*>(instance)->attempt(call));
}

[[noreturn]] void refuse(const char* what) {
  throw CallError(std::string(what) + ": this FMU has none");
}

/// For what the description of the model says that there is none.
fmi3Status refused(fmi3Instance instance, const char* what) {
  return attempt(instance, [what](Instance&) { refuse(what); });
}

void require_type(const Variable& variable, Type type, const char* name) {
  if (variable.type() != type) {
    throw CallError(variable.name + " is no " + name);
  }
}

void require_as_many(std::size_t references, std::size_t values) {
  if (references != values) {
    throw CallError("there are not as many values as value references; no variable is an array");
  }
}

template <class Number>
constexpr Type type_of() {
  if constexpr (std::is_same_v<Number, double>) {
    return Type::float64;
  } else if constexpr (std::is_same_v<Number, float>) {
    return Type::float32;
  } else {
    static_assert(std::is_same_v<Number, std::int32_t>);
    return Type::int32;
  }
}

template <class Number>
fmi3Status get(fmi3Instance instance, const char* name, const fmi3ValueReference* references,
               std::size_t n, Number* values, std::size_t value_count) {
  return attempt(instance, [&](Instance& each) {
    require_as_many(n, value_count);
    for (std::size_t i = 0; i < n; ++i) {
      require_type(each.variable(references[i]), type_of<Number>(), name);
      values[i] = std::get<Number>(each.get(references[i]));
    }
  });
}

template <class Number>
fmi3Status set(fmi3Instance instance, const char* name, const fmi3ValueReference* references,
               std::size_t n, const Number* values, std::size_t value_count) {
  return attempt(instance, [&](Instance& each) {
    require_as_many(n, value_count);
    for (std::size_t i = 0; i < n; ++i) {
      require_type(each.variable(references[i]), type_of<Number>(), name);
      each.set(references[i], static_cast<double>(values[i]));
    }
  });
}

/// Of a type that no variable has.
fmi3Status none_of(fmi3Instance instance, const char* type, std::size_t n) {
  return n == 0 ? fmi3OK : refused(instance, type);
}

/// The interval of the clock, and its shift, are constant.
fmi3Status constant(fmi3Instance instance, std::size_t n) {
  return none_of(instance, "Clock whose interval or shift can be set", n);
}

/// @param get  takes the instance and a place among the clocks that are asked for
template <class Get>
fmi3Status each_clock(fmi3Instance instance, const fmi3ValueReference* references, std::size_t n,
                      const Get& get) {
  return attempt(instance, [&](const Instance& each) {
    for (std::size_t i = 0; i < n; ++i) {
      each.require_clock(references[i]);
      get(each, i);
    }
  });
}

/// As the specification demands it of who instantiates.
void require_event_mode(const Instance& instance, bool used) {
  if (instance.has_clock() && !used) {
    throw CallError("this FMU has a clock; allowed: eventModeUsed = true, or an FMU without one");
  }
}

}  // namespace
}  // namespace sonoglide::fmi

using namespace sonoglide::fmi;

const char* fmi3GetVersion() {
  return "3.0";
}

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean logging_on, std::size_t count,
                               const fmi3String categories[]) {
  return attempt(instance, [&](Instance& /*each*/) {
    for (std::size_t i = 0; logging_on && i < count; ++i) {
      if (std::strncmp(categories[i], "logStatus", 9) != 0) {
        throw CallError(std::string(categories[i]) +
                        " is no log category; allowed: logStatusError, logStatusDiscard");
      }
    }
  });
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String /*name*/, fmi3String /*token*/,
                                          fmi3String /*resource_path*/, fmi3Boolean /*visible*/,
                                          fmi3Boolean /*logging_on*/,
                                          fmi3InstanceEnvironment /*environment*/,
                                          fmi3LogMessageCallback /*log*/) {
  return nullptr;
}

fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String /*name*/, fmi3String /*token*/, fmi3String /*resource_path*/,
    fmi3Boolean /*visible*/, fmi3Boolean /*logging_on*/, fmi3InstanceEnvironment /*environment*/,
    fmi3LogMessageCallback /*log*/, fmi3ClockUpdateCallback /*clock_update*/,
    fmi3LockPreemptionCallback /*lock*/, fmi3UnlockPreemptionCallback /*unlock*/) {
  return nullptr;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String /*name*/, fmi3String token,
                                         fmi3String resource_path, fmi3Boolean /*visible*/,
                                         fmi3Boolean /*logging_on*/, fmi3Boolean event_mode_used,
                                         fmi3Boolean early_return_allowed,
                                         const fmi3ValueReference /*intermediate_variables*/[],
                                         std::size_t /*count*/, fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback log,
                                         fmi3IntermediateUpdateCallback /*update*/) {
  Log told;
  if (log != nullptr) {
    told = [environment, log](Status status, const char* category, const std::string& message) {
      log(environment, status_of(status), category, message.c_str());
    };
  }
  auto component = Component::create(resource_path == nullptr ? "" : resource_path,
                                     token == nullptr ? "" : token, told);
  if (component == nullptr || component->attempt([event_mode_used](const Instance& each) {
        require_event_mode(each, event_mode_used);
      }) != Status::ok) {
    return nullptr;
  }
  if (event_mode_used && told && !component->has_clock()) {
    told(Status::warning, "logStatusWarning", "this FMU has no event mode");
  }
  component->may_stop_early = early_return_allowed;
  return component.release();
}

void fmi3FreeInstance(fmi3Instance instance) {
  delete static_cast<Component*>(instance);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean /*tolerance_defined*/,
                                       fmi3Float64 /*tolerance*/, fmi3Float64 start_time,
                                       fmi3Boolean /*stop_time_defined*/,
                                       fmi3Float64 /*stop_time*/) {
  return attempt(instance, [&](Instance& each) { each.enter_initialization(start_time); });
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
  return attempt(instance, [](Instance& each) { each.exit_initialization(); });
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
  return attempt(instance, [](Instance& each) { each.enter_event_mode(); });
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
  return attempt(instance, [](Instance& each) { each.terminate(); });
}

fmi3Status fmi3Reset(fmi3Instance instance) {
  return attempt(instance, [](Instance& each) { each.reset(); });
}

fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance) {
  return refused(instance, "structural parameters");
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance) {
  return refused(instance, "structural parameters");
}

#define SONOGLIDE_FMI3_NUMBERS(Type)                                                            \
  fmi3Status fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference references[],        \
                           std::size_t n, fmi3##Type values[], std::size_t value_count) {       \
    return get(instance, #Type, references, n, values, value_count);                            \
  }                                                                                             \
  fmi3Status fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference references[],        \
                           std::size_t n, const fmi3##Type values[], std::size_t value_count) { \
    return set(instance, #Type, references, n, values, value_count);                            \
  }
SONOGLIDE_FMI3_NUMBERS(Float32)
SONOGLIDE_FMI3_NUMBERS(Float64)
SONOGLIDE_FMI3_NUMBERS(Int32)
#undef SONOGLIDE_FMI3_NUMBERS

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

fmi3Status fmi3GetString(fmi3Instance instance, const fmi3ValueReference references[],
                         std::size_t n, fmi3String values[], std::size_t value_count) {
  return attempt(instance, [&](Instance& each) {
    require_as_many(n, value_count);
    for (std::size_t i = 0; i < n; ++i) {
      require_type(each.variable(references[i]), Type::string, "String");
      values[i] = each.get_text(references[i]).c_str();
    }
  });
}

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

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference references[], std::size_t n,
                        fmi3Clock values[]) {
  return attempt(instance, [&](const Instance& each) {
    for (std::size_t i = 0; i < n; ++i) {
      values[i] = each.get_clock(references[i]);
    }
  });
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference references[], std::size_t n,
                        const fmi3Clock values[]) {
  return attempt(instance, [&](Instance& each) {
    for (std::size_t i = 0; i < n; ++i) {
      each.set_clock(references[i], values[i]);
    }
  });
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference reference,
                                               std::size_t* count) {
  return attempt(instance, [&](Instance& each) {
    each.variable(reference);
    *count = 0;
  });
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent,
                                       std::size_t /*dependent_elements*/[],
                                       fmi3ValueReference /*independents*/[],
                                       std::size_t /*independent_elements*/[],
                                       fmi3DependencyKind /*kinds*/[], std::size_t /*count*/) {
  return attempt(instance, [&](Instance& each) { each.variable(dependent); });
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

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return attempt(instance, [&](Instance& each) { save_into(each, *state); });
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state) {
  return attempt(instance, [&](Instance& each) { each.restore(state_at(state)); });
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return attempt(instance, [&](Instance& /*each*/) { free_state(state); });
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state,
                                      std::size_t* size) {
  return attempt(instance, [&](Instance& each) { *size = each.bytes_of(state_at(state)).size(); });
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[],
                                 std::size_t size) {
  return attempt(instance, [&](Instance& each) { serialize(each, state_at(state), bytes, size); });
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[], std::size_t size,
                                   fmi3FMUState* state) {
  return attempt(instance, [&](Instance& each) { *state = new State(each.state_of(bytes, size)); });
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference references[],
                                  std::size_t n, fmi3Float64 intervals[],
                                  fmi3IntervalQualifier qualifiers[]) {
  return each_clock(instance, references, n, [&](const Instance& each, std::size_t i) {
    intervals[i] = each.period_s();
    qualifiers[i] = fmi3IntervalUnchanged;
  });
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance instance, const fmi3ValueReference references[],
                                   std::size_t n, fmi3UInt64 counters[], fmi3UInt64 resolutions[],
                                   fmi3IntervalQualifier qualifiers[]) {
  return each_clock(instance, references, n, [&](const Instance& each, std::size_t i) {
    counters[i] = 1;
    resolutions[i] = each.clock_resolution_Hz();
    qualifiers[i] = fmi3IntervalUnchanged;
  });
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance instance, const fmi3ValueReference references[],
                               std::size_t n, fmi3Float64 shifts[]) {
  return each_clock(instance, references, n,
                    [&](const Instance& /*each*/, std::size_t i) { shifts[i] = 0.0; });
}

fmi3Status fmi3GetShiftFraction(fmi3Instance instance, const fmi3ValueReference references[],
                                std::size_t n, fmi3UInt64 counters[], fmi3UInt64 resolutions[]) {
  return each_clock(instance, references, n, [&](const Instance& each, std::size_t i) {
    counters[i] = 0;
    resolutions[i] = each.clock_resolution_Hz();
  });
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference /*references*/[],
                                  std::size_t n, const fmi3Float64 /*intervals*/[]) {
  return constant(instance, n);
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance instance, const fmi3ValueReference /*references*/[],
                                   std::size_t n, const fmi3UInt64 /*counters*/[],
                                   const fmi3UInt64 /*resolutions*/[]) {
  return constant(instance, n);
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance instance, const fmi3ValueReference /*references*/[],
                               std::size_t n, const fmi3Float64 /*shifts*/[]) {
  return constant(instance, n);
}

fmi3Status fmi3SetShiftFraction(fmi3Instance instance, const fmi3ValueReference /*references*/[],
                                std::size_t n, const fmi3UInt64 /*counters*/[],
                                const fmi3UInt64 /*resolutions*/[]) {
  return constant(instance, n);
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance) {
  return refused(instance, "evaluation of discrete states");
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean* needs_update,
                                    fmi3Boolean* terminate, fmi3Boolean* nominals_changed,
                                    fmi3Boolean* values_changed,
                                    fmi3Boolean* next_event_time_defined,
                                    fmi3Float64* /*next_event_time*/) {
  for (fmi3Boolean* each :
       {needs_update, terminate, nominals_changed, values_changed, next_event_time_defined}) {
    *each = false;
  }
  return attempt(instance, [](Instance& each) { each.update_discrete_states(); });
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
  return attempt(instance, [](Instance& each) { each.enter_step_mode(); });
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance,
                                    const fmi3ValueReference /*references*/[], std::size_t /*n*/,
                                    const fmi3Int32 /*orders*/[], fmi3Float64 /*values*/[],
                                    std::size_t /*value_count*/) {
  return refused(instance, "derivatives of outputs");
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 point, fmi3Float64 size,
                      fmi3Boolean /*no_state_prior*/, fmi3Boolean* event_needed,
                      fmi3Boolean* terminate, fmi3Boolean* early_return, fmi3Float64* last_time) {
  *event_needed = false;
  *terminate = false;
  *early_return = false;
  return attempt(instance, [&](Instance& each) {
    *last_time = each.time_s();
    const bool may_stop = static_cast<Component*>(instance)->may_stop_early;
    *early_return = each.advance(point, size, may_stop);
    *last_time = each.time_s();
  });
}
