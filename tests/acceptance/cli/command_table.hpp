/// What the tests of every command know of each: a new command is a line here.
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace sonoglide::acceptance {

/// What it takes to run a command to its end.
enum class Effort { instant, seconds, emulator, device /* before the scene */ };

struct Command {
  std::string name;                  ///< behind that of its group, where it is in one
  std::string scene;                 ///< a file of SceneFolder; empty: it takes none
  std::string arguments;             ///< that it needs besides
  std::vector<std::string> options;  ///< in the order of its help, after --help
  std::string folder;                ///< without --out; empty: it writes nothing
  std::vector<std::string> files;    ///< of a run to the end, sorted; empty where that is long
  std::vector<std::string> others;   ///< names that a file of somebody else keeps
  Effort effort = Effort::instant;
};

/// For the names of the tests.
inline void PrintTo(const Command& command, std::ostream* out) {
  *out << command.name;
}

inline const std::vector<Command> command_table = {
    {"run",
     "open.toml",
     "",
     {"--set", "--out", "--json", "--quiet"},
     "out/open",
     {"periods.csv", "report.html", "summary.json", "trace.csv"},
     {"trace.csv", "summary.json", "report.html"}},
    {"pil",
     "closed.toml",
     "--board mps2-an386",
     {"--set", "--board", "--port", "--out", "--quiet"},
     "out/closed_mps2-an386",
     {},
     {"summary.json"},
     Effort::emulator},
    {"image",
     "closed.toml",
     "--board mps2-an386",
     {"--set", "--board", "--out", "--lockstep", "--encoder", "--quiet"},
     "",
     {},
     {},
     Effort::emulator},
    {"connect", "", "", {"--emulated", "--set", "--quiet"}, "", {}, {}, Effort::device},
    {"commission",
     "closed.toml",
     "",
     {"--set", "--out", "--quiet"},
     "out/closed_commission",
     {},
     {"commissioned.toml"},
     Effort::device},
    {"configure",
     "closed.toml",
     "",
     {"--set", "--out", "--plant", "--quiet"},
     "out/closed",
     {"controller_configuration.hpp"},
     {"controller_configuration.hpp", "plant_configuration.hpp"}},
    {"ratio",
     "",
     "--velocity-ratio 0.5 --dahl-number 1",
     {"--velocity-ratio", "--dahl-number"},
     "",
     {},
     {}},
    {"sweep",
     "open.toml",
     "--vary velocity_ratio=0.2:1:3",
     {"--set", "--vary", "--out", "--threads", "--shard", "--merge", "--status", "--slurm",
      "--quiet"},
     "out/open_sweep",
     {"report.html", "sweep.csv", "sweep.svg"},
     {"sweep.csv", "sweep.svg", "sweep.journal"}},
    {"robust",
     "uncertain.toml",
     "--samples 4 --search 4",
     {"--set", "--samples", "--search", "--seed", "--out", "--threads", "--shard", "--merge",
      "--status", "--slurm", "--quiet"},
     "out/uncertain_robust",
     {"report.html", "robust.csv", "robust.json", "search.csv", "worst.toml"},
     {"robust.csv", "worst.toml", "robust.journal"}},
    {"paper",
     "",
     "--figure 3",
     {"--out", "--figure", "--quiet"},
     "out/paper",
     {"figure_03.csv", "figure_03.svg", "index.html", "table_1.toml", "table_2.toml"},
     {"figure_03.csv"}},
    {"work-precision",
     "open.toml",
     "",
     {"--set", "--out", "--quiet"},
     "out/open_work_precision",
     {"report.html", "work_precision.csv", "work_precision.svg"},
     {"work_precision.svg"},
     Effort::seconds},
    // Without a scene it takes minutes: stability_command_test has a shorter one.
    {"stability",
     "open.toml",
     "--self-excited",
     {"--set", "--self-excited", "--out", "--quiet"},
     "out/open_self_excited",
     {"report.html", "self_excited.csv", "self_excited.json", "self_excited.svg"},
     {"self_excited.csv"}},
    {"arithmetic",
     "closed.toml",
     "",
     {"--set", "--board", "--out", "--quiet"},
     "out/closed_arithmetic",
     {},
     {"arithmetic.csv"},
     Effort::emulator},
    {"design",
     "closed.toml",
     "--ratio 0.5",
     {"--set", "--ratio", "--velocity", "--out", "--quiet"},
     "out/closed_design",
     {"design.csv", "design.json", "detuning.csv", "report.html"},
     {"design.json"}},
    {"identify impedance",
     "",
     "measured.csv",
     {"--mass-kg", "--force-factor-N-per-V", "--out", "--quiet"},
     "out/measured_impedance",
     {"fit.csv", "identify.json", "report.html"},
     {"identify.json", "scene.toml"}},
    {"identify friction",
     "",
     "friction.csv --law dahl",
     {"--law", "--out", "--quiet"},
     "out/friction_friction",
     {"identify.json", "report.html", "scene.toml"},
     {"identify.json", "scene.toml"}},
    {"fmu",
     "closed.toml",
     "--kind loop --out out/closed.fmu",
     {"--set", "--kind", "--fmi", "--out", "--quiet"},
     "",
     {},
     {}},
    {"schema", "", "", {}, "", {}, {}},
    {"completion", "", "bash", {}, "", {}, {}},
};

}  // namespace sonoglide::acceptance
