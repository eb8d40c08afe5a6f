// Writes firmware/friction/dahl_inverse_table.hpp to the standard output: the closed-form
// friction-ratio map, inverted by bisection on the grid of inverse_grid.hpp.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "firmware/friction/dahl_friction_ratio.hpp"
#include "firmware/friction/inverse_grid.hpp"

namespace {

using sonoglide::friction::dahl_friction_ratio;
using Grid = sonoglide::friction::InverseGrid;

constexpr double pi = 3.14159265358979323846;
constexpr int bisections = 60;

template <class Axis>
double line(int index) {
  constexpr int cells = Axis::cells_per_octave;
  if (index == 0) {
    return 0.0;
  }
  const int octave = (index - 1) / cells;
  const int cell = (index - 1) % cells;
  return std::ldexp(1.0 + static_cast<double>(cell) / cells, octave + Axis::first_octave);
}

// z = sqrt(ρ/r − ρ) for which the map returns ρ at λ = κ'·ρ; the limits ρ → 0 and κ' → 0 are taken
// just inside.
double tabulated(double ratio, double reduced_dahl_number) {
  if (ratio >= 1.0) {
    return 0.0;
  }
  const double rho = std::max(ratio, 1e-6);
  const double lambda = std::max(reduced_dahl_number, 1e-6) * rho;
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < bisections; ++i) {
    const double u = 0.5 * (low + high);
    const double r = std::sin(0.5 * pi * u);
    (dahl_friction_ratio(r, lambda / r) < rho ? low : high) = u;
  }
  return std::sqrt(rho / std::sin(0.5 * pi * low) - rho);
}

}  // namespace

int main() {
  std::puts(
      "/// Inverse Dahl map, sqrt(rho/r - rho) in 2^-15, a row for each reduced Dahl number.");
  std::puts("/// Written by tools/generate/dahl_inverse_table.cpp; a test compares the two.");
  std::puts("#pragma once\n");
  std::puts("#include <cstdint>\n");
  std::puts("#include \"firmware/friction/inverse_grid.hpp\"\n");
  std::puts("namespace sonoglide::friction {\n");
  std::puts("// clang-format off");
  std::puts("inline constexpr std::uint16_t");
  std::puts("    dahl_inverse_table[InverseGrid::rows][InverseGrid::columns] = {");
  for (int row = 0; row < Grid::rows; ++row) {
    std::fputs("  {", stdout);
    for (int column = 0; column < Grid::columns; ++column) {
      const double z = tabulated(1.0 - line<Grid::Column>(column), line<Grid::Row>(row));
      const int entry = static_cast<int>(std::floor(std::ldexp(z, Grid::entry_bits) + 0.5));
      std::printf("%d%s", entry, column + 1 < Grid::columns ? "," : "");
    }
    std::puts("},");
  }
  std::puts("};\n// clang-format on\n\n}  // namespace sonoglide::friction");
  return 0;
}
