/// Loads an FMU of FMI 3.0 under Windows, steps it and prints the hash of its commands.
///
/// step_loop LIBRARY RESOURCES TOKEN REFERENCE STEP_s STEPS, the reference that of `trace_hash`.

#include <windows.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "host_sim/fmi/binary/fmi3.hpp"

namespace {

void note(fmi3InstanceEnvironment /*environment*/, fmi3Status /*status*/, fmi3String /*category*/,
          fmi3String message) {
  std::fprintf(stderr, "%s\n", message);
}

/// As the interface wants every text.
std::string utf8(const wchar_t* text) {
  const int size = WideCharToMultiByte(CP_UTF8, 0, text, -1, nullptr, 0, nullptr, nullptr);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  WideCharToMultiByte(CP_UTF8, 0, text, -1, bytes.data(), size, nullptr, nullptr);
  return bytes;
}

template <class Function>
Function* find(HMODULE library, const char* name) {
  auto* const found =
      reinterpret_cast<Function*>(reinterpret_cast<void*>(GetProcAddress(library, name)));
  if (found == nullptr) {
    std::fprintf(stderr, "no function %s\n", name);
    std::exit(1);
  }
  return found;
}

}  // namespace

#define SONOGLIDE_FIND(name) find<decltype(name)>(library, #name)

int wmain(int argc, wchar_t** argv) {
  HMODULE library = argc == 7 ? LoadLibraryW(argv[1]) : nullptr;
  if (library == nullptr) {
    std::fprintf(stderr, "cannot be loaded\n");
    return 1;
  }
  fmi3Instance const instance = SONOGLIDE_FIND(fmi3InstantiateCoSimulation)(
      "tested", utf8(argv[3]).c_str(), utf8(argv[2]).c_str(), false, false, false, false, nullptr,
      0, nullptr, note, nullptr);
  if (SONOGLIDE_FIND(fmi3EnterInitializationMode)(instance, false, 0.0, 0.0, false, 0.0) !=
          fmi3OK ||
      SONOGLIDE_FIND(fmi3ExitInitializationMode)(instance) != fmi3OK) {
    return 1;
  }
  const double step_s = std::wcstod(argv[5], nullptr);
  double time_s = 0.0;
  for (long k = std::wcstol(argv[6], nullptr, 10); k > 0; --k) {
    bool event = false;
    bool end = false;
    bool early = false;
    double last_s = 0.0;
    if (SONOGLIDE_FIND(fmi3DoStep)(instance, time_s, step_s, true, &event, &end, &early, &last_s) !=
        fmi3OK) {
      return 1;
    }
    time_s = last_s;
  }
  const auto reference = static_cast<fmi3ValueReference>(std::wcstoul(argv[4], nullptr, 10));
  fmi3String hash = nullptr;
  if (SONOGLIDE_FIND(fmi3GetString)(instance, &reference, 1, &hash, 1) != fmi3OK) {
    return 1;
  }
  std::printf("%s\n", hash);
  SONOGLIDE_FIND(fmi3FreeInstance)(instance);
  return 0;
}
