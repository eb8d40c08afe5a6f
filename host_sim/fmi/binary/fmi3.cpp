#include "host_sim/fmi/binary/fmi3.hpp"

#include <cstring>
#include <string>

#include "host_sim/fmi/binary/component.hpp"

namespace sonoglide::fmi {
namespace {

fmi3Status status_of_3(Status status) {
  return static_cast<fmi3Status>(status);
}

template <class Call>
fmi3Status attempt(fmi3Instance instance, const Call& call) {
  return instance == nullptr ? fmi3Error
                             : status_of_3(static_cast<Component*>(instance)->attempt(call));
}

Log log_of(fmi3InstanceEnvironment environment, fmi3LogMessageCallback log) {
  if (log == nullptr) {
    return {};
  }
  return [environment, log](Status status, const char* category, const std::string& message) {
    log(environment, status_of_3(status), category, message.c_str());
  };
}

fmi3Status refused(fmi3Instance instance, const char* what) {
  return attempt(instance, [what](const Instance& /*each*/) { refuse(what); });
}

fmi3Instance no_instance(fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                         const char* what) {
  tell_refusal(log_of(environment, log), what);
  return nullptr;
}

/// @param call  with a reference and its element of the values
template <Type Wanted, class Element, class Call>
fmi3Status for_each(fmi3Instance instance, const char* type, const fmi3ValueReference* references,
                    std::size_t n, Element* values, std::size_t value_count, const Call& call) {
  return attempt(instance, [&](Instance& each) {
    if (n != value_count) {
      throw CallError("there are not as many values as value references; no variable is an array");
    }
    for_each_value(
        each, references, n, values, type, is_of<Wanted>,
        [&](fmi3ValueReference reference, Element& value) { call(each, reference, value); });
  });
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
    require_categories(logging_on ? count : 0, categories);
  });
}

fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String /*name*/, fmi3String token, fmi3String resource_path, fmi3Boolean /*visible*/,
    fmi3Boolean /*logging_on*/, fmi3Boolean /*event_mode_used*/, fmi3Boolean early_return_allowed,
    const fmi3ValueReference /*intermediate_variables*/[], std::size_t /*count*/,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
    fmi3IntermediateUpdateCallback /*update*/) {
  auto component = Component::create(resource_path == nullptr ? "" : resource_path,
                                     token == nullptr ? "" : token, log_of(environment, log));
  if (component == nullptr) {
    return nullptr;
  }
  component->may_stop_early = early_return_allowed;
  return component.release();
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String /*name*/, fmi3String /*token*/,
                                          fmi3String /*resource_path*/, fmi3Boolean /*visible*/,
                                          fmi3Boolean /*logging_on*/,
                                          fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback log) {
  return no_instance(environment, log, "model exchange");
}

fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String /*name*/, fmi3String /*token*/, fmi3String /*resource_path*/,
    fmi3Boolean /*visible*/, fmi3Boolean /*logging_on*/, fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log, fmi3ClockUpdateCallback /*clock_update*/,
    fmi3LockPreemptionCallback /*lock*/, fmi3UnlockPreemptionCallback /*unlock*/) {
  return no_instance(environment, log, "scheduled execution");
}

void fmi3FreeInstance(fmi3Instance instance) {
  delete static_cast<Component*>(instance);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean /*tolerance_defined*/,
                                       fmi3Float64 /*tolerance*/, fmi3Float64 start_time,
                                       fmi3Boolean stop_time_defined, fmi3Float64 stop_time) {
  return attempt(instance, [&](Instance& each) {
    each.enter_initialization(range_of(start_time, stop_time_defined, stop_time));
  });
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
  return attempt(instance, [](Instance& each) { each.exit_initialization(); });
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
  return attempt(instance, [](Instance& each) { each.terminate(); });
}

fmi3Status fmi3Reset(fmi3Instance instance) {
  return attempt(instance, [](Instance& each) { each.reset(); });
}

#define SONOGLIDE_FMI3_NUMBERS(Name, type)                                                      \
  fmi3Status fmi3Get##Name(fmi3Instance instance, const fmi3ValueReference references[],        \
                           std::size_t n, fmi3##Name values[], std::size_t value_count) {       \
    return for_each<Type::type>(instance, #Name, references, n, values, value_count,            \
                                [](Instance& each, fmi3ValueReference at, fmi3##Name& value) {  \
                                  value = std::get<fmi3##Name>(each.get(at));                   \
                                });                                                             \
  }                                                                                             \
  fmi3Status fmi3Set##Name(fmi3Instance instance, const fmi3ValueReference references[],        \
                           std::size_t n, const fmi3##Name values[], std::size_t value_count) { \
    return for_each<Type::type>(instance, #Name, references, n, values, value_count,            \
                                [](Instance& each, fmi3ValueReference at, fmi3##Name value) {   \
                                  each.set(at, static_cast<double>(value));                     \
                                });                                                             \
  }
SONOGLIDE_FMI3_NUMBERS(Float32, float32)
SONOGLIDE_FMI3_NUMBERS(Float64, float64)
SONOGLIDE_FMI3_NUMBERS(Int32, int32)
#undef SONOGLIDE_FMI3_NUMBERS

fmi3Status fmi3GetString(fmi3Instance instance, const fmi3ValueReference references[],
                         std::size_t n, fmi3String values[], std::size_t value_count) {
  return for_each<Type::string>(instance, "String", references, n, values, value_count,
                                [](Instance& each, fmi3ValueReference at, fmi3String& value) {
                                  value = each.get_text(at).c_str();
                                });
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference reference,
                                               std::size_t* count) {
  return attempt(instance, [&](Instance& each) {
    require_pointers(count);
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

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return attempt(instance, [&](Instance& each) { save_into(each, state); });
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state) {
  return attempt(instance, [&](Instance& each) { each.restore(state_at(state)); });
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return attempt(instance, [&](Instance& /*each*/) { free_state(state); });
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state,
                                      std::size_t* size) {
  return attempt(instance, [&](Instance& each) {
    require_pointers(size);
    *size = each.bytes_of(state_at(state)).size();
  });
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[],
                                 std::size_t size) {
  return attempt(instance, [&](Instance& each) { serialize(each, state_at(state), bytes, size); });
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[], std::size_t size,
                                   fmi3FMUState* state) {
  return attempt(instance, [&](Instance& each) { deserialize(each, bytes, size, state); });
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 point, fmi3Float64 size,
                      fmi3Boolean /*no_state_prior*/, fmi3Boolean* event_needed,
                      fmi3Boolean* terminate, fmi3Boolean* early_return, fmi3Float64* last_time) {
  return attempt(instance, [&](Instance& each) {
    require_pointers(event_needed, terminate, early_return, last_time);
    *event_needed = false;
    *terminate = false;
    *early_return = false;
    *last_time = each.time_s();
    const bool may_stop = static_cast<Component*>(instance)->may_stop_early;
    *early_return = each.advance(point, size, may_stop);
    *last_time = each.time_s();
  });
}

#define SONOGLIDE_NO_VALUES(name, what, parameters)                                               \
  fmi3Status name parameters {                                                                    \
    return n == 0 ? attempt(instance, [](const Instance& /*each*/) {}) : refused(instance, what); \
  }
SONOGLIDE_FMI3_NO_VALUES(SONOGLIDE_NO_VALUES)
#undef SONOGLIDE_NO_VALUES

#define SONOGLIDE_REFUSED(name, what, parameters) \
  fmi3Status name parameters {                    \
    return refused(instance, what);               \
  }
SONOGLIDE_FMI3_REFUSED(SONOGLIDE_REFUSED)
#undef SONOGLIDE_REFUSED
