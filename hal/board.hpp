/// The seam between a controller and a board: everything that a board must offer.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>

namespace sonoglide::hal {

/// One sample, taken once per carrier period. Codes are left-justified: ±2^31 is ± full scale,
/// whatever the converter's width.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): who makes one fills it
struct Sample {
  std::int32_t friction_force;    ///< mean over the last carrier period; full scale: the sensor's
  std::int32_t sliding_velocity;  ///< full scale: peak vibration velocity at full drive
  bool force_at_rail;             ///< the force converter stood at either end of its range
  bool fresh;                     ///< false where no sample arrived since the last one
  bool velocity_at_rail = false;  ///< the velocity converter stood at either end of its range
};

/// With the vibration, of a unit that observes it. The vibration velocity is the real part
/// of (in_phase + j quadrature) e^jθ, θ the phase of the drive: from the demodulated velocity
/// pick-up, or from the current of the transducer less that of its clamped capacitance, over the
/// force factor. The sliding velocity has the full scale of the vibration sensor.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): likewise
struct VibrationSample : Sample {
  std::int32_t in_phase;    ///< mean over the last carrier period; full scale: the sensor's
  std::int32_t quadrature;  ///< likewise
  bool vibration_at_rail;   ///< a converter of the vibration stood at either end of its range
  bool vibration_fresh;     ///< false where no vibration sample arrived since the last one
};

/// With the mean velocity of the vibration, of a unit that damps a slow natural mode by a bias force:
/// what a velocity pick-up that reaches down to 0 Hz shows, averaged over the carrier period.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): likewise
struct MotionSample : VibrationSample {
  std::int32_t mean_velocity;  ///< full scale: the vibration sensor's; limited to it
};

/// Answer to a sample. The amplitude takes effect at a drive phase 0. The design states how many
/// carrier periods this is after the end of the sampled period (drive.delay_periods of a scene, 1
/// by default).
struct Drive {
  std::int32_t amplitude;  ///< 0 … 2^31 − 1, full scale: the actuator's limit
  std::int32_t
      commanded_ratio;    ///< friction ratio, target and feedback together; 2^31 is a ratio of 2
  std::uint8_t state;     ///< control::State
  std::uint8_t limit;     ///< control::Limit
  std::uint8_t fault;     ///< control::Fault, or from 32 on what the unit's own loop found
  std::uint8_t settling;  ///< control::Settling
};

/// Of a unit that observes the vibration. At resonance its amplitude is from -2^31 on; below 0 the
/// phase of the drive is turned by π.
struct ResonantDrive : Drive {
  std::int32_t frequency;  ///< steps of the frequency word above that of the start; else 0
};

/// Of a unit that damps a slow natural mode by a bias: a force that is constant over the carrier period
/// in which the amplitude is in force, and beside the carrier. A second actuator makes it, or the same
/// amplifier by a constant voltage beside the carrier.
struct BiasedDrive : Drive {
  std::int32_t bias;  ///< -2^31 + 1 … 2^31 - 1, full scale: drive.bias_limit_N; 0 without a drive
};

/// A board is a class of this shape. It needs no base class; the app is compiled for one board:
///
///   class Board {
///    public:
///     bool sample(Sample& sample);     // waits for the next carrier period; false: shut down
///     void drive(const Drive& drive);  // acts at the drive phase 0 that the design states
///   };
///
/// The board of a unit that observes the vibration takes VibrationSample and ResonantDrive in their
/// place; of one that answers with a bias too, MotionSample where there is a vibration sensor, and
/// BiasedDrive.
///
/// A board whose own timer makes the carrier periods (app::TimedLoop) keeps the drive at zero from
/// reset until the first drive(), and also offers:
///
///     std::uint32_t period();  // carrier periods begun since reset; wraps
///
/// sample() then gives the sample that came with the latest period, and waits if it has given that
/// one before. The rest is optional; an image holds only what it names.
///
/// A board with an encoder along the sliding may hand over its count. A texture (controller.target_texture)
/// then lies along that count, in place of the sliding velocity that the controller integrates; it begins
/// where the count is 0. Both members or none:
///
///     static constexpr double travel_counts_per_m;  // a texture's period has 8 to 2^30 counts
///     std::uint32_t travel();  // with the last sample; rises with the sliding velocity; wraps
///
/// A board whose hardware switches the drive off by itself, by a comparator of overcurrent for one, and holds it
/// off, may say so. The unit is then in the fault external with that cause until a restart, which it refuses
/// while the board still says so:
///
///     std::uint8_t tripped();  // with the last sample; 0: not; or the cause by the board's own count, 1 to 31
///
///   class Watchdog {  // resets the board unless it is fed in time
///    public:
///     void feed();
///     bool caused_reset() const;
///     static bool crystal_failed();  // before the reset, asked once; of a board that watches its crystal alone
///   };
///
///   class ByteLink {  // neither call waits; over a UART see hal::BufferedLink
///    public:
///     bool receive(std::uint8_t& byte);  // false: nothing there
///     bool send(std::uint8_t byte);      // false: no room yet
///   };
///
///   class Flash {  // two pages, 0 and 1, that are erased one by one; asked only while not busy
///    public:
///     static constexpr std::size_t page_words;  // words of 32 bits in a page
///     std::uint32_t read(std::size_t page, std::size_t word) const;
///     void erase(std::size_t page);  // begins to set every bit
///     void program(std::size_t page, std::size_t word, std::uint32_t value);  // to clear bits
///     bool busy() const;
///   };
///
/// A flash may have two pages more, 2 and 3, for the history of the unit (app::UnitHistory), and says so:
///
///     static constexpr std::size_t pages = 4;
///
/// A flash may stall the processor in place of being busy, because it is erased and programmed with
/// the drive at zero only. A watchdog is slower than an erase, or the flash makes it slower for
/// that time. A word that a power cut spoilt may read as anything, but read() returns. A flash of
/// wider words shows each as one of 32 bits.
namespace detail {

template <class Board, class SampleT, class DriveT, class = void>
struct IsBoard : std::false_type {};
template <class Board, class SampleT, class DriveT>
struct IsBoard<Board, SampleT, DriveT,
               std::void_t<decltype(std::declval<Board&>().sample(std::declval<SampleT&>())),
                           decltype(std::declval<Board&>().drive(std::declval<const DriveT&>()))>>
    : std::is_same<decltype(std::declval<Board&>().sample(std::declval<SampleT&>())), bool> {};

template <class Board, class = void>
struct KeepsPeriods : std::false_type {};
template <class Board>
struct KeepsPeriods<Board, std::void_t<decltype(std::declval<Board&>().period())>>
    : std::is_same<decltype(std::declval<Board&>().period()), std::uint32_t> {};

template <class Board, class = void>
struct CountsTravel : std::false_type {};
template <class Board>
struct CountsTravel<Board, std::void_t<decltype(std::declval<Board&>().travel()),
                                       decltype(Board::travel_counts_per_m)>>
    : std::is_same<decltype(std::declval<Board&>().travel()), std::uint32_t> {};

template <class Board, class = void>
struct ReportsTrips : std::false_type {};
template <class Board>
struct ReportsTrips<Board, std::void_t<decltype(std::declval<Board&>().tripped())>>
    : std::is_same<decltype(std::declval<Board&>().tripped()), std::uint8_t> {};

template <class Flash, class = void>
struct KeepsHistory : std::false_type {};
template <class Flash>
struct KeepsHistory<Flash, std::void_t<decltype(Flash::pages)>>
    : std::bool_constant<Flash::pages == 4> {
  static_assert(Flash::pages == 2 || Flash::pages == 4, "two pages, or four with a history");
};

}  // namespace detail

/// Whether a class has the shape of a board.
template <class Board, class SampleT = Sample, class DriveT = Drive>
inline constexpr bool is_board = detail::IsBoard<Board, SampleT, DriveT>::value;

/// Whether a board makes the carrier periods itself.
template <class Board, class SampleT = Sample, class DriveT = Drive>
inline constexpr bool keeps_periods =
    is_board<Board, SampleT, DriveT>&& detail::KeepsPeriods<Board>::value;

/// Whether a board counts the sliding distance.
template <class Board>
inline constexpr bool counts_travel = detail::CountsTravel<Board>::value;

/// Whether a flash has pages for the history of a unit.
template <class Flash>
inline constexpr bool keeps_history = detail::KeepsHistory<Flash>::value;

/// Whether a board says that its hardware has switched the drive off.
template <class Board>
inline constexpr bool reports_trips = detail::ReportsTrips<Board>::value;

}  // namespace sonoglide::hal
