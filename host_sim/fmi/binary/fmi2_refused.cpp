/// The functions of FMI 2.0 for what the description of the model says that there is none. Importers
/// look for all functions of the headers. Each logs and answers error.
#include <cstddef>

#include "host_sim/fmi/binary/fmi2_call.hpp"

namespace sonoglide::fmi {
namespace {

fmi2Status none_of(fmi2Component component, const char* type, std::size_t n) {
  return n == 0 ? attempt(component, [](const Instance& /*each*/) {}) : refused(component, type);
}

}  // namespace
}  // namespace sonoglide::fmi

using namespace sonoglide::fmi;

fmi2Status fmi2GetBoolean(fmi2Component component, const fmi2ValueReference /*references*/[],
                          std::size_t n, fmi2Boolean /*values*/[]) {
  return none_of(component, "Boolean", n);
}

fmi2Status fmi2SetBoolean(fmi2Component component, const fmi2ValueReference /*references*/[],
                          std::size_t n, const fmi2Boolean /*values*/[]) {
  return none_of(component, "Boolean", n);
}

fmi2Status fmi2SetString(fmi2Component component, const fmi2ValueReference /*references*/[],
                         std::size_t n, const fmi2String /*values*/[]) {
  return none_of(component, "String that can be set", n);
}

fmi2Status fmi2GetDirectionalDerivative(
    fmi2Component component, const fmi2ValueReference /*unknowns*/[], std::size_t /*unknown_count*/,
    const fmi2ValueReference /*knowns*/[], std::size_t /*known_count*/,
    const fmi2Real /*known_changes*/[], fmi2Real /*unknown_changes*/[]) {
  return refused(component, "directional derivatives");
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component component,
                                       const fmi2ValueReference /*references*/[], std::size_t n,
                                       const fmi2Integer /*orders*/[],
                                       const fmi2Real /*values*/[]) {
  return none_of(component, "derivatives of inputs", n);
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component component,
                                        const fmi2ValueReference /*references*/[], std::size_t n,
                                        const fmi2Integer /*orders*/[], fmi2Real /*values*/[]) {
  return none_of(component, "derivatives of outputs", n);
}

fmi2Status fmi2CancelStep(fmi2Component component) {
  return refused(component, "steps in the background");
}

fmi2Status fmi2GetStatus(fmi2Component component, fmi2StatusKind /*kind*/, fmi2Status* /*value*/) {
  return refused(component, "steps in the background");
}

fmi2Status fmi2GetIntegerStatus(fmi2Component component, fmi2StatusKind /*kind*/,
                                fmi2Integer* /*value*/) {
  return refused(component, "such a status");
}

fmi2Status fmi2GetStringStatus(fmi2Component component, fmi2StatusKind /*kind*/,
                               fmi2String* /*value*/) {
  return refused(component, "steps in the background");
}

fmi2Status fmi2EnterEventMode(fmi2Component component) {
  return refused(component, model_exchange);
}

fmi2Status fmi2NewDiscreteStates(fmi2Component component, fmi2EventInfo* /*info*/) {
  return refused(component, model_exchange);
}

fmi2Status fmi2GetDerivatives(fmi2Component component, fmi2Real /*derivatives*/[],
                              std::size_t /*n*/) {
  return refused(component, model_exchange);
}

#define SONOGLIDE_REFUSED(name, parameters)   \
  fmi2Status name parameters {                \
    return refused(instance, model_exchange); \
  }
SONOGLIDE_FMI_MODEL_EXCHANGE(SONOGLIDE_REFUSED, fmi2, fmi2Component, fmi2Boolean, fmi2Real)
#undef SONOGLIDE_REFUSED
