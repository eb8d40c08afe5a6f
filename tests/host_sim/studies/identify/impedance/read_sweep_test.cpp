#include "host_sim/studies/identify/impedance/sweep.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "host_sim/studies/identify/impedance/circuit.hpp"
#include "synthetic.hpp"

namespace sonoglide::identify::impedance {
namespace {

using Complex = std::complex<double>;

constexpr double degrees = 360.0 / two_pi;

/// A file with a line for each of ten frequencies of the published piece.
std::string file_of(const std::string& heading,
                    const std::function<std::string(double f, Complex z)>& line,
                    const std::string& end = "") {
  std::string text = heading;
  const Circuit circuit = published_piece();
  for (int i = 0; i < 10; ++i) {
    const double f = 112e3 + 200.0 * i;
    text += line(f, 1.0 / circuit.admittance_S(f));
  }
  return text + end;
}

void expect_piece(const std::string& text, const std::string& file = "m.csv") {
  const Sweep sweep = read_sweep({file, text});
  ASSERT_EQ(sweep.frequency_Hz.size(), 10U);
  const Circuit circuit = published_piece();
  for (std::size_t i = 0; i < 10; ++i) {
    const double f = sweep.frequency_Hz[i];
    EXPECT_NEAR(f, 112e3 + 200.0 * static_cast<double>(i), 1e-6) << text;
    const Complex y = circuit.admittance_S(f);
    const Complex expected = sweep.has_phase ? y : Complex(std::abs(y));
    EXPECT_NEAR(std::abs(sweep.admittance_S[i] - expected), 0.0, 1e-7 * std::abs(y)) << text;
  }
}

std::string error_of(const std::string& text) {
  try {
    read_sweep({"m.csv", text});
  } catch (const scene_file::SceneError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ReadSweep, KnowsColumnsByTheirNames) {
  const auto polar = [](double f, Complex z) {
    return fmt::format("{:.12g},{:.12g},{:.12g}\n", f, std::abs(z), std::arg(z) * degrees);
  };
  for (const char* heading :
       {"frequency_Hz,impedance_magnitude_ohm,impedance_phase_deg\n",
        "Frequency(Hz), |Z|(Ohm)-data, theta-z(deg)-data\n", "f,Z,phase (deg)\n",
        "Freq [Hz],|Z| [\u03a9],\u03b8 [\u00b0]\n", "f/Hz,abs(Z)/Ohm,arg(Z)/deg\n"}) {
    expect_piece(file_of(heading, polar));
  }
  expect_piece(file_of("Frequency (kHz);|Z| (kOhm);Phase (rad)\n", [](double f, Complex z) {
    return fmt::format("{:.12g};{:.12g};{:.12g}\n", f / 1e3, std::abs(z) / 1e3, std::arg(z));
  }));
  expect_piece(file_of("freq_MHz,R_ohm,X_ohm\n", [](double f, Complex z) {
    return fmt::format("{:.12g},{:.12g},{:.12g}\n", f / 1e6, z.real(), z.imag());
  }));
  expect_piece(file_of("f (Hz)\tRe(Z)\t-Im(Z)\n", [](double f, Complex z) {
    return fmt::format("{:.12g}\t{:.12g}\t{:.12g}\n", f, z.real(), -z.imag());
  }));
  expect_piece(file_of("f (Hz),G (mS),B (uS)\n", [](double f, Complex z) {
    const Complex y = 1.0 / z;
    return fmt::format("{:.12g},{:.12g},{:.12g}\n", f, 1e3 * y.real(), 1e6 * y.imag());
  }));
  for (const char* heading : {"f (Hz),|Z| (dB)\n", "f (Hz),|Z| [dB\u03a9]\n"}) {
    expect_piece(file_of(heading, [](double f, Complex z) {
      return fmt::format("{:.12g},{:.12g}\n", f, 20.0 * std::log10(std::abs(z)));
    }));
  }
  expect_piece(file_of("frequency_Hz,admittance_magnitude_S\n", [](double f, Complex z) {
    return fmt::format("{:.12g},{:.12g}\n", f, 1.0 / std::abs(z));
  }));
}

TEST(ReadSweep, KnowsTouchstone) {
  const auto scattering = [](Complex z) { return (z - 50.0) / (z + 50.0); };
  expect_piece(file_of("! a piece\n# Hz S RI R 50\n", [&](double f, Complex z) {
    const Complex s = scattering(z);
    return fmt::format("{:.15g} {:.15g} {:.15g} ! a reading\n", f, s.real(), s.imag());
  }));
  expect_piece(file_of("",
                       [&](double f, Complex z) {
                         const Complex s = scattering(z);
                         return fmt::format("{:.15g} {:.15g} {:.15g}\n", f / 1e9, std::abs(s),
                                            std::arg(s) * degrees);
                       }),
               "x.s1p");
  expect_piece(file_of("# kHz s db r 50\n", [&](double f, Complex z) {
    const Complex s = scattering(z);
    return fmt::format("{:.15g}\t{:.15g}\t{:.15g}\n", f / 1e3, 20.0 * std::log10(std::abs(s)),
                       std::arg(s) * degrees);
  }));
  // Normalised to the reference resistance.
  expect_piece(file_of("# MHz Z RI R 75\n", [](double f, Complex z) {
    return fmt::format("{:.15g} {:.15g} {:.15g}\n", f / 1e6, z.real() / 75.0, z.imag() / 75.0);
  }));
  expect_piece(file_of("# Hz Y RI R 75\n", [](double f, Complex z) {
    const Complex y = 75.0 / z;
    return fmt::format("{:.15g} {:.15g} {:.15g}\n", f, y.real(), y.imag());
  }));
}

TEST(ReadSweep, TouchstoneWithoutOptionsIsAsTheStandardHasIt) {
  const auto lines = [](double f, Complex z) {
    const Complex s = (z - 50.0) / (z + 50.0);
    return fmt::format("{:.15g} {:.15g} {:.15g}\n", f / 1e9, std::abs(s), std::arg(s) * degrees);
  };
  expect_piece(file_of("#\n", lines), "x.s1p");
  EXPECT_TRUE(read_sweep({"x.s1p", file_of("#\n", lines)}).warnings.empty());
  const Sweep bare = read_sweep({"x.s1p", file_of("", lines)});
  ASSERT_EQ(bare.warnings.size(), 1U);
  EXPECT_NE(bare.warnings.front().find("no option line"), std::string::npos);
}

TEST(ReadSweep, KnowsTheExportOfA4294A) {
  const char* heading = "\"Frequency\"\t\"Data Trace Real\"\t\"Data Trace Imag\"\r\n";
  const std::string a = file_of(
      std::string("\"AN ANALYSER\"\r\n\r\n\"TRACE: A\"\r\n\"FORMAT: |Z|\"\r\n\r\n") + heading,
      [](double f, Complex z) { return fmt::format("{:.12g}\t{:.12g}\t0\r\n", f, std::abs(z)); });
  const std::string b =
      file_of(std::string("\r\n\"TRACE: B\"\r\n\"FORMAT: theta\"\r\n\r\n") + heading,
              [](double f, Complex z) {
                return fmt::format("{:.12g}\t{:.12g}\t0\r\n", f, std::arg(z) * degrees);
              });
  expect_piece(a + b);
  EXPECT_TRUE(read_sweep({"m.txt", a + b}).warnings.empty());
  expect_piece(a);
  EXPECT_NE(read_sweep({"m.txt", a}).warnings.at(0).find("no readings of trace B"),
            std::string::npos);
  const std::string complex_trace =
      file_of(std::string("\"TRACE: A\"\r\n") + heading, [](double f, Complex z) {
        return fmt::format("{:.12g}\t{:.12g}\t{:.12g}\r\n", f, z.real(), z.imag());
      });
  expect_piece(complex_trace);
}

TEST(ReadSweep, KnowsOrRefusesTheNamesOfTraces) {
  const auto traces = [](const std::string& one, const std::string& other) {
    const std::string heading = "\"\n\"Frequency\"\t\"Real\"\n";
    return file_of("\"TRACE: A\"\n\"FORMAT: " + one + heading,
                   [](double f, Complex z) {
                     return fmt::format("{:.12g}\t{:.12g}\n", f, 1.0 / std::abs(z));
                   }) +
           file_of("\n\"TRACE: B\"\n\"FORMAT: " + other + heading, [](double f, Complex z) {
             return fmt::format("{:.12g}\t{:.12g}\n", f, -std::arg(z) * degrees);
           });
  };
  expect_piece(traces("|Y|", "TH"));
  EXPECT_EQ(error_of(traces("|Y|", "X")),
            "m.csv:16:10: trace: \"|Y|\" and \"X\" are no pair of traces that is known; allowed: "
            "|Z|-theta, R-X, |Y|-theta, G-B, complex Z, complex Y");
  EXPECT_EQ(
      error_of("\"TRACE: A\"\n\"FORMAT: R\"\n\"Frequency\"\t\"Real\"\n1\t2\n"),
      "m.csv:2:10: trace: \"R\" alone, without trace B; allowed: |Z|-theta, R-X, |Y|-theta, G-B, "
      "complex Z, complex Y");
}

/// The lines that the instrument itself writes above its traces.
TEST(ReadSweep, KnowsTheOwnLinesOfA4294A) {
  const auto file = [](const std::string& parameter, const std::function<double(Complex z)>& a,
                       const std::function<double(Complex z)>& b) {
    const auto trace = [](const std::string& name, const std::function<double(Complex z)>& value) {
      return file_of(
          name +
              "\"FORMAT: LOG\"\n\"LIST BIAS MODE: FREQUENCY\"\n\n\"Frequency\"\t\"Data "
              "Trace Real\"\t\"Data Trace Imag\"\n",
          [&](double f, Complex z) { return fmt::format("{:.12g}\t{:.12g}\t0.0\n", f, value(z)); });
    };
    return "\"4294A REV1.11\"\n\"DATE: Oct 26 2026\"\n\n\"MEASURE PARAMETER: " + parameter +
           "\"\n\"NUMBER of POINTS: 10\"\n\n" + trace("\"TRACE: A\"\n", a) +
           trace("\n\"TRACE: B\"\n", b);
  };
  const auto magnitude = [](Complex z) { return std::abs(z); };
  const auto phase_deg = [](Complex z) { return std::arg(z) * degrees; };
  const std::string files[] = {
      file("IMPEDANCE MAG PHASE (DEG)", magnitude, phase_deg),
      file("IMPEDANCE MAG PHASE (RAD)", magnitude, [](Complex z) { return std::arg(z); }),
      file(
          "ADMITTANCE MAG PHASE (DEG)", [](Complex z) { return 1.0 / std::abs(z); },
          [](Complex z) { return -std::arg(z) * degrees; }),
      file(
          "|Y|-\u03b8 (rad)", [](Complex z) { return 1.0 / std::abs(z); },
          [](Complex z) { return -std::arg(z); }),
      file(
          "IMPEDANCE REAL IMAG", [](Complex z) { return z.real(); },
          [](Complex z) { return z.imag(); }),
      file(
          "G-B", [](Complex z) { return (1.0 / z).real(); },
          [](Complex z) { return (1.0 / z).imag(); })};
  for (const std::string& text : files) {
    expect_piece(text, "m.txt");
    EXPECT_TRUE(read_sweep({"m.txt", text}).warnings.empty());
    EXPECT_TRUE(read_sweep({"m.txt", text}).has_phase);
  }
  EXPECT_EQ(
      error_of(file("LS-RS", magnitude, phase_deg)),
      "m.csv:4:21: trace: \"LS-RS\" is no pair of traces that is known; allowed: |Z|-theta, R-X, "
      "|Y|-theta, G-B, complex Z, complex Y");
  EXPECT_EQ(error_of(file("MAG FURLONG", magnitude, phase_deg)).substr(0, 64),
            "m.csv:4:21: trace: \"MAG FURLONG\" is no pair of traces that is kn");
}

TEST(ReadSweep, KnowsComplexTraces) {
  const auto file = [](const std::string& parameter, bool admittance) {
    return "\"MEASURE PARAMETER: " + parameter + "\"\n" +
           file_of(
               "\"TRACE: A\"\n\"FORMAT: COMPLEX\"\n\"Frequency\"\t\"Data Trace Real\"\t\"Data "
               "Trace "
               "Imag\"\n",
               [&](double f, Complex z) {
                 const Complex value = admittance ? 1.0 / z : z;
                 return fmt::format("{:.12g}\t{:.12g}\t{:.12g}\n", f, value.real(), value.imag());
               });
  };
  expect_piece(file("COMPLEX Z-Y", false), "m.txt");
  expect_piece(file("COMPLEX Y-Z", true), "m.txt");
  expect_piece(file("ADMITTANCE", true), "m.txt");
}

/// Touchstone 2 does not normalise Y and Z.
TEST(ReadSweep, KnowsTouchstone2AndOtherSpellingsOfItsOptions) {
  const auto rows = [](const std::string& head, const std::function<Complex(Complex z)>& value,
                       const char* between = " ", const std::string& end = "") {
    return file_of(
        head,
        [&](double f, Complex z) {
          const Complex v = value(z);
          return fmt::format("{:.15g}{}{:.15g}{}{:.15g}\n", f, between, v.real(), between,
                             v.imag());
        },
        end);
  };
  const auto scattering = [](double reference) {
    return [=](Complex z) { return (z - reference) / (z + reference); };
  };
  const std::string version = "! one port\n[Version] 2.0\n# Hz ";
  const std::string counts = "[Number of Ports] 1\n[Number of Frequencies] 10\n";
  expect_piece(rows(version + "S RI\n" + counts + "[Reference] 75\n[Network Data]\n",
                    scattering(75.0), " ", "[End]\n"));
  expect_piece(
      rows(version + "S RI R 75\n" + counts + "[Reference]\n! note\n75.0 ! ohm\n[Network Data]\n",
           scattering(75.0), " ", "[End]\n"));
  expect_piece(rows(
      version + "Z RI R 75\n" + counts +
          "[Begin Information]\n1 2 3\n[End Information]\n[Network Data]\n",
      [](Complex z) { return z; }, " ", "[End]\n"));
  expect_piece(rows(
      version + "Y RI R 75\n" + counts + "[Network Data]\n", [](Complex z) { return 1.0 / z; },
      "\t", "[End]\nanything\n"));
  for (const char* resistance :
       {"R75", "R 75 Ohm", "R75 ohm", "R 75\u03a9", "R 75,0", "R 0.075 kOhm"}) {
    expect_piece(rows("# Hz S RI " + std::string(resistance) + "\n", scattering(75.0)));
  }
  expect_piece(rows("# Hz, S, RI, R 50\n", scattering(50.0), ","));
  expect_piece(rows("# Hz S RI R 50\n", scattering(50.0), ", "));
  std::string commas = rows("", scattering(50.0), ";");
  std::replace(commas.begin(), commas.end(), '.', ',');
  expect_piece("# Hz S RI R 50\n" + commas);
}

std::string polar_lines(const std::string& heading, double sign = 1.0) {
  return file_of(heading, [=](double f, Complex z) {
    return fmt::format("{:.12g};{:.12g};{:.12g}\n", f, std::abs(z), sign * std::arg(z) * degrees);
  });
}

/// A phase that is there is read, or refused with its place; never dropped.
TEST(ReadSweep, NoPhaseIsDropped) {
  for (const char* heading :
       {"f;absz;phasez (deg)\n", "f[Hz];Z[Ohm];P[deg]\n", "Hz;Ohm;deg\n",
        "\u9891\u7387(Hz);\u963b\u6297(\u03a9);\u76f8\u4f4d(\u00b0)\n",
        "f (Hz);Trace |Z| (Ohm);Trace \u03b8 (deg)\n", "FrequencyHz;ImpedanceOhm;PhaseDeg\n",
        "f_Hz;Z_ohm;phase in \xb0\n"}) {
    const std::string text = polar_lines(heading);
    expect_piece(text);
    EXPECT_TRUE(read_sweep({"m.csv", text}).has_phase) << heading;
  }
  for (const char* heading :
       {"f;|Z|;-phase (deg)\n", "f;|Z|;\u2212\u03b8 (\u00b0)\n", "f;|Z|;neg. phase (deg)\n",
        "f;|Z|;negative phase_deg\n", "f;|Z|;phase (-deg)\n", "f;|Z|;phase of Y (deg)\n"}) {
    const std::string text = polar_lines(heading, -1.0);
    expect_piece(text);
    EXPECT_TRUE(read_sweep({"m.csv", text}).has_phase) << heading;
  }
  EXPECT_EQ(
      error_of(polar_lines("f;|Z|;phase furlong\n")).substr(0, 84),
      "m.csv:1:7: heading: \"phase furlong\" is not understood: \"furlong\" is no unit of it an");
  EXPECT_NE(error_of(polar_lines("f;|Z|;phase (current to voltage) (deg)\n")).find("m.csv:1:7"),
            std::string::npos);
  EXPECT_EQ(error_of(polar_lines("f;|Z|;Neigung (\u00b0)\n")).substr(0, 59),
            "m.csv:1:7: heading: \"Neigung (\u00b0)\" is not understood: \"Neig");
  EXPECT_EQ(read_sweep({"m.csv", polar_lines("f;|Z|;Neigung\n")}).warnings.at(0),
            "Read is the magnitude of an impedance. Not read: \"Neigung\".");
  // It may be that of the return loss.
  const std::string ambiguous =
      file_of("f,Return loss (dB),Phase (deg),|Z|\n",
              [](double f, Complex z) { return fmt::format("{},1,2,{}\n", f, std::abs(z)); });
  EXPECT_EQ(error_of(ambiguous).substr(0, 65),
            "m.csv:1:20: heading: \"Phase (deg)\" may be the phase of another co");
}

/// As instruments and programs write them; {0} is the frequency, {1} and {2} R and X, {3} and {4} the
/// magnitude and the phase in degrees, {5} and {6} G and B.
TEST(ReadSweep, KnowsTheHeadingsOfInstruments) {
  const std::pair<const char*, const char*> files[] = {
      {"Index;Frequency (Hz);Z' (\u03a9);-Z'' (\u03a9);Z (\u03a9);-Phase (\u00b0);Time (s)\n",
       "1;{0:.12g};{1:.12g};{7:.12g};{3:.12g};{8:.12g};2.5\n"},
      {"freq / Hz,neg. Phase / \u00b0,Idc / uA,Z / Ohm,Z' / Ohm,-Z'' / Ohm,Cs / F\n",
       "{0:.12g},{8:.12g},0,{3:.12g},{1:.12g},{7:.12g},1e-9\n"},
      {"\"NO.\",\"FREQ[Hz]\",\"Z       [ohm]\",\"PHASE   [deg]\"\n",
       "1,{0:.12g},{3:.12g},{4:.12g}\n"},
      {"  Freq(Hz)\tAmpl\tBias\tTime(Sec)\tZ'(a)\tZ''(b)\tGD\tErr\tRange\nEnd Comments\n",
       "{0:.12g}\t1e-2\t0\t2.6\t{1:.12g}\t{2:.12g}\t0\t0\t3\n"},
      {"Frequency (Hz);Trace 1: Impedance: Magnitude (\u03a9);Trace 2: Impedance: Phase (\u00b0)\n",
       "{0:.12g};{3:.12g};{4:.12g}\n"},
      {"\tPt\tTime\tFreq\tZreal\tZimag\tZsig\tZmod\tZphz\n\t#\ts\tHz\tohm\tohm\tV\tohm\t\u00b0\n",
       "\t0\t1\t{0:.12g}\t{1:.12g}\t{2:.12g}\t1\t{3:.12g}\t{4:.12g}\n"},
      {"freq/Hz\tRe(Z)/Ohm\t-Im(Z)/Ohm\t<I>/mA\tCs/\xb5"
       "F\n",
       "{0:.12g}\t{1:.12g}\t{7:.12g}\t1\t2\n"},
      {"Freq/Hz, Z'/ohm, Z\"/ohm, Z/ohm, Phase/deg\n",
       "{0:.12g}, {1:.12g}, {2:.12g}, {3:.12g}, {4:.12g}\n"},
      {"\"Freq, Hz\" \"G, S\" \"B, S\"\n", "{0:.12g} {5:.12g} {6:.12g}\n"},
      {"\"Freq [Hz]\",\"re(Z(1,1)) []\",\"im(Z(1,1)) []\"\n", "{0:.12g},{1:.12g},{2:.12g}\n"},
      {"Freq [Hz];Re(Y11) [S];Im(Y11) [S]\n", "{0:.12g};{5:.12g};{6:.12g}\n"},
      {"\u9891\u7387(Hz),\u7535\u5bfc(S),\u7535\u7eb3(S)\n", "{0:.12g},{5:.12g},{6:.12g}\n"}};
  for (const auto& [heading, row] : files) {
    const std::string text = file_of(heading, [&, format = row](double f, Complex z) {
      return fmt::format(fmt::runtime(format), f, z.real(), z.imag(), std::abs(z),
                         std::arg(z) * degrees, (1.0 / z).real(), (1.0 / z).imag(), -z.imag(),
                         -std::arg(z) * degrees);
    });
    expect_piece(text);
    EXPECT_TRUE(read_sweep({"m.csv", text}).has_phase) << heading;
  }
}

/// Columns beside a complete pair are no reason to refuse it, and are named where they are of a sweep.
TEST(ReadSweep, SurplusColumnsBesideAPairAreNotRead) {
  const auto rows = [](const std::string& heading, const char* format) {
    return file_of(heading, [&](double f, Complex z) {
      return fmt::format(fmt::runtime(format), f, z.real(), z.imag(), std::abs(z),
                         std::arg(z) * degrees);
    });
  };
  const std::string antenna = rows("Freq(MHz),Return Loss(dB),Phase(deg),Rs,SWR,Xs,|Z|,Theta\n",
                                   "{0:.12g},9,9,{1:.12g},9,{2:.12g},9,9\n");
  EXPECT_NE(error_of(antenna).find("contradicts"), std::string::npos) << error_of(antenna);
  const std::string good = rows(
      "f (Hz),Return Loss(dB),Phase(deg),Rs,SWR,Xs,|V| (V),|I| (A),Temperature (\u00b0C),time_s\n",
      "{0:.12g},9,9,{1:.12g},9,{2:.12g},1,2,3,4\n");
  expect_piece(good);
  EXPECT_EQ(read_sweep({"m.csv", good}).warnings,
            (std::vector<std::string>{
                "Read is real and imaginary part of an impedance. Not read: \"Phase(deg)\"."}));
  const std::string discovery = rows(
      "Frequency (Hz),Trace \u03b8 (deg),Trace |Z| (Ohm),Trace Rs (Ohm),Trace Xs (Ohm),Trace Cp "
      "(F)\n",
      "{0:.12g},{4:.12g},{3:.12g},{1:.12g},{2:.12g},7\n");
  expect_piece(discovery);
  EXPECT_TRUE(read_sweep({"m.csv", discovery}).warnings.empty());
  EXPECT_EQ(read_sweep({"m.csv", rows("f,R,X,Z_furlong\n", "{0:.12g},{1:.12g},{2:.12g},1\n")})
                .warnings.at(0),
            "Read is real and imaginary part of an impedance. Not read: \"Z_furlong\".");
}

TEST(ReadSweep, SettingsAboveAndASummaryBelowAreNoRows) {
  const std::string table = polar_lines("f (Hz);|Z| (Ohm);phase (deg)\n");
  std::string with_commas = table;
  std::replace(with_commas.begin(), with_commas.end(), ';', ',');
  expect_piece("Model,X1\nPoints,201\nStart frequency (Hz),112000\n" + with_commas);
  expect_piece("Start frequency,Stop frequency,Points\n112000,114000,10\n" + with_commas);
  expect_piece("Operator,Smith,Lab 2\n" + with_commas);
  for (const char* summary : {"Mean,1000,-45\n", "\nResonance: 112.9 kHz\n", "fs;112900;3\n"}) {
    const Sweep sweep = read_sweep({"m.csv", with_commas + summary});
    EXPECT_EQ(sweep.frequency_Hz.size(), 10U);
    ASSERT_EQ(sweep.warnings.size(), 1U);
    EXPECT_NE(sweep.warnings.front().find("is below the table and is not read"), std::string::npos);
  }
  EXPECT_EQ(error_of(with_commas + with_commas),
            "m.csv:12:1: heading: a second table, beside that of line 1; allowed: one table in a "
            "file");
}

TEST(ReadSweep, KnowsTheMinusAndTheSpacesOfUnicode) {
  const std::string text = file_of("f [Hz]\t|Z| [Ohm]\tphase [deg]\n", [](double f, Complex z) {
    std::string number = fmt::format("{}", f);
    number.insert(3, "\u2009");
    return fmt::format("\u00a0{}\t{:.9f}\u202f\t{}{:.9f}\n", number, std::abs(z),
                       std::arg(z) < 0.0 ? "\u2212" : "", std::abs(std::arg(z)) * degrees);
  });
  expect_piece(text);
}

/// Half of a pair tells no impedance, and a unit alone not which half it is.
TEST(ReadSweep, RefusesHalfOfAPair) {
  EXPECT_EQ(
      error_of("f_kHz,G_S\n1,2\n").substr(0, 101),
      "m.csv:1:7: heading: \"G_S\" is half of a pair, and does not determine the capacitances alone; "
      "allowed: ");
  EXPECT_EQ(error_of("f (kHz);B (mS)\n1;2\n").substr(0, 43),
            "m.csv:1:9: heading: \"B (mS)\" is half of a p");
  EXPECT_EQ(error_of("kHz;S\n1;2\n").substr(0, 62),
            "m.csv:1:5: heading: \"S\" is a unit and no name; allowed: magnit");
}

/// A million commas, blanks and lines are refused, and take no memory of a cell each.
TEST(ReadSweep, RefusesMoreCellsAndLinesThanATableHas) {
  const std::string commas(4U << 20U, ',');
  EXPECT_NE(error_of(commas), "no error");
  EXPECT_NE(error_of("f,|Z|\n1,2\n3," + commas).find("row: cells on this line: more than 1000"),
            std::string::npos);
  for (const char letter : {'x', '_', ' ', '(', '1', '*'}) {
    const std::string long_name(1U << 20U, letter);
    EXPECT_LT(error_of("f,s" + long_name + "\n1,2\n").size(), 1000U);
    EXPECT_LT(error_of("# Hz S RI R " + long_name + "\n1 2 3\n").size(), 1000U);
  }
  // Each line may be the heading, or the units of that above it.
  std::string headings;
  for (int i = 0; i < 20'000; ++i) {
    headings += i % 2 == 0 ? "f (Hz),|Z| (kOhm)\n" : "# f,Hz,Ohm\n";
  }
  EXPECT_NE(error_of(headings).find("no row of numbers below the heading"), std::string::npos);
  std::string lines;
  for (int i = 0; i <= 1'000'000; ++i) {
    lines += "a\n";
  }
  EXPECT_NE(error_of(lines).find("has too many lines; allowed: up to 1000000"), std::string::npos);
}

TEST(ReadSweep, ColumnsThatSayTheSameAgree) {
  const auto file = [](const char* names, double factor, double sign) {
    return file_of(std::string("f_Hz,|Z|,phase_deg,") + names + "\n", [&](double f, Complex z) {
      return fmt::format("{:.12g},{:.12g},{:.12g},{:.3g},{:.3g}\n", f, std::abs(z),
                         std::arg(z) * degrees, factor * z.real(), sign * factor * z.imag());
    });
  };
  expect_piece(file("R_ohm,X_ohm", 1.0, 1.0));
  for (const auto& text : {file("R_ohm,X_ohm", 3.0, 1.0), file("R_ohm,X_ohm", 1.0, -1.0)}) {
    EXPECT_NE(error_of(text).find("m.csv:2:"), std::string::npos) << error_of(text);
    EXPECT_NE(error_of(text).find("contradicts magnitude and phase of an impedance"),
              std::string::npos)
        << error_of(text);
  }
  EXPECT_EQ(
      error_of("f,|Z| (ohm),|Z| (kohm)\n1,2,3\n"),
      "m.csv:1:13: heading: \"|Z| (kohm)\" and \"|Z| (ohm)\" are the same; allowed: one of them");
}

/// 28 is 28 kHz more often than 28 Hz, and "28,000" may be 28 thousand.
TEST(ReadSweep, WarnsOfNumbersThatMayBeAThousandTimesAsMuch) {
  const auto warnings = [](const char* heading, const char* row) {
    const std::string text = file_of(heading, [&](double f, Complex z) {
      const auto whole = static_cast<int>(std::lround(f));
      return fmt::format(fmt::runtime(row), whole / 1000, whole % 1000, std::abs(z));
    });
    return read_sweep({"m.csv", text}).warnings;
  };
  const std::vector<std::string> none;
  const std::vector<std::string> no_unit = {
      "\"f\" has no unit in its name: it is taken for a frequency in Hz."};
  const std::vector<std::string> commas = {
      "The commas of numbers as \"112,000\" on line 2 are taken for decimal commas; where they "
      "stand between thousands, take them out."};
  EXPECT_EQ(warnings("f,|Z|\n", "{}.{:03},{}\n"), no_unit);
  EXPECT_EQ(warnings("f,|Z|\n", "{}{:03},{}\n"), none);
  EXPECT_EQ(warnings("f_kHz,|Z|\n", "{}.{:03},{}\n"), none);
  EXPECT_EQ(warnings("f_kHz;|Z|\n", "{},{:03};9\n"), commas);
  EXPECT_EQ(warnings("f_kHz;|Z|\n", "{},{:03};9,5\n"), none);
}

TEST(ReadSweep, SaysWhichUnitItTakes) {
  const auto format = [](const char* heading) {
    return read_sweep({"m.csv", file_of(heading,
                                        [](double f, Complex z) {
                                          return fmt::format("{},{},{}\n", f, z.real(), z.imag());
                                        })})
        .format;
  };
  EXPECT_EQ(format("f_Hz,R,X\n"),
            "a table of real and imaginary part of an impedance, in ohm as its name has no unit");
  EXPECT_EQ(format("f_Hz,G,B\n"),
            "a table of real and imaginary part of an admittance, in siemens as its name has no "
            "unit");
  EXPECT_EQ(format("f_Hz,R (kOhm),X (kOhm)\n"),
            "a table of real and imaginary part of an impedance");
}

TEST(ReadSweep, WarnsOfAFileThatMayBeCut) {
  std::string text = "f_Hz,|Z|\n";
  for (int i = 1; i <= 8; ++i) {
    text += fmt::format("{},{}\n", i, 100 + i);
  }
  EXPECT_TRUE(read_sweep({"m.csv", text}).warnings.empty());
  text.pop_back();
  EXPECT_NE(read_sweep({"m.csv", text}).warnings.at(0).find("has no line end"), std::string::npos);
}

TEST(ReadSweep, SortsAndAveragesReadingsOfOneFrequency) {
  std::string text = "f_Hz,|Y|\n";
  for (const int f : {9, 1, 3, 2, 5, 4, 6, 8, 7}) {
    text += fmt::format("{},{}\n", f, 100 + f);
  }
  EXPECT_TRUE(read_sweep({"m.csv", text}).warnings.empty());
  const Sweep sweep = read_sweep({"m.csv", text + "3,105\n"});
  ASSERT_EQ(sweep.frequency_Hz.size(), 9U);
  EXPECT_EQ(sweep.frequency_Hz[2], 3.0);
  EXPECT_EQ(sweep.admittance_S[2].real(), 104.0);
  EXPECT_EQ(sweep.frequency_Hz.back(), 9.0);
  ASSERT_EQ(sweep.warnings.size(), 1U);
  EXPECT_EQ(sweep.warnings.front(),
            "The file has 10 readings at 9 frequencies: those of one frequency are averaged.");
  EXPECT_EQ(read_sweep({"m.csv", text + "3,309\n"}).warnings.front(),
            "The file has 10 readings at 9 frequencies: those of one frequency are averaged. They "
            "differ by up to 50 % from their mean: of several traces leave one.");
}

/// Two traces that differ alike along the sweep, however little, or readings that scatter as much.
TEST(ReadSweep, NamesTracesThatDifferByMoreThanScatter) {
  for (const bool as_traces : {true, false}) {
    std::string text = "f_Hz,|Y|\n";
    for (const bool second : {false, true}) {
      for (int f = 1; f <= 20; ++f) {
        const bool above = as_traces ? second : second == (f % 3 == 0 || f % 5 == 0);
        text += fmt::format("{},{}\n", f, above ? 102 : 100);
      }
    }
    const std::string warning = read_sweep({"m.csv", text}).warnings.at(0);
    EXPECT_EQ(warning.find(
                  "They differ by up to 0.99 % from their mean, in the same way along the sweep") !=
                  std::string::npos,
              as_traces)
        << warning;
  }
}

TEST(ReadSweep, NamesThePlaceOfWhatIsWrong) {
  const auto begins = [](const std::string& text, const std::string& error) {
    EXPECT_EQ(error_of(text).substr(0, error.size()), error) << error_of(text);
  };
  begins("f,|Z|\n1,2\n-2,3\n", "m.csv:3:1: f: \"-2\" is no frequency");
  begins("f,|Z|\n1,2\n2,0\n", "m.csv:3:3: |Z|: \"0\" is no magnitude");
  begins("f,|Z|\n1,2\n2,NaN\n", "m.csv:3:3: |Z|: \"NaN\" is no number");
  begins("time_s,|Z|\n1,2\n", "m.csv:1:1: heading: no column is a frequency");
  begins("f,colour\n1,2\n", "m.csv:1:1: heading: no columns of an impedance");
  for (const char* heading : {"f,S11 (dB)", "f,S11 mag,S11 phase", "f,s_11 (dB)", "f,Gain (dB)",
                              "f,Magnitude (dB)", "f,Reflection magnitude", "f,Cp (F)"}) {
    begins(std::string(heading) + "\n1,2\n", "m.csv:1:1: heading: no columns of an impedance");
  }
  begins("\"PARAMETER: CP-D\"\n\"TRACE: A\"\n\"Frequency\"\t\"Real\"\n1\t2\n",
         "m.csv:1:13: trace: \"CP-D\" alone, without trace B; allowed: |Z|-theta");
  begins("f,|Z|\n1,2\n2,3\n", "m.csv:1:1: sweep: has readings at 2 frequencies");
  begins("f,|Z|\n1,2\n1,3\n", "m.csv:1:1: sweep: has readings at 1 frequency;");
  begins("# Hz S RI R 50\n1 2\n", "m.csv:2:4: second number: cells on this line: 2");
  begins("# Hz S RI R 50\n1 -1 0\n", "m.csv:2:3: first number: \"-1\" has an admittance");
  begins("# Hz H RI R 50\n1 1 0\n", "m.csv:1:1: touchstone: names what one port does not have");
  begins("[Version] 2.0\n# Hz S RI R 50\n[Number of Ports] 2\n",
         "m.csv:3:1: touchstone: [number of ports] is 2; allowed: 1");
  begins("[Version] 2.0\n# Hz S RI R 50\n[Number of Frequencies] 3\n1 0.5 0\n",
         "m.csv:3:1: touchstone: [Number of Frequencies] is 3, and readings are 1");
  begins("[Version] 2.0\n# Hz S RI R 50\n[Mixed-Mode Order] D2,3\n",
         "m.csv:3:1: touchstone: [mixed-mode order] is not known; allowed: ");
  begins("\"TRACE: A\"\n\"Frequency\"\t\"Real\"\t\"Imag\"\n1\tx\t0\n",
         "m.csv:3:3: Real: \"x\" is no number");
}

/// Files with bytes changed, doubled and left out are read or refused with a place and what is
/// allowed; nothing else is thrown.
TEST(ReadSweep, ADamagedFileIsReadOrRefused) {
  const std::string whole[] = {
      polar_lines("Points;10\nf (10^3 Hz);|Z| [k\u03a9];\u2212\u03b8 (\u00b0)\n"),
      polar_lines("[Version] 2.0\n# kHz Z MA R 50 Ohm\n[Number of Frequencies] 10\n"),
      polar_lines(
          "\"MEASURE PARAMETER: IMPEDANCE MAG PHASE (DEG)\"\n\"TRACE: A\"\n\"FORMAT: LOG\"\n"
          "\"Frequency\"\t\"Real\"\t\"Imag\"\n")};
  std::mt19937 random(1);
  const std::string bytes = "0123456789.,;-+e|()[]/_'\"# \t\n\xce\xa9\xe2\x81\xbbZYfkMS%!";
  for (int i = 0; i < 3000; ++i) {
    std::string text = whole[i % 3];
    for (int change = 0; change <= i % 5; ++change) {
      // Mostly in the heading.
      const std::size_t at = random() % (change % 2 == 0 ? 80 : text.size());
      const std::size_t size = random() % 4;
      text.replace(at, size, std::string(random() % 3, bytes[random() % bytes.size()]));
    }
    const std::string error = error_of(text);
    EXPECT_TRUE(error == "no error" ||
                (error.rfind("m.csv:", 0) == 0 && error.find("allowed: ") != std::string::npos))
        << error;
  }
}

/// Cut anywhere, a file is read or refused with a place.
TEST(ReadSweep, ATruncatedFileIsReadOrRefused) {
  const std::string text = file_of("f,|Z|,phase\n", [](double f, Complex z) {
    return fmt::format("{:.12g},{:.12g},{:.12g}\n", f, std::abs(z), std::arg(z) * degrees);
  });
  for (std::size_t size = 0; size < text.size(); ++size) {
    const std::string error = error_of(text.substr(0, size));
    EXPECT_TRUE(error == "no error" || error.rfind("m.csv:", 0) == 0) << error;
  }
}

}  // namespace
}  // namespace sonoglide::identify::impedance
