#include "host_sim/fmi/binary/fmi2.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "host_sim/fmi/binary/component.hpp"

namespace sonoglide::fmi {
namespace {

/// What this version of the interface asks for besides.
struct Component2 {
  std::unique_ptr<Component> component;
  TimeRange range;
};

fmi2Status status_of_2(Status status) {
  return static_cast<fmi2Status>(status);
}

template <class Call>
fmi2Status attempt(fmi2Component component, const Call& call) {
  return component == nullptr
             ? fmi2Error
             : status_of_2(static_cast<Component2*>(component)->component->attempt(call));
}

fmi2Status refused(fmi2Component component, const char* what) {
  return attempt(component, [what](const Instance& /*each*/) { refuse(what); });
}

Log log_of(fmi2String name, const fmi2CallbackFunctions* functions) {
  if (functions == nullptr || functions->logger == nullptr) {
    return {};
  }
  return [environment = functions->componentEnvironment, logger = functions->logger,
          called = std::string(name == nullptr ? "" : name)](Status status, const char* category,
                                                             const std::string& message) {
    logger(environment, called.c_str(), status_of_2(status), category, "%s", message.c_str());
  };
}

#if defined(_WIN32)
constexpr bool has_drive_letters = true;
#else
constexpr bool has_drive_letters = false;
#endif

int digit_of(char digit) {
  return digit >= '0' && digit <= '9'   ? digit - '0'
         : digit >= 'a' && digit <= 'f' ? digit - 'a' + 10
         : digit >= 'A' && digit <= 'F' ? digit - 'A' + 10
                                        : -1;
}

/// The folder that a URI file:/…, file:///… or file://localhost/… names; a plain path is one too.
/// On Windows the / before a drive letter is none of the path.
/// Source: RFC 3986, 2.1, and RFC 8089.
std::string path_of(std::string_view uri) {
  constexpr std::string_view scheme = "file:";
  if (uri.substr(0, scheme.size()) != scheme) {
    return std::string(uri);
  }
  uri.remove_prefix(scheme.size());
  if (uri.substr(0, 2) == "//") {
    uri.remove_prefix(uri.find('/', 2) == std::string_view::npos ? 2 : uri.find('/', 2));
  }
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escaped = uri[i] == '%' && i + 2 < uri.size() && digit_of(uri[i + 1]) >= 0 &&
                         digit_of(uri[i + 2]) >= 0;
    path += escaped ? static_cast<char>(digit_of(uri[i + 1]) * 16 + digit_of(uri[i + 2])) : uri[i];
    i += escaped ? 2 : 0;
  }
  if (has_drive_letters && path.size() > 2 && path[0] == '/' && path[2] == ':') {
    path.erase(0, 1);
  }
  return path;
}

bool is_real(Type type) {
  return type == Type::float64 || type == Type::float32;
}

double real_of(const Value& value) {
  const float* single = std::get_if<float>(&value);
  return single != nullptr ? static_cast<double>(*single) : std::get<double>(value);
}

}  // namespace
}  // namespace sonoglide::fmi

using namespace sonoglide::fmi;

const char* fmi2GetTypesPlatform() {
  return "default";
}

const char* fmi2GetVersion() {
  return "2.0";
}

fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean logging_on, std::size_t count,
                               const fmi2String categories[]) {
  return attempt(component, [&](Instance& /*each*/) {
    require_categories(logging_on != 0 ? count : 0, categories);
  });
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid,
                              fmi2String resource_location, const fmi2CallbackFunctions* functions,
                              fmi2Boolean /*visible*/, fmi2Boolean /*logging_on*/) {
  const Log log = log_of(name, functions);
  if (type != fmi2CoSimulation) {
    tell_refusal(log, "model exchange");
    return nullptr;
  }
  auto component = Component::create(path_of(resource_location == nullptr ? "" : resource_location),
                                     guid == nullptr ? "" : guid, log);
  return component == nullptr ? nullptr : new Component2{std::move(component), {}};
}

void fmi2FreeInstance(fmi2Component component) {
  delete static_cast<Component2*>(component);
}

fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean /*tolerance_defined*/,
                               fmi2Real /*tolerance*/, fmi2Real start_time,
                               fmi2Boolean stop_time_defined, fmi2Real stop_time) {
  return attempt(component, [&](const Instance& each) {
    const TimeRange range = range_of(start_time, stop_time_defined != 0, stop_time);
    each.require_range(range);
    static_cast<Component2*>(component)->range = range;
  });
}

fmi2Status fmi2EnterInitializationMode(fmi2Component component) {
  return attempt(component, [&](Instance& each) {
    each.enter_initialization(static_cast<Component2*>(component)->range);
  });
}

fmi2Status fmi2ExitInitializationMode(fmi2Component component) {
  return attempt(component, [](Instance& each) { each.exit_initialization(); });
}

fmi2Status fmi2Terminate(fmi2Component component) {
  return attempt(component, [](Instance& each) { each.terminate(); });
}

fmi2Status fmi2Reset(fmi2Component component) {
  return attempt(component, [&](Instance& each) {
    static_cast<Component2*>(component)->range = TimeRange();
    each.reset();
  });
}

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference references[],
                       std::size_t n, fmi2Real values[]) {
  return attempt(component, [&](Instance& each) {
    for_each_value(each, references, n, values, "Real", is_real,
                   [&each](fmi2ValueReference reference, fmi2Real& value) {
                     value = real_of(each.get(reference));
                   });
  });
}

fmi2Status fmi2GetInteger(fmi2Component component, const fmi2ValueReference references[],
                          std::size_t n, fmi2Integer values[]) {
  return attempt(component, [&](Instance& each) {
    for_each_value(each, references, n, values, "Integer", is_of<Type::int32>,
                   [&each](fmi2ValueReference reference, fmi2Integer& value) {
                     value = std::get<std::int32_t>(each.get(reference));
                   });
  });
}

fmi2Status fmi2GetString(fmi2Component component, const fmi2ValueReference references[],
                         std::size_t n, fmi2String values[]) {
  return attempt(component, [&](Instance& each) {
    for_each_value(each, references, n, values, "String", is_of<Type::string>,
                   [&each](fmi2ValueReference reference, fmi2String& value) {
                     value = each.get_text(reference).c_str();
                   });
  });
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference references[],
                       std::size_t n, const fmi2Real values[]) {
  return attempt(component, [&](Instance& each) {
    for_each_value(each, references, n, values, "Real", is_real,
                   [&each](fmi2ValueReference reference, const fmi2Real& value) {
                     each.set(reference, value);
                   });
  });
}

fmi2Status fmi2SetInteger(fmi2Component component, const fmi2ValueReference references[],
                          std::size_t n, const fmi2Integer values[]) {
  return attempt(component, [&](Instance& each) {
    for_each_value(each, references, n, values, "Integer", is_of<Type::int32>,
                   [&each](fmi2ValueReference reference, const fmi2Integer& value) {
                     each.set(reference, value);
                   });
  });
}

fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return attempt(component, [&](Instance& each) { save_into(each, state); });
}

fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state) {
  return attempt(component, [&](Instance& each) { each.restore(state_at(state)); });
}

fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return attempt(component, [&](Instance& /*each*/) { free_state(state); });
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate state,
                                      std::size_t* size) {
  return attempt(component, [&](Instance& each) {
    require_pointers(size);
    *size = each.bytes_of(state_at(state)).size();
  });
}

fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate state, fmi2Byte bytes[],
                                 std::size_t size) {
  return attempt(component, [&](Instance& each) { serialize(each, state_at(state), bytes, size); });
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte bytes[],
                                   std::size_t size, fmi2FMUstate* state) {
  return attempt(component, [&](Instance& each) {
    deserialize(each, reinterpret_cast<const std::uint8_t*>(bytes), size, state);
  });
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real point, fmi2Real size,
                      fmi2Boolean /*no_state_prior*/) {
  return attempt(component, [&](Instance& each) { each.advance(point, size, false); });
}

fmi2Status fmi2GetRealStatus(fmi2Component component, fmi2StatusKind kind, fmi2Real* value) {
  if (kind != fmi2LastSuccessfulTime) {
    return refused(component, "such a status");
  }
  return attempt(component, [&](const Instance& each) {
    require_pointers(value);
    *value = each.time_s();
  });
}

fmi2Status fmi2GetBooleanStatus(fmi2Component component, fmi2StatusKind kind, fmi2Boolean* value) {
  if (kind != fmi2Terminated) {
    return refused(component, "such a status");
  }
  return attempt(component, [&](const Instance& /*each*/) {
    require_pointers(value);
    *value = 0;
  });
}

#define SONOGLIDE_NO_VALUES(name, what, parameters)                                               \
  fmi2Status name parameters {                                                                    \
    return n == 0 ? attempt(instance, [](const Instance& /*each*/) {}) : refused(instance, what); \
  }
SONOGLIDE_FMI2_NO_VALUES(SONOGLIDE_NO_VALUES)
#undef SONOGLIDE_NO_VALUES

#define SONOGLIDE_REFUSED(name, what, parameters) \
  fmi2Status name parameters {                    \
    return refused(instance, what);               \
  }
SONOGLIDE_FMI2_REFUSED(SONOGLIDE_REFUSED)
#undef SONOGLIDE_REFUSED
