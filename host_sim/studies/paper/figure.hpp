/// A figure of the paper as this program gives it.
#pragma once

#include <string>
#include <vector>

#include "host_sim/output/page.hpp"

namespace sonoglide::paper {

enum class Verdict { holds, does_not_hold, depends };

/// What the paper says, and what the numbers say of it.
struct Claim {
  std::string statement;
  Verdict verdict;
  std::string numbers;
};

/// Beside the figure's own CSV and SVG.
struct File {
  std::string name;
  std::string text;
};

struct Figure {
  int number;
  std::string title;
  std::string conditions;  ///< parameters, initial state and averaging window
  std::string command;     ///< that computes the same with table_1.toml
  std::string csv;
  std::string svg;
  std::vector<Claim> claims;
  std::vector<output::Table> tables = {};
  std::vector<File> files = {};
};

inline Verdict verdict(bool holds) {
  return holds ? Verdict::holds : Verdict::does_not_hold;
}

}  // namespace sonoglide::paper
