#include "host_sim/scene_file/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "host_sim/scene/bound.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene_file/law_keys.hpp"

namespace sonoglide::scene_file {
namespace {

bool stands(const scene::SpeedPoint& point) {
  return point.velocity_m_per_s == 0.0;
}

/// Whether the sliding stands for a while.
bool stands_still(const std::vector<scene::SpeedPoint>& profile) {
  const bool at_first = stands(profile.front()) && profile.front().time_s > 0.0;
  return at_first || stands(profile.back()) ||
         std::adjacent_find(profile.begin(), profile.end(),
                            [](const scene::SpeedPoint& one, const scene::SpeedPoint& next) {
                              return stands(one) && stands(next);
                            }) != profile.end();
}

/// Friction across the vibration needs a slip to point against.
void require_slip(const TableCursor& cursor, std::string_view key, const scene::Sliding& sliding,
                  const scene::FrictionLaw& law) {
  if (scene::vibration_of(law) == friction::Vibration::across && stands_still(sliding.profile)) {
    cursor.fail(key, fmt::format("a speed that stays 0 leaves the friction law \"{}\" without a "
                                 "direction; allowed: a speed that at most passes 0",
                                 scene::name_of(law)));
  }
}

/// The current into a capacitance has no bound where the voltage jumps.
void require_cosine(const TableCursor& cursor, scene::Waveform waveform) {
  if (waveform != scene::Waveform::cosine) {
    cursor.fail("waveform", fmt::format("\"{}\" is not for a [transducer]; allowed: \"cosine\"",
                                        scene::name_of(scene::waveforms, waveform)));
  }
}

/// A coarser word would have no frequency near the one that is asked for.
void settle_frequency(const TableCursor& cursor, scene::Drive& drive) {
  const double lowest_Hz = drive.frequency_profile.empty()
                               ? drive.frequency_Hz
                               : scene::smallest_value(drive.frequency_profile);
  if (drive.frequency_resolution_Hz > lowest_Hz) {
    cursor.fail("frequency_resolution_Hz",
                fmt::format("{:g} Hz is above the carrier frequency; allowed: at most {} Hz",
                            drive.frequency_resolution_Hz, scene::at_most(lowest_Hz)));
  }
  drive.frequency_Hz = drive.nearest_frequency_Hz(drive.frequency_Hz);
}

/// A carrier period falls into whole bits of it.
void require_binary_parts(const TableCursor& cursor, int codes_per_period) {
  if (codes_per_period != 1 && codes_per_period != 2 && codes_per_period != 4 &&
      codes_per_period != 8) {
    cursor.fail(
        "codes_per_period",
        fmt::format("{} does not halve a carrier period; allowed: 1, 2, 4, 8", codes_per_period));
  }
}

void check_friction(const TableCursor& cursor, const Variant& /*variant*/, scene::Scene& scene) {
  for (const scene::ContactValues& contact : extreme_contacts(scene.friction)) {
    for (const OwnKeyRefusal& each : own_keys(scene.friction.law, contact).refusals) {
      cursor.fail(each.name, each.finding);
    }
  }
}

void check_sliding(const TableCursor& cursor, const Variant& /*variant*/, scene::Scene& scene) {
  require_slip(cursor, cursor.given_of("velocity_m_per_s", "profile"), scene.sliding,
               scene.friction.law);
}

/// What is not solved together with a body of its own.
void check_load(const TableCursor& cursor, const Variant& /*variant*/, scene::Scene& scene) {
  const friction::Vibration vibration = scene::vibration_of(scene.friction.law);
  if (vibration != friction::Vibration::along) {
    cursor.fail(
        fmt::format("not used with friction.law = \"{}\": {}; allowed: a law of friction "
                    "along the vibration",
                    scene::name_of(scene.friction.law),
                    vibration == friction::Vibration::across
                        ? "a body at rest in such a contact is not modelled"
                        : "such a contact is solved at a velocity that is given"));
  }
  if (scene.friction.sign_convention != scene::SignConvention::dissipative) {
    cursor.fail(
        "not used with friction.sign_convention = \"as_printed\", under which the friction "
        "on the body has no reaction; allowed: \"dissipative\"");
  }
  if (const char* key = scene.profile_key()) {
    cursor.fail(fmt::format("not used with {}; allowed: a constant value in its place", key));
  }
  scene.sliding.profile = {{0.0, scene.load->fastest_m_per_s()}};
}

void check_drive(const TableCursor& cursor, const Variant& /*variant*/, scene::Scene& scene) {
  settle_frequency(cursor, *scene.drive);
  require_binary_parts(cursor, scene.drive->codes_per_period);
  if (scene.transducer) {
    require_cosine(cursor, scene.drive->waveform);
  }
}

struct TableCheck {
  std::string_view table;
  void (*check)(const TableCursor&, const Variant&, scene::Scene&);
};

constexpr std::array<TableCheck, 8> table_checks = {{{"friction", check_friction},
                                                     {"sliding", check_sliding},
                                                     {"load", check_load},
                                                     {"drive", check_drive},
                                                     {"solver", check_solver},
                                                     {"run", check_run},
                                                     {"controller", check_controller},
                                                     {"sensor", check_sensor}}};

}  // namespace

void check_presence(const TableCursor& cursor, const scene::Scene& scene) {
  const KeyTable& table = cursor.keys();
  const bool needed = table.required && (table.has == nullptr || table.has(scene));
  if (!cursor.present() && needed) {
    const bool sliding = table.name == "sliding";
    cursor.fail(
        fmt::format("missing; required: a table [{}]{}", table.name, sliding ? ", or [load]" : ""));
  }
  if (!cursor.present() && table.name == "drive" && scene.controller) {
    cursor.fail("missing; required: a table [drive] for the [controller] to act by");
  }
  for (const Use& use : table.uses) {
    if (cursor.present() && !cursor.emptied() && !use.holds(scene)) {
      cursor.fail(fmt::format("not used {}; remove it", use.reason(scene)));
    }
  }
}

void check_table(const TableCursor& cursor, const Variant& variant, scene::Scene& scene) {
  for (const TableCheck& each : table_checks) {
    if (each.table == cursor.keys().name) {
      each.check(cursor, variant, scene);
    }
  }
}

}  // namespace sonoglide::scene_file
