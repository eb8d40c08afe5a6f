// The TOML parser's own functions, compiled in: an FMU needs no shared library of it.
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
