/// A function that an importer finds in the shared library; everything else is hidden.
#pragma once

#define SONOGLIDE_FMI extern "C" __attribute__((visibility("default")))
