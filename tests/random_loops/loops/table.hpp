/// What becomes of random loops, class by class.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/random_loops/loops/outcome.hpp"

namespace sonoglide::random_loops {

/// CSV with a header and a row for each class; a loop is in several. Columns:
///
///     loops           how many were drawn, of all classes
///     model           of the controller: exact or wrong
///     judged_by       what settles, ends late or never: the friction ratio or, where it is damped,
///                     the amplitude of the vibration velocity
///     class_of, class what the class has in common
///     drawn           loops in it; of these
///     refused         no controller can be designed, or the reader says no
///     failed          the computation failed
///     steps           target steps of the others; of these
///     prompt, late    settled within 1 ms, or after
///     at_end          of these, settled only in the step's last quarter
///     never_named     not settled, with a limit or a fault
///     out_of_reach    of these, with the limit actuator, or to a target that no vibration gives which
///                     leaves the contact closed
///     not_settling, mismatch, ratio_end, fault
///                     of these, with that limit, or with a fault
///     never_unnamed   not settled, without
///     named_settled   settled although a limit or a fault is named
///     ripple_p50 …    quantiles, in friction ratio
///
/// @param all     of one Vibration
/// @param counts  a table of its own for the first so many outcomes, one below the other
std::string table_csv(const std::vector<Outcome>& all, const std::vector<std::uint32_t>& counts);

/// One line for each step, of one verdict if it is given, and a header: the numbers of its loop,
/// its figures.
std::string list_csv(const std::vector<Outcome>& all, std::optional<Verdict> verdict);

/// The same for each settled step that has a name for not being so.
std::string named_settled_csv(const std::vector<Outcome>& all);

/// One line for each loop that was refused or failed: its index and why.
std::string refusals_text(const std::vector<Outcome>& all);

}  // namespace sonoglide::random_loops
