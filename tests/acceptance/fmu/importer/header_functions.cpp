#include "tests/acceptance/fmu/importer/header_functions.hpp"

#include <iterator>
#include <sstream>

#include "host_sim/process/regular_expression.hpp"

namespace sonoglide::acceptance {
namespace {

constexpr const char* names = R"(
  fmi2CancelStep fmi2CompletedIntegratorStep fmi2DeSerializeFMUstate fmi2DoStep
  fmi2EnterContinuousTimeMode fmi2EnterEventMode fmi2EnterInitializationMode
  fmi2ExitInitializationMode fmi2FreeFMUstate fmi2FreeInstance fmi2GetBoolean fmi2GetBooleanStatus
  fmi2GetContinuousStates fmi2GetDerivatives fmi2GetDirectionalDerivative fmi2GetEventIndicators
  fmi2GetFMUstate fmi2GetInteger fmi2GetIntegerStatus fmi2GetNominalsOfContinuousStates
  fmi2GetReal fmi2GetRealOutputDerivatives fmi2GetRealStatus fmi2GetStatus fmi2GetString
  fmi2GetStringStatus fmi2GetTypesPlatform fmi2GetVersion fmi2Instantiate fmi2NewDiscreteStates
  fmi2Reset fmi2SerializeFMUstate fmi2SerializedFMUstateSize fmi2SetBoolean
  fmi2SetContinuousStates fmi2SetDebugLogging fmi2SetFMUstate fmi2SetInteger fmi2SetReal
  fmi2SetRealInputDerivatives fmi2SetString fmi2SetTime fmi2SetupExperiment fmi2Terminate

  fmi3ActivateModelPartition fmi3CompletedIntegratorStep fmi3DeserializeFMUState fmi3DoStep
  fmi3EnterConfigurationMode fmi3EnterContinuousTimeMode fmi3EnterEventMode
  fmi3EnterInitializationMode fmi3EnterStepMode fmi3EvaluateDiscreteStates
  fmi3ExitConfigurationMode fmi3ExitInitializationMode fmi3FreeFMUState fmi3FreeInstance
  fmi3GetAdjointDerivative fmi3GetBinary fmi3GetBoolean fmi3GetClock
  fmi3GetContinuousStateDerivatives fmi3GetContinuousStates fmi3GetDirectionalDerivative
  fmi3GetEventIndicators fmi3GetFMUState fmi3GetFloat32 fmi3GetFloat64 fmi3GetInt16 fmi3GetInt32
  fmi3GetInt64 fmi3GetInt8 fmi3GetIntervalDecimal fmi3GetIntervalFraction
  fmi3GetNominalsOfContinuousStates fmi3GetNumberOfContinuousStates fmi3GetNumberOfEventIndicators
  fmi3GetNumberOfVariableDependencies fmi3GetOutputDerivatives fmi3GetShiftDecimal
  fmi3GetShiftFraction fmi3GetString fmi3GetUInt16 fmi3GetUInt32 fmi3GetUInt64 fmi3GetUInt8
  fmi3GetVariableDependencies fmi3GetVersion fmi3InstantiateCoSimulation
  fmi3InstantiateModelExchange fmi3InstantiateScheduledExecution fmi3Reset fmi3SerializeFMUState
  fmi3SerializedFMUStateSize fmi3SetBinary fmi3SetBoolean fmi3SetClock fmi3SetContinuousStates
  fmi3SetDebugLogging fmi3SetFMUState fmi3SetFloat32 fmi3SetFloat64 fmi3SetInt16 fmi3SetInt32
  fmi3SetInt64 fmi3SetInt8 fmi3SetIntervalDecimal fmi3SetIntervalFraction fmi3SetShiftDecimal
  fmi3SetShiftFraction fmi3SetString fmi3SetTime fmi3SetUInt16 fmi3SetUInt32 fmi3SetUInt64
  fmi3SetUInt8 fmi3Terminate fmi3UpdateDiscreteStates
)";

}  // namespace

std::set<std::string> header_functions() {
  std::istringstream words(names);
  return {std::istream_iterator<std::string>(words), {}};
}

std::set<std::string> matches_of_lines(const std::string& listing, const std::string& line) {
  std::set<std::string> matches;
  std::istringstream lines(listing);
  const process::RegularExpression expression(line);
  for (std::string text; std::getline(lines, text);) {
    if (const process::Match found = expression.match(text); !found.empty()) {
      matches.insert(found[1]);
    }
  }
  return matches;
}

}  // namespace sonoglide::acceptance
