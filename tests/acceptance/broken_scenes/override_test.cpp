#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "base_scenes.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::override_test {
namespace {

/// Options as shell words, and all of stderr.
struct BadOverride {
  const char* name;
  const char* options;
  const char* error;
};

void PrintTo(const BadOverride& override, std::ostream* out) {
  *out << override.name;
}

const std::vector<BadOverride> bad_overrides = {
    {"no_equals", "--set plant.mass_kg",
     "--set:1:1: plant.mass_kg: no value; allowed: TABLE.KEY=VALUE, or TABLE.KEY= to remove the "
     "key"},
    {"removed", "--set plant.mass_kg=",
     "--set:1:1: plant.mass_kg: missing; required: a number, 1e-12 to 1e+06 kg"},
    {"no_key", "--set =3",
     "--set:1:1: --set: no key; allowed: TABLE.KEY=VALUE, or TABLE.KEY= to remove the key"},
    {"whole_table", "--set plant=3",
     "--set:1:1: plant: a whole table cannot be set; allowed: TABLE.KEY=VALUE, or TABLE.KEY= to "
     "remove the key"},
    {"array_element", "--set 'run.record[0]=\"velocity_m_per_s\"'",
     "--set:1:1: run.record[0]: a part of a value cannot be set; allowed: TABLE.KEY=VALUE, or "
     "TABLE.KEY= to remove the key"},
    {"third_level", "--set run.record.0=3",
     "--set:1:1: run.record.0: a part of a value cannot be set; allowed: TABLE.KEY=VALUE, or "
     "TABLE.KEY= to remove the key"},
    {"open_quote", "--set 'plant.\"mass_kg=3'",
     "--set:1:1: plant.\"mass_kg: is no name of a key; allowed: TABLE.KEY=VALUE, or TABLE.KEY= to "
     "remove the key"},
    {"two_keys", "--set '[\"plant\"]\n[friction]\nx=3'",
     "--set:1:1: [\"plant\"]\\x0a[friction]\\x0ax: more than one key; allowed: TABLE.KEY=VALUE, or "
     "TABLE.KEY= to remove the key"},
    {"unknown_quoted_key", "--set 'plant.\"mass\"=3'",
     "--set:1:1: plant.mass: unknown key; did you mean mass_kg?"},
    {"unknown_key", "--set plant.mass=3",
     "--set:1:1: plant.mass: unknown key; did you mean mass_kg?"},
    {"dotted_key_without_its_table", "--set tolerance.stiffness=0.01",
     "--set:1:1: tolerance.stiffness: unknown key; did you mean \"plant.stiffness_N_per_m\"?"},
    {"dotted_key_of_several_tables", "--set tolerance.delay_periods=0.01",
     "--set:1:1: tolerance.delay_periods: unknown key; did you mean \"drive.delay_periods\" or "
     "\"sensor.delay_periods\"?"},
    {"key_of_another_table_without_quotes", "--set tolerance.plant=0.01",
     "--set:1:1: tolerance.plant: unknown key; one of another table stands in quotes here, as "
     "\"plant.mass_kg\""},
    {"key_without_name", "--set run.=3",
     "--set:1:1: run.: unknown key; allowed: start, duration_s, duration_periods, window_start_s, window_start_periods, settling_band, "
     "record, record_interval_s"},
    {"quoted_key_without_name", "--set 'run.\"\"=3'",
     "--set:1:1: run.\"\": unknown key; allowed: start, duration_s, duration_periods, window_start_s, window_start_periods, settling_band, "
     "record, record_interval_s"},
    {"quoted_table_without_name", "--set '\"\"=3'",
     "--set:1:1: \"\": unknown table; allowed: plant, friction, sliding, load, transducer, drive, "
     "solver, run, controller, sensor, model_error, tolerance, true_values"},
    {"unknown_table", "--set plan.mass_kg=3",
     "--set:1:1: plan.mass_kg: unknown table; did you mean plant?"},
    {"key_without_table", "--set mass_kg=3",
     "--set:1:1: mass_kg: unknown table; did you mean plant.mass_kg?"},
    {"out_of_range", "--set plant.mass_kg=0",
     "--set:1:1: plant.mass_kg: 0 is out of range; allowed: 1e-12 to 1e+06 kg"},
    {"not_finite", "--set plant.mass_kg=nan",
     "--set:1:1: plant.mass_kg: is not finite; allowed: a number, 1e-12 to 1e+06 kg"},
    {"bare_word_for_number", "--set plant.mass_kg=heavy",
     "--set:1:1: plant.mass_kg: is a string; allowed: a number, 1e-12 to 1e+06 kg"},
    {"table_for_number", "--set 'plant.mass_kg={a=1}'",
     "--set:1:1: plant.mass_kg: is a table; allowed: a number, 1e-12 to 1e+06 kg"},
    {"not_toml", "--set plant.mass_kg=1.2.3",
     "--set:1:1: plant.mass_kg: \"1.2.3\" is no TOML value; allowed: a number with a decimal "
     "point, true, false, a list in [ ], a table in { } that has each key once, a text in \" \" or a bare "
     "word"},
    {"decimal_comma", "--set plant.mass_kg=0,02",
     "--set:1:1: plant.mass_kg: \"0,02\" is no TOML value; allowed: a number with a decimal "
     "point, true, false, a list in [ ], a table in { } that has each key once, a text in \" \" or a bare "
     "word"},
    {"key_twice_in_a_table", "--set 'controller.target_texture={ratio=[0.4],ratio=[0.5]}'",
     "--set:1:1: controller.target_texture: \"{ratio=[0.4],ratio=[0.5]}\" is no TOML value; allowed: a "
     "number with a decimal point, true, false, a list in [ ], a table in { } that has each key once, a text "
     "in \" \" or a bare word"},
    {"second_value", "--set 'plant.mass_kg=1\nstiffness_N_per_m = 2'",
     "--set:1:1: plant.mass_kg: more than one value; allowed: one TOML value or a bare word"},
    {"unknown_word", "--set friction.law=dahll",
     "--set:1:1: friction.law: \"dahll\" is unknown; did you mean \"dahl\"? allowed: \"dahl\", "
     "\"lugre\", \"iwan\", \"coulomb\", \"stribeck\", \"transverse_coulomb\", "
     "\"normal_coulomb\", \"none\""},
    {"ordinal_of_the_option", "--set plant.mass_kg=1 --set friction.coefficient=-1",
     "--set:2:1: friction.coefficient: -1 is out of range; allowed: 0 to 100"},
    {"element_of_the_value", "--set 'run.record=[\"velocity_m_per_s\", 3]'",
     "--set:1:1: run.record[1]: is an integer; allowed: \"displacement_m\", \"velocity_m_per_s\", "
     "\"friction_force_N\", \"drive_force_N\", \"sliding_velocity_m_per_s\", "
     "\"load_displacement_m\""},
    {"unused_key", "--set solver.step_s=1e-8",
     "--set:1:1: solver.step_s: not used with solver.method = \"event_taylor\"; remove it"},
    {"unused_table", "--set sensor.adc_bits=12",
     "--set:1:1: sensor: not used in open loop, without a [controller] table; remove it"},
    {"excluded_by_the_file", "--set run.duration_s=1",
     "--set:1:1: run.duration_s: excludes duration_periods; allowed: one of the two"},
    {"removes_what_is_needed", "--set run.record= --set plant.mass_kg=",
     "--set:2:1: plant.mass_kg: missing; required: a number, 1e-12 to 1e+06 kg"},
    {"needs_what_the_file_lacks", "--set friction.law=lugre",
     "--set:1:1: friction.static_coefficient: missing; required: a number, 0.1 to 100"},
    {"last_one_wins", "--set plant.mass_kg=1 --set plant.mass_kg=0",
     "--set:2:1: plant.mass_kg: 0 is out of range; allowed: 1e-12 to 1e+06 kg"},
};

class BadOverrideTest : public testing::TestWithParam<BadOverride> {};

TEST_P(BadOverrideTest, IsRejectedInOneLineAndLeavesNothing) {
  const ScratchFolder folder;
  folder.write("scene.toml", open_loop);
  const Outcome outcome = folder.run(std::string("run scene.toml ") + GetParam().options);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, std::string(GetParam().error) + "\n");
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"scene.toml"});
}

INSTANTIATE_TEST_SUITE_P(Table, BadOverrideTest, testing::ValuesIn(bad_overrides),
                         [](const auto& scene) { return std::string(scene.param.name); });

}  // namespace
}  // namespace sonoglide::acceptance::override_test
