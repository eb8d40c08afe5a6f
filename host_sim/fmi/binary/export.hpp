/// A function that an importer finds in the shared library; everything else is hidden.
#pragma once

#if defined(_WIN32)
#define SONOGLIDE_FMI extern "C" __declspec(dllexport)
#else
#define SONOGLIDE_FMI extern "C" __attribute__((visibility("default")))
#endif
